// Every picture of a scene is read once.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "image/picture.hpp"
#include "textures/texel_pyramid.hpp"

namespace raytracer {

/// Pictures and pyramids by the path that was asked for. Any number of threads may ask at once. Owned by
/// whoever loads the scene; what it has given lives on without it.
class PictureCache {
 public:
  /// Throws what read_picture throws, each time.
  std::shared_ptr<const Picture> picture(const std::string& path);
  std::shared_ptr<const TexelPyramid> pyramid(const std::string& path, const TexelUse& use);

  /// Reads them all, on all threads, so that the calls above find them; what can't be read is told by those.
  void prefetch(const std::vector<std::string>& paths);

  /// The memory of all pictures and pyramids.
  std::size_t bytes() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const Picture>> pictures_;
  std::map<std::pair<std::string, TexelUse>, std::shared_ptr<const TexelPyramid>> pyramids_;
};

}  // namespace raytracer
