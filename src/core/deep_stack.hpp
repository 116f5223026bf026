// Room for deep recursions.
#pragma once

#include <functional>

namespace raytracer {

/// Runs `work` to its end on a stack of 128 MiB, of which only what is used takes memory; what it throws is
/// thrown on. Where no such stack can be had it runs on the caller's.
void run_on_deep_stack(const std::function<void()>& work);

}  // namespace raytracer
