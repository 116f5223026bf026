#include "cli/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "image/write_file.hpp"

namespace raytracer::cli {
namespace {

std::atomic<bool> line_in_use{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // else a signal handler could not read it

// Ends the process from within whatever it is doing: a pixel may take minutes, and nothing needs to be saved.
void on_signal(int number) {
  remove_unfinished_file();
  if (line_in_use) [[maybe_unused]]
    const ssize_t written = write(STDERR_FILENO, kClearLine, sizeof kClearLine - 1);
  _exit(128 + number);
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    // Whoever started us with a signal ignored (nohup, a shell's background job) meant it.
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) {
      sigaction(number, &action, nullptr);
    }
  }
  action.sa_handler = SIG_IGN;
  for (const int number : {SIGXFSZ, SIGPIPE}) sigaction(number, &action, nullptr);
}

void set_line_in_use(bool in_use) { line_in_use = in_use; }

}  // namespace raytracer::cli
