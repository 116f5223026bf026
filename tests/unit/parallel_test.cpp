#include "core/parallel.hpp"

#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "catch.hpp"

using raytracer::parallel_for;
using raytracer::run_with_threads;

namespace {

/// Whether a product too small for a normal number comes out as zero here and now.
bool denormals_are_flushed() {
  volatile float tiny = std::numeric_limits<float>::min();
  volatile float product = tiny * 0.25f;
  return product == 0;
}

/// Counts itself as arrived and waits for the others; gives up after a while rather than hang when they never
/// come.
void meet(std::atomic<std::size_t>& arrived, std::size_t expected) {
  ++arrived;
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (arrived < expected && std::chrono::steady_clock::now() < give_up) std::this_thread::yield();
}

}  // namespace

TEST_CASE("parallel_for calls every index exactly once", "[parallel]") {
  for (const std::size_t count : {0u, 1u, 2u, 7u, 1000u}) {
    std::vector<std::atomic<int>> calls(count);
    parallel_for(count, [&](std::size_t i) { ++calls[i]; });
    for (const std::atomic<int>& c : calls) REQUIRE(c == 1);
  }
}

TEST_CASE("parallel_for may be nested", "[parallel]") {
  std::atomic<int> calls = 0;
  run_with_threads(
      2, [&] { parallel_for(10, [&](std::size_t) { parallel_for(10, [&](std::size_t) { ++calls; }); }); });
  REQUIRE(calls == 100);
}

TEST_CASE("an exception leaves parallel_for and run_with_threads", "[parallel]") {
  const auto fail = [](std::size_t i) {
    if (i == 5) throw std::runtime_error("five");
  };
  REQUIRE_THROWS_WITH(parallel_for(100, fail), "five");
  REQUIRE_THROWS_WITH(run_with_threads(3, [&] { parallel_for(100, fail); }), "five");
  std::atomic<int> calls = 0;
  parallel_for(3, [&](std::size_t) { ++calls; });
  REQUIRE(calls == 3);
}

TEST_CASE("run_with_threads gives all the threads asked for and no more", "[parallel]") {
  for (const std::size_t threads : {1u, 2u, 5u}) {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    run_with_threads(static_cast<int>(threads), [&] {
      std::atomic<std::size_t> arrived = 0;
      parallel_for(threads, [&](std::size_t) {
        {
          const std::lock_guard lock(mutex);
          seen.insert(std::this_thread::get_id());
        }
        meet(arrived, threads);
      });
      REQUIRE(seen.size() == threads);
      parallel_for(1000, [&](std::size_t) {
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
      });
    });
    REQUIRE(seen.size() == threads);
    REQUIRE(seen.count(std::this_thread::get_id()) == 1);
  }
}

#ifdef __SSE2__
TEST_CASE("denormals are flushed on every working thread and only there", "[parallel]") {
  REQUIRE_FALSE(denormals_are_flushed());
  const auto count_flushed = [] {
    std::atomic<int> flushed = 0;
    std::atomic<std::size_t> arrived = 0;
    parallel_for(4, [&](std::size_t) {
      meet(arrived, 4);
      if (denormals_are_flushed()) ++flushed;
    });
    return flushed.load();
  };
  run_with_threads(4, [&] {
    REQUIRE(denormals_are_flushed());
    REQUIRE(count_flushed() == 4);
  });
  REQUIRE_FALSE(denormals_are_flushed());
  parallel_for(1, [&](std::size_t) { REQUIRE(denormals_are_flushed()); });
  REQUIRE_FALSE(denormals_are_flushed());
}
#endif
