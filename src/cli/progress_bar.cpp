#include "cli/progress_bar.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "cli/interrupt.hpp"

namespace raytracer::cli {
namespace {

constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kRedrawEvery{100};
constexpr const char* kClearLine = "\r\x1b[K";

std::string time_text(double seconds) {
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  const auto minutes = static_cast<long>(seconds / 60);
  if (minutes < 60) return fmt::format("{} min {:02.0f} s", minutes, seconds - 60 * static_cast<double>(minutes));
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

}  // namespace

ProgressBar::~ProgressBar() {
  if (drawn_) fmt::print(stderr, "{}", kClearLine);
}

bool ProgressBar::on_progress(std::uint64_t done, std::uint64_t total) {
  const Clock::time_point now = Clock::now();
  if (visible_ && now - last_drawn_ >= kRedrawEvery) {
    last_drawn_ = now;
    drawn_ = true;
    const double share = static_cast<double>(done) / static_cast<double>(total);
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const auto filled = static_cast<std::size_t>(share * kBarWidth);
    fmt::print(stderr, "{}[{:<{}}] {:3.0f} %  {} left", kClearLine, std::string(filled, '#'), kBarWidth, 100 * share,
               time_text(elapsed * (1 - share) / share));
    std::fflush(stderr);
  }
  return pending_signal() == 0;
}

}  // namespace raytracer::cli
