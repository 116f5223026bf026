// The rows of all that is no shape: settings, lights, material, group.
#include <fmt/format.h>

#include <cmath>

#include "raytracer/error.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/kinds.hpp"

namespace raytracer::scene_file {
namespace {

constexpr std::string_view kLength = "scene units";
constexpr std::string_view kDegrees = "degrees";
constexpr Range kFieldOfView{0.001, 179, false};
constexpr Range kBrightness{0, 1e24, false};  // a quadratic light for lengths in the millions is beyond 1e15

struct ImageInput {
  std::array<int, 2> size{960, 540};
};
constexpr PropertyRow kImage[] = {
    property<&ImageInput::size>("size", "Width and height of the picture.").in("pixels").within({1, 65536}),
};
void build_image(const ImageInput& in, BlockContext& block) { block.draft().image_size = in.size; }

struct CameraInput {
  Vector3d position{0};
  std::optional<Vector3d> look_at;
  Vector3d up{0, 1, 0};
  std::optional<double> fov, vertical_fov;
  double shutter = 0;
};
constexpr PropertyRow kCamera[] = {
    property<&CameraInput::position>("position", "Where the eye is.").in(kLength),
    property<&CameraInput::look_at>("look_at", "The point in the middle of the picture.")
        .in(kLength)
        .as(PropertyType::kVector)
        .or_else("along -z"),
    property<&CameraInput::up>("up", "Which way is up in the picture."),
    property<&CameraInput::fov>("fov", "The horizontal field of view.")
        .in(kDegrees)
        .within(kFieldOfView)
        .or_else("50"),
    property<&CameraInput::vertical_fov>("vertical_fov", "The vertical field of view, in place of fov.")
        .in(kDegrees)
        .within(kFieldOfView)
        .or_else("follows from fov"),
    property<&CameraInput::shutter>("shutter",
                                    "The share of a frame's time that it is open: blurs what moves.")
        .within(kShare),
};
void build_camera(const CameraInput& in, BlockContext& block) {
  if (in.fov && in.vertical_fov) {
    return block.error("vertical_fov", "a camera has either 'fov' or 'vertical_fov'", "remove one of them");
  }
  const Transform world = block.placed(in.position);
  CameraDraft camera;
  camera.name = block.name();
  camera.place = block.header();
  camera.position = world.point(in.position);
  camera.look_at = world.point(in.look_at.value_or(in.position + Vector3d(0, 0, -1)));
  camera.up = world.vector(in.up);
  camera.fov_degrees = in.fov;
  camera.vertical_fov_degrees = in.vertical_fov;
  camera.shutter = in.shutter;
  const Vector3d view = camera.look_at - camera.position;
  if (glm::length(view) == 0) {
    return block.error("look_at", "the camera looks at the point where it stands",
                       "'position' and 'look_at' must differ");
  }
  if (glm::length(in.up) == 0) return block.error("up", "'up' has no length", "up 0 1 0");
  const double sine = glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up)));
  if (!(sine > 1e-6)) {
    return block.error("up", "the camera looks along its 'up'", "turn 'up' aside: up 0 0 -1");
  }
  block.draft().cameras.push_back(std::move(camera));
}

struct RenderInput {
  Method method = Method::kClassic;
  int samples = 1, bounces = 8;
  std::optional<double> epsilon;
  int seed = 0;
  ColorValue ambient{Vector3d(0)};
};
constexpr std::string_view kMethods[] = {"classic"};
constexpr PropertyRow kRender[] = {
    property<&RenderInput::method>("method", "How light is computed.").one_of(kMethods),
    property<&RenderInput::samples>("samples", "Rays per pixel; more than one smooth the edges.")
        .within({1, 1'000'000}),
    property<&RenderInput::bounces>("bounces", "Reflections followed; black after.").within({0, 1000}),
    property<&RenderInput::epsilon>("epsilon", "How far along the normal shadow and mirror rays start.")
        .in(kLength)
        .within(kNotNegative)
        .or_else("follows the rounding error"),
    property<&RenderInput::seed>("seed", "Another seed, other sample points.").within({0, 2147483647}),
    property<&RenderInput::ambient>("ambient", "Light from everywhere; 1 shows surfaces in their own colour.")
        .within(kBrightness),
};
void build_render(const RenderInput& in, BlockContext& block) {
  RenderDraft& render = block.draft().render;
  render.method = in.method;
  render.samples = in.samples;
  render.bounces = in.bounces;
  render.epsilon = in.epsilon;
  render.seed = in.seed;
  render.ambient = in.ambient;
}

struct BackgroundInput {
  ColorValue color{Vector3d(0)};
};
constexpr PropertyRow kBackground[] = {
    property<&BackgroundInput::color>("color", "What is seen where nothing is.").within(kBrightness),
};
void build_background(const BackgroundInput& in, BlockContext& block) {
  block.draft().scene.background = Color3f(in.color.rgb);
}

