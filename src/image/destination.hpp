// Where a picture's path leads.
#pragma once

#include <sys/types.h>

#include <string>

namespace raytracer {

struct Destination {
  enum class Kind {
    kNew,         // nothing is there
    kFile,        // a regular file, to be replaced
    kDevice,      // a pipe, a terminal, /dev/null …, to be opened and written
    kDescriptor,  // a file that is open already, by a path such as /dev/stdout
  };
  Kind kind = Kind::kNew;
  std::string path;          // of the file itself, links followed
  std::string folder, name;  // path's two halves; the folder of "a" is "."
  int descriptor = -1;       // of kDescriptor
  mode_t permissions = 0;    // of kFile; so are the next two
  uid_t owner = 0;
  gid_t group = 0;
};

/// Throws Error (kFile) in the user's words when nothing can be written there.
Destination find_destination(const std::string& path);

}  // namespace raytracer
