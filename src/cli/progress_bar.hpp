// The bar on the terminal.
#pragma once

#include <chrono>

#include "raytracer/render.hpp"

namespace raytracer::cli {

/// Listens to a render: draws a bar with the time left where `visible`, and stops the render on a signal.
class ProgressBar : public RenderObserver {
 public:
  explicit ProgressBar(bool visible) : visible_(visible) {}
  ~ProgressBar() override;

  bool on_progress(std::uint64_t done, std::uint64_t total) override;

 private:
  using Clock = std::chrono::steady_clock;

  bool visible_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_drawn_ = start_;
};

}  // namespace raytracer::cli
