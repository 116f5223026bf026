// The rows of the lights.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "raytracer/shapes.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/kinds.hpp"

namespace raytracer::scene_file {
namespace {

constexpr std::string_view kLength = "scene units";
constexpr std::string_view kDegrees = "degrees";

struct LightInput {
  Vector3d position{0};
  ColorValue color{Vector3d(1)};
  double intensity = 1000;
  Falloff falloff = Falloff::kLinear;
  // of a spot, or of a directional light
  std::optional<Vector3d> look_at, direction;
  double angle = 45, soft_edge = 0;
  std::optional<ColorValue> radiant_intensity;
};
constexpr std::string_view kFalloffs[] = {"none", "linear", "quadratic"};
constexpr PropertyRow kLightPosition =
    property<&LightInput::position>("position", "Where it stands.").in(kLength);
constexpr PropertyRow kLightColor =
    property<&LightInput::color>("color", "The colour of its light.").within(kBrightness);
constexpr PropertyRow kLightIntensity =
    property<&LightInput::intensity>("intensity",
                                     "Its strength; 255 shows white as white at distance 1, 2550 at 10.")
        .within(kBrightness);
constexpr PropertyRow kLightFalloff =
    property<&LightInput::falloff>("falloff", "How it fades with distance d: 1, 1/d or 1/d^2.")
        .one_of(kFalloffs);
constexpr PropertyRow kLightDirection =
    property<&LightInput::direction>("direction", "The way the light travels, of any length.")
        .or_else("0 -1 0");

constexpr PropertyRow kLightRadiantIntensity =
    property<&LightInput::radiant_intensity>("radiant_intensity",
                                             "Its strength in watts per steradian, in place of all these.")
        .within(kBrightness)
        .or_else("follows from them");

constexpr PropertyRow kPointLight[] = {kLightPosition, kLightColor, kLightIntensity, kLightFalloff,
                                       kLightRadiantIntensity};
constexpr PropertyRow kDirectionalLight[] = {kLightDirection, kLightColor, kLightIntensity};
constexpr PropertyRow kSpotLight[] = {
    kLightPosition,
    property<&LightInput::look_at>("look_at", "The point it shines at, in place of direction.")
        .in(kLength)
        .or_else("along direction"),
    kLightDirection,
    property<&LightInput::angle>("angle", "The full width of its cone.").in(kDegrees).within({0, 360, true}),
    property<&LightInput::soft_edge>("soft_edge",
                                     "Over how much of the cone's angle it fades out, from the rim inwards.")
        .within(kShare),
    kLightColor,
    kLightIntensity,
    kLightFalloff,
    kLightRadiantIntensity,
};

// Nothing where the properties say no strength that there could be, which has then been reported.
std::optional<Light> make_light(const LightInput& in, Light::Kind kind, BlockContext& block) {
  Light light;
  light.kind = kind;
  light.falloff = in.falloff;
  Vector3d lambda = in.intensity * in.color.rgb;
  if (in.radiant_intensity) {
    for (const std::string_view other : {"intensity", "color", "falloff"}) {
      if (!block.is_given(other)) continue;
      block.error(other, fmt::format("a light has either 'radiant_intensity' or '{}'", other),
                  "remove one of them");
      return std::nullopt;
    }
    // A white surface returns 1/pi of what arrives into each direction, and 255 is white.
    lambda = 255 / std::numbers::pi * in.radiant_intensity->rgb;
    light.falloff = Falloff::kQuadratic;
  }
  if (std::max({lambda.x, lambda.y, lambda.z}) > 255 * kBrightest) {
    block.error("intensity", "'intensity' times 'color' is more than can be computed with");
    return std::nullopt;
  }
  light.lambda = Color3f(lambda);
  return light;
}

void build_point_light(const LightInput& in, BlockContext& block) {
  std::optional<Light> light = make_light(in, Light::Kind::kPoint, block);
  if (!light) return;
  light->position = Vector3f(block.placed(in.position).point(in.position));
  block.add_light(*light);
}

// The way a light points, in the world; nothing where that is no direction, which has then been reported.
std::optional<Vector3f> world_direction(const LightInput& in, BlockContext& block) {
  const bool aims = in.look_at.has_value();
  const Vector3d direction = aims ? *in.look_at - in.position : in.direction.value_or(Vector3d(0, -1, 0));
  if (glm::length(direction) > 0) {
    return Vector3f(glm::normalize(block.placed(in.position).vector(direction)));
  }
  block.error(aims ? "look_at" : "direction",
              aims ? "the light shines at the point where it stands" : "'direction' has no length",
              aims ? "'position' and 'look_at' must differ" : "direction 0 -1 0");
  return std::nullopt;
}

void build_directional_light(const LightInput& in, BlockContext& block) {
  std::optional<Light> light = make_light(in, Light::Kind::kDirectional, block);
  const std::optional<Vector3f> direction = world_direction(in, block);
  if (!light || !direction) return;
  light->direction = *direction;
  block.add_light(*light);
}

void build_spot_light(const LightInput& in, BlockContext& block) {
  if (in.look_at && in.direction) {
    return block.error("direction", "a spot has either 'look_at' or 'direction'", "remove one of them");
  }
  std::optional<Light> light = make_light(in, Light::Kind::kSpot, block);
  const std::optional<Vector3f> direction = world_direction(in, block);
  if (!light || !direction) return;
  light->position = Vector3f(block.placed(in.position).point(in.position));
  light->direction = *direction;
  const double half_angle = glm::radians(in.angle / 2);
  light->cos_outer = static_cast<float>(std::cos(half_angle));
  light->cos_inner = static_cast<float>(std::cos(half_angle * (1 - in.soft_edge)));
  block.add_light(*light);
}

struct AreaLightInput {
  Vector3d origin{0}, width{1, 0, 0}, height{0, 1, 0};
  ColorValue radiance{Vector3d(1)};
  bool visible = true;
};
constexpr PropertyRow kAreaLight[] = {
    property<&AreaLightInput::origin>("origin", "One corner.").in(kLength),
    property<&AreaLightInput::width>("width", "The edge vector from there to the next corner.").in(kLength),
    property<&AreaLightInput::height>("height",
                                      "The other edge vector; it shines on the side of width x height.")
        .in(kLength),
    property<&AreaLightInput::radiance>("radiance", "How bright it is; 1 is white.").within(kBrightness),
    property<&AreaLightInput::visible>("visible", "Whether the camera sees it."),
};
void build_area_light(const AreaLightInput& in, BlockContext& block) {
  Material material;
  material.color = Color3f(0);
  material.emission = Color3f(in.radiance.rgb);
  material.is_area_light = true;
  material.is_visible = in.visible;
  block.use_material(block.add_material(material));
  const Vector3d middle = in.origin + 0.5 * in.width + 0.5 * in.height;
  block.add_shape([&] { return make_quad(in.origin, in.width, in.height, block.placed(middle)); });
}

KindRow light(KindRow row, std::string_view variant) {
  row.variant = variant;
  row.placing = Placing::kRigid;
  return row;
}

// What a point has not: a size.
KindRow area_light(KindRow row) {
  row = light(std::move(row), "area");
  row.placing = Placing::kAffine;
  return row;
}

}  // namespace

std::span<const KindRow> light_kinds() {
  static const KindRow rows[] = {
      light(kind<LightInput, build_point_light>("light", "A point that shines all around.", kPointLight), ""),
      light(kind<LightInput, build_point_light>("light", "The same, named in full.", kPointLight), "point"),
      light(kind<LightInput, build_directional_light>("light", "Parallel light from far away.",
                                                      kDirectionalLight),
            "directional"),
      light(kind<LightInput, build_spot_light>("light", "A point that shines within a cone.", kSpotLight),
            "spot"),
      area_light(kind<AreaLightInput, build_area_light>(
          "light", "A bright parallelogram, which shines on one side and reflects nothing.", kAreaLight)),
  };
  return rows;
}

}  // namespace raytracer::scene_file
