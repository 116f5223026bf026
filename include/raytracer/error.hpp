// The one exception of the library.
#pragma once

#include <stdexcept>
#include <string>

namespace raytracer {

/// What went wrong, as the exit code that a program reports.
enum class ErrorKind {
  kScene = 1,        ///< the scene is wrong, or names something that is not there
  kUsage = 2,        ///< the program was called wrongly
  kFile = 3,         ///< the scene can't be read or the picture can't be written
  kInterrupted = 4,  ///< the observer asked to stop
};

/// Thrown by every function of the library that cannot do what it was asked. The message is a sentence for
/// the user without a trailing full stop.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace raytracer
