// The bar on the terminal.
#pragma once

#include <chrono>

#include "raytracer/render.hpp"

namespace raytracer::cli {

/// Listens to renders and draws a bar with the time left where `visible`.
class ProgressBar : public RenderObserver {
 public:
  /// `pictures`: how many are made; the bar is about all of them.
  ProgressBar(bool visible, std::size_t pictures) : visible_(visible), pictures_(pictures) {}
  ~ProgressBar() override;

  /// The next one begins; `frame` is shown unless it is 0.
  void begin_picture(int frame);

  bool on_progress(std::uint64_t done, std::uint64_t total) override;

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_;
  bool drawn_ = false;
  std::size_t pictures_, begun_ = 0;
  int frame_ = 0;
  Clock::time_point start_ = Clock::now(), last_drawn_ = start_;
};

}  // namespace raytracer::cli
