// Signals.
#pragma once

namespace raytracer::cli {

/// From here on SIGINT, SIGTERM and SIGHUP end the program at once with exit code 128 + signal, with no file
/// half written and a clean line on the terminal. A full disk or a closed pipe is an error of the write, not
/// a signal.
void install_signal_handlers();

/// Moves to the start of the terminal's line and empties it.
inline constexpr char kClearLine[] = "\r\x1b[K";

/// Whether a progress bar stands on the terminal's line, which a signal then has to clear.
void set_line_in_use(bool in_use);

}  // namespace raytracer::cli
