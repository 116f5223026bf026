// A table of contents: read the command line, run the command, and the one place where an error becomes a message and
// an exit code.
#include <fmt/format.h>

#include <cstdio>
#include <new>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/options.hpp"
#include "raytracer/error.hpp"

namespace {

using namespace raytracer;

int run(int argc, const char* const* argv) {
  const cli::ParsedCommandLine line = cli::parse_command_line(argc, argv);
  if (line.options.wants_help) {
    fmt::print("{}", cli::help_page());
    return 0;
  }
  if (line.options.wants_version) {
    fmt::print("raytracer {}\n", RAYTRACER_VERSION);
    return 0;
  }
  return line.command->run(line.options);
}

int exit_code(ErrorKind kind) {
  return kind == ErrorKind::kInterrupted ? 128 + cli::pending_signal() : static_cast<int>(kind);
}

}  // namespace

int main(int argc, char** argv) {
  cli::install_signal_handlers();
  try {
    return run(argc, argv);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInterrupted) fmt::print(stderr, "raytracer: {}\n", error.what());
    return exit_code(error.kind());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "raytracer: out of memory\n");
    return exit_code(ErrorKind::kFile);
  }
}
