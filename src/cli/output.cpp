#include "cli/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include "image/write_file.hpp"
#include "raytracer/error.hpp"

namespace raytracer::cli {

void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is the one given out. Opened the wrong way round, so that using it still fails.
    if (fcntl(stream, F_GETFD) < 0) [[maybe_unused]]
      const int opened = open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

void say(std::string_view text) { write_all(STDOUT_FILENO, {text.begin(), text.end()}, "standard output"); }

void warn(std::string_view text) {
  try {
    write_all(STDERR_FILENO, {text.begin(), text.end()}, "standard error");
  } catch (const Error&) {  // there is nowhere to say it
  }
}

}  // namespace raytracer::cli
