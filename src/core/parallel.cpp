#include "core/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <optional>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace raytracer {
namespace {

/// Makes this thread treat denormal numbers as zero for as long as it lives: they cost over a hundred cycles
/// each and are nothing that one could see.
class FlushDenormals {
 public:
#ifdef __SSE2__
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero); }
  ~FlushDenormals() { _mm_setcsr(saved_); }

 private:
  static constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
  unsigned saved_;

 public:
#else
  FlushDenormals() {}
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
};

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  const FlushDenormals flush;
  // oneTBB sets a thread's floating-point mode anew with each group of tasks that it turns to, so an observer
  // of starting threads would be overruled: the group itself has to carry the mode.
  tbb::task_group_context group(tbb::task_group_context::bound, tbb::task_group_context::default_traits |
                                                                    tbb::task_group_context::fp_settings);
  tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner(), group);
}

void run_with_threads(int threads, const std::function<void()>& work) {
  const FlushDenormals flush;
  // The arena bounds what runs in it; the control lets it have more threads than there are cores, and bounds
  // other users of oneTBB too (Embree builds its trees with it).
  std::optional<tbb::global_control> control;
  if (threads > 0) {
    control.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute(work);
}

}  // namespace raytracer
