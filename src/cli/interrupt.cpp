#include "cli/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <csignal>

#include "image/write_file.hpp"

namespace raytracer::cli {
namespace {

volatile std::sig_atomic_t signal_received = 0;
volatile std::sig_atomic_t stops_itself = 0;

void on_signal(int number) {
  if (stops_itself != 0 && signal_received == 0) {
    signal_received = number;
    return;
  }
  remove_unfinished_file();
  _exit(128 + number);
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int number : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    // Whoever started us with a signal ignored (nohup, a shell's background job) meant it.
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) {
      sigaction(number, &action, nullptr);
    }
  }
  action.sa_handler = SIG_IGN;
  for (const int number : {SIGXFSZ, SIGPIPE}) sigaction(number, &action, nullptr);
}

int pending_signal() { return signal_received; }

StopBetweenTiles::StopBetweenTiles() { stops_itself = 1; }

StopBetweenTiles::~StopBetweenTiles() { stops_itself = 0; }

}  // namespace raytracer::cli
