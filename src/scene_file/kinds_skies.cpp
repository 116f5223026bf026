// The rows of the skies. What the numbers mean stands in lights/environments.hpp.
#include "image/picture.hpp"
#include "lights/environments.hpp"
#include "raytracer/error.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/colors.hpp"
#include "scene_file/kinds.hpp"

namespace raytracer::scene_file {
namespace {

constexpr std::string_view kSky = "sky";
constexpr std::string_view kDegrees = "degrees";
constexpr Range kElevation{-90, 90, false};
constexpr Range kTurbidity{1, 20, false};

struct SkyInput {
  FileName file;
  double rotate = 0, strength = 1;
  bool visible = true;
  ColorValue zenith{Vector3d(0.25, 0.45, 0.9)}, horizon{Vector3d(0.85, 0.9, 1)},
      ground{Vector3d(0.3, 0.28, 0.25)};
  double elevation = 45, azimuth = 0, turbidity = 3;
  ColorValue ground_color{Vector3d(0.3)};
  bool disk = true;
  double disk_size = 1;
};
constexpr PropertyRow kStrength =
    property<&SkyInput::strength>("strength", "Multiplies its light.").within(kBrightness);
constexpr PropertyRow kVisible =
    property<&SkyInput::visible>("visible", "Whether the camera sees it, or the background instead.");

constexpr PropertyRow kImageSky[] = {
    property<&SkyInput::file>("file", "A panorama: Radiance HDR, EXR, PNG or JPEG, -z at its left edge.")
        .must_be_given(),
    property<&SkyInput::rotate>("rotate", "Turns it about y, counter-clockwise seen from above.")
        .in(kDegrees),
    kStrength, kVisible};
constexpr PropertyRow kGradientSky[] = {
    property<&SkyInput::zenith>("zenith", "The light from straight up.").within(kBrightness),
    property<&SkyInput::horizon>("horizon", "From eye level.").within(kBrightness),
    property<&SkyInput::ground>("ground", "From straight below.").within(kBrightness), kStrength, kVisible};
constexpr PropertyRow kSunSky[] = {
    property<&SkyInput::elevation>("elevation", "Of the sun over the horizon.")
        .in(kDegrees)
        .within(kElevation),
    property<&SkyInput::azimuth>("azimuth", "Where it stands: 0 is -z, 90 is x.").in(kDegrees),
    property<&SkyInput::turbidity>("turbidity", "How hazy the air is: 2 clear, 10 milky.").within(kTurbidity),
    property<&SkyInput::ground_color>("ground_color", "The share of light that the ground returns.")
        .within(kShare),
    property<&SkyInput::disk>("disk", "Whether the sun itself is there."),
    property<&SkyInput::disk_size>("disk_size", "Times its true size; larger is softer, not brighter.")
        .within({0.01, 100}),
    kStrength,
    kVisible};

template <class Make>
void set_sky(const SkyInput& in, BlockContext& block, const Make& make) {
  try {
    block.draft().scene.sky = make();
    block.draft().scene.is_sky_visible = in.visible;
  } catch (const Error& problem) {
    block.error({}, problem.what());
  }
}

void build_image_sky(const SkyInput& in, BlockContext& block) {
  const auto picture = block.picture("file", in.file.name);
  if (picture == nullptr) return;
  set_sky(in, block, [&] {
    EnvironmentPicture environment{picture->width, picture->height, to_floats(*picture)};
    if (block.method() == Method::kClassic) {  // whose values are those of a display
      for (float& value : environment.rgb) {
        value = static_cast<float>(display_from_linear(static_cast<double>(value)));
      }
    }
    return make_image_sky(std::move(environment), in.strength, turn_about_y(in.rotate));
  });
}

void build_gradient_sky(const SkyInput& in, BlockContext& block) {
  set_sky(in, block, [&] {
    return make_gradient_sky(Color3f(in.strength * in.zenith.rgb), Color3f(in.strength * in.horizon.rgb),
                             Color3f(in.strength * in.ground.rgb));
  });
}

void build_sun_sky(const SkyInput& in, BlockContext& block) {
  constexpr double kNight = -8;  // degrees; less than 1e-5 of white is left
  if (in.elevation < kNight) {
    block.warning("elevation", "the sun is so far below the horizon that the sky is black", "elevation 10");
  }
  set_sky(in, block, [&] {
    return make_sun_sky({in.elevation, in.azimuth, in.turbidity, Color3f(in.ground_color.rgb), in.disk,
                         in.disk_size, in.strength});
  });
}

KindRow sky(KindRow row, std::string_view variant) {
  row.variant = variant;
  row.block_class = BlockClass::kSetting;
  return row;
}

}  // namespace

std::span<const KindRow> sky_kinds() {
  static const KindRow rows[] = {
      sky(kind<SkyInput, build_image_sky>(kSky, "Light from all around, from a picture.", kImageSky),
          "image"),
      sky(kind<SkyInput, build_gradient_sky>(kSky, "Light from all around, in three colours.", kGradientSky),
          "gradient"),
      sky(kind<SkyInput, build_sun_sky>(kSky, "A clear sky and its sun.", kSunSky), "sun"),
  };
  return rows;
}

}  // namespace raytracer::scene_file
