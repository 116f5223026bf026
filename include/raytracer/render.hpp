// From a scene to a picture.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>

#include "raytracer/image.hpp"
#include "raytracer/method.hpp"
#include "raytracer/scene.hpp"

namespace raytracer {

/// How one picture is made of a scene.
struct RenderSettings {
  int width = 960, height = 540;  ///< pixels
  Method method = Method::kClassic;
  int samples = 1;  ///< rays per pixel; one goes through the pixel's centre
  int bounces = 8;  ///< classic: reflections and refractions followed, black after; path: scatterings, 0
                    ///< shows only what shines, 1 direct light
  Sampling sampling = Sampling::kBoth;
  float clamp_indirect =
      0;            ///< path: the most that one path may add after its first bounce, 1 is white; 0: no limit
  int threads = 0;  ///< 0: all the machine has
  std::uint32_t seed = 0;   ///< another seed, other sample points
  double shutter = 0;       ///< seconds that it is open, which blurs what moves; 0 shows one moment
  Development development;  ///< of the picture, afterwards; render() itself does not use it

  /// Into how many parts the time that the shutter is open is cut, the middle of each standing for the whole.
  int slices() const { return shutter > 0 ? std::min(samples, 64) : 1; }
  /// That middle, in seconds, for the picture that begins at `time`.
  double slice_time(double time, int slice) const {
    return shutter > 0 ? time + shutter * (slice + 0.5) / slices() : time;
  }
};

/// The scene at a time in seconds. The render asks for one time after another and keeps at most one alive.
using SceneAt = std::function<std::shared_ptr<const Scene>(double time)>;

/// Told of what happens while a picture is made. The functions are called from any of the render's threads,
/// one at a time.
class RenderObserver {
 public:
  virtual ~RenderObserver() = default;
  /// `done` of `total` tiles, counted once per slice of time, are finished. Return false to stop: render()
  /// then throws Error (kInterrupted).
  virtual bool on_progress(std::uint64_t done, std::uint64_t total) = 0;
};

/// What a render did, for those who ask.
struct RenderStatistics {
  std::uint64_t rays = 0;    ///< camera, shadow and reflected rays
  double build_seconds = 0;  ///< spent waiting for `scene_at`
};

/// Renders the scene at `time`, or with an open shutter from then on: that time is cut into as many slices as
/// there are samples, at most 64, and the samples of a slice see the scene at its middle. The picture is a
/// pure function of scene and settings: the same bytes for any number of threads. `observer` may be null.
Image render(const SceneAt& scene_at, double time, const RenderSettings& settings,
             RenderObserver* observer = nullptr, RenderStatistics* statistics = nullptr);

}  // namespace raytracer