struct AnimationInput {
  double duration = 0, fps = 24;
};
constexpr PropertyRow kAnimation[] = {
    property<&AnimationInput::duration>("duration", "How long it lasts.")
        .in("seconds")
        .within({0, 1e6, true})
        .must_be_given(),
    property<&AnimationInput::fps>("fps", "Frames per second.").within({0.001, 1000}),
};
void build_animation(const AnimationInput& in, BlockContext& block) {
  block.draft().duration = in.duration;
  block.draft().fps = in.fps;
}

struct LightInput {
  Vector3d position{0};
  ColorValue color{Vector3d(1)};
  double intensity = 1000;
  Falloff falloff = Falloff::kLinear;
  // of a spot, or of a directional light
  std::optional<Vector3d> look_at, direction;
  double angle = 45, soft_edge = 0;
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

constexpr PropertyRow kPointLight[] = {kLightPosition, kLightColor, kLightIntensity, kLightFalloff};
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
};

Light make_light(const LightInput& in, Light::Kind kind) {
  Light light;
  light.kind = kind;
  light.falloff = in.falloff;
  light.lambda = Color3f(in.intensity * in.color.rgb);
  return light;
}

void build_point_light(const LightInput& in, BlockContext& block) {
  Light light = make_light(in, Light::Kind::kPoint);
  light.position = Vector3f(block.placed(in.position).point(in.position));
  block.add_light(light);
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
  Light light = make_light(in, Light::Kind::kDirectional);
  const std::optional<Vector3f> direction = world_direction(in, block);
  if (!direction) return;
  light.direction = *direction;
  block.add_light(light);
}

void build_spot_light(const LightInput& in, BlockContext& block) {
  if (in.look_at && in.direction) {
    return block.error("direction", "a spot has either 'look_at' or 'direction'", "remove one of them");
  }
  Light light = make_light(in, Light::Kind::kSpot);
  light.position = Vector3f(block.placed(in.position).point(in.position));
  const std::optional<Vector3f> direction = world_direction(in, block);
  if (!direction) return;
  light.direction = *direction;
  const double half_angle = glm::radians(in.angle / 2);
  light.cos_outer = static_cast<float>(std::cos(half_angle));
  light.cos_inner = static_cast<float>(std::cos(half_angle * (1 - in.soft_edge)));
  block.add_light(light);
}

struct MaterialInput {
  ColorValue color{Vector3d(0.8)};
  double shininess = 0;
};
constexpr PropertyRow kMaterial[] = {
    property<&MaterialInput::color>("color", "The share of light that it returns.").within(kShare),
    property<&MaterialInput::shininess>("shininess", "0 is matt, 1 all mirror, between is partly both."),
};
void build_material(const MaterialInput& in, BlockContext& block) {
  Material material;
  material.color = Color3f(in.color.rgb);
  material.shininess = static_cast<float>(in.shininess);
  block.add_material(material);
}

struct GroupInput {};
void build_group(const GroupInput&, BlockContext& block) { block.build_children(); }

KindRow setting(KindRow row, Placing placing = Placing::kNone) {
  row.block_class = BlockClass::kSetting;
  row.placing = placing;
  return row;
}

KindRow light(KindRow row, std::string_view variant) {
  row.variant = variant;
  row.placing = Placing::kRigid;
  return row;
}

}  // namespace

std::span<const KindRow> setting_kinds() {
  static const KindRow rows[] = {
      setting(kind<ImageInput, build_image>("image", "The picture's size.", kImage)),
      setting(kind<CameraInput, build_camera>("camera", "Where the picture is taken from.", kCamera),
              Placing::kRigid),
      setting(kind<RenderInput, build_render>("render", "How the picture is computed.", kRender)),
      setting(
          kind<BackgroundInput, build_background>("background", "What is behind everything.", kBackground)),
      setting(kind<AnimationInput, build_animation>("animation", "How much time there is.", kAnimation)),
  };
  return rows;
}

std::span<const KindRow> light_kinds() {
  static const KindRow rows[] = {
      light(kind<LightInput, build_point_light>("light", "A point that shines all around.", kPointLight), ""),
      light(kind<LightInput, build_point_light>("light", "The same, named in full.", kPointLight), "point"),
      light(kind<LightInput, build_directional_light>("light", "Parallel light from far away.",
                                                      kDirectionalLight),
            "directional"),
      light(kind<LightInput, build_spot_light>("light", "A point that shines within a cone.", kSpotLight),
            "spot"),
  };
  return rows;
}

std::span<const KindRow> material_kinds() {
  static const KindRow rows[] = {[] {
    KindRow row = kind<MaterialInput, build_material>("material", "What a surface is made of.", kMaterial);
    row.block_class = BlockClass::kMaterial;
    return row;
  }()};
  return rows;
}

std::span<const KindRow> group_kinds() {
  static const KindRow rows[] = {[] {
    KindRow row =
        kind<GroupInput, build_group>("group", "Blocks that move together and share a material.", {});
    row.placing = Placing::kAffine;
    row.takes_material = true;
    row.has_children = true;
    return row;
  }()};
  return rows;
}

}  // namespace raytracer::scene_file
