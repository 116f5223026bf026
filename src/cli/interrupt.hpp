// Signals.
#pragma once

namespace raytracer::cli {

/// From here on SIGINT and SIGTERM end the program with exit code 128 + signal, at once and with no file half written, or
/// as soon as a StopBetweenTiles lets go. A full disk or a closed pipe is an error of the write, not a signal.
void install_signal_handlers();

/// The signal that asked to stop, or 0.
int pending_signal();

/// While one lives, the first signal only sets pending_signal(), and the program ends itself in good order; a second one
/// ends it at once.
class StopBetweenTiles {
 public:
  StopBetweenTiles();
  ~StopBetweenTiles();
  StopBetweenTiles(const StopBetweenTiles&) = delete;
  StopBetweenTiles& operator=(const StopBetweenTiles&) = delete;
};

}  // namespace raytracer::cli
