#include "cli/progress_bar.hpp"

#include <fmt/format.h>

#include <string>

#include "cli/interrupt.hpp"
#include "cli/output.hpp"

namespace raytracer::cli {
namespace {

constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kRedrawEvery{100};

std::string time_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  const auto minutes = static_cast<long>(seconds / 60);
  if (minutes < 60) {
    return fmt::format("{} min {:02.0f} s", minutes, seconds - 60 * static_cast<double>(minutes));
  }
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

}  // namespace

ProgressBar::~ProgressBar() {
  if (drawn_) warn(kClearLine);
  set_line_in_use(false);
}

void ProgressBar::begin_picture(int frame) {
  frame_ = frame;
  ++begun_;
}

bool ProgressBar::on_progress(std::uint64_t done, std::uint64_t total) {
  const Clock::time_point now = Clock::now();
  if (visible_ && now - last_drawn_ >= kRedrawEvery) {
    last_drawn_ = now;
    drawn_ = true;
    set_line_in_use(true);
    const double share =
        (static_cast<double>(begun_ - 1) + static_cast<double>(done) / static_cast<double>(total)) /
        static_cast<double>(pictures_);
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const auto filled = static_cast<std::size_t>(share * kBarWidth);
    warn(fmt::format("{}[{:<{}}] {:3.0f} %  {} left{}", kClearLine, std::string(filled, '#'), kBarWidth,
                     100 * share, time_text(elapsed * (1 - share) / share),
                     frame_ > 0 ? fmt::format(", frame {}", frame_) : ""));
  }
  return true;
}

}  // namespace raytracer::cli
