// A table of contents: read the command line, run the command, and the one place where an error becomes a
// message and an exit code.
#include <fmt/format.h>

#include <exception>
#include <new>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "core/printable.hpp"
#include "raytracer/error.hpp"

namespace {

using namespace raytracer;

int run(int argc, const char* const* argv) {
  const cli::ParsedCommandLine line = cli::parse_command_line(argc, argv);
  if (line.options.wants_help) {
    cli::say(cli::help_page());
    return 0;
  }
  if (line.options.wants_version) {
    cli::say(fmt::format("raytracer {}\n", RAYTRACER_VERSION));
    return 0;
  }
  return line.command->run(line.options);
}

int fail(ErrorKind kind, const char* message) {
  cli::warn(fmt::format("raytracer: {}\n", printable(message)));
  return static_cast<int>(kind);
}

}  // namespace

int main(int argc, char** argv) {
  cli::occupy_standard_streams();
  cli::install_signal_handlers();
  try {
    return run(argc, argv);
  } catch (const Error& error) {
    return fail(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::kFile, "out of memory");
  } catch (const std::exception& error) {
    return fail(ErrorKind::kFile, error.what());
  }
}
