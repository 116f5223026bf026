#include "textures/picture_cache.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "image/read_image.hpp"
#include "raytracer/error.hpp"

namespace raytracer {

std::shared_ptr<const Picture> PictureCache::picture(const std::string& path) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = pictures_.find(path);
    if (found != pictures_.end()) return found->second;
  }
  // Read without the lock, which others would wait for; whoever is first to be done is kept.
  auto read = std::make_shared<const Picture>(read_picture(path));
  const std::lock_guard lock(mutex_);
  return pictures_.emplace(path, std::move(read)).first->second;
}

std::shared_ptr<const TexelPyramid> PictureCache::pyramid(const std::string& path, const TexelUse& use) {
  const std::pair key(path, use);
  {
    const std::lock_guard lock(mutex_);
    const auto found = pyramids_.find(key);
    if (found != pyramids_.end()) return found->second;
  }
  auto made = make_pyramid(picture(path), use);
  const std::lock_guard lock(mutex_);
  return pyramids_.emplace(key, std::move(made)).first->second;
}

void PictureCache::prefetch(const std::vector<std::string>& paths) {
  std::vector<std::string> once = paths;
  std::sort(once.begin(), once.end());
  once.erase(std::unique(once.begin(), once.end()), once.end());
  parallel_for(once.size(), [&](std::size_t i) {
    try {
      picture(once[i]);
    } catch (const Error&) {
      // Told to the one who asks for it, who knows the place in the scene.
    }
  });
}

std::size_t PictureCache::bytes() const {
  const std::lock_guard lock(mutex_);
  std::size_t bytes = 0;
  for (const auto& [path, picture] : pictures_) bytes += picture->bytes();
  for (const auto& [key, pyramid] : pyramids_) bytes += pyramid->bytes();
  return bytes;
}

}  // namespace raytracer
