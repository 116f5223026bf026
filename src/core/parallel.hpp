// Work on several threads. The only door to oneTBB.
#pragma once

#include <cstddef>
#include <functional>

namespace raytracer {

/// Calls body(0) … body(count - 1), each once and whichever thread is free next, and returns when all are
/// done. While a body runs, denormal numbers count as zero, on every thread alike. If a body throws, those
/// that have not begun are left out and one of the exceptions is thrown on.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Runs `work`; every parallel_for that it calls uses at most `threads` threads, the caller's among them
/// (0: as many as the machine can run at once). Denormal numbers count as zero inside.
void run_with_threads(int threads, const std::function<void()>& work);

}  // namespace raytracer
