#include "core/deep_stack.hpp"

#include <pthread.h>

#include <cstddef>
#include <exception>

namespace raytracer {
namespace {

constexpr std::size_t kStackSize = std::size_t{128} << 20U;

struct Task {
  const std::function<void()>& work;
  std::exception_ptr thrown;
};

void* run(void* argument) {
  Task& task = *static_cast<Task*>(argument);
  try {
    task.work();
  } catch (...) {
    task.thrown = std::current_exception();
  }
  return nullptr;
}

}  // namespace

void run_on_deep_stack(const std::function<void()>& work) {
  Task task{work, nullptr};
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_t thread;
  const bool is_started = pthread_attr_setstacksize(&attributes, kStackSize) == 0 &&
                          pthread_create(&thread, &attributes, run, &task) == 0;
  pthread_attr_destroy(&attributes);
  if (!is_started) return work();
  pthread_join(thread, nullptr);
  if (task.thrown) std::rethrow_exception(task.thrown);
}

}  // namespace raytracer
