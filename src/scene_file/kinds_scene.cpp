// The rows of all that is no shape: settings, lights, material, group.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "raytracer/error.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/colors.hpp"
#include "scene_file/kinds.hpp"
#include "scene_file/method.hpp"

namespace raytracer::scene_file {
namespace {

constexpr std::string_view kLength = "scene units";
constexpr std::string_view kDegrees = "degrees";
constexpr Range kFieldOfView{0.001, 179, false};
constexpr Range kExposure{-100, 100, false};

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
  std::optional<int> samples, bounces;
  Sampling sampling = Sampling::kBoth;
  double clamp = 0;
  std::optional<double> epsilon;
  int seed = 0;
  ColorValue ambient{Vector3d(0)};
  double exposure = 0;
  Tone tone = Tone::kNone;
  std::optional<ColorValue> white_balance;
};
constexpr std::string_view kSamplings[] = {"both", "lights", "materials"};
constexpr std::string_view kTones[] = {"none", "filmic", "agx", "aces"};
constexpr PropertyRow kRender[] = {
    property<&RenderInput::method>("method", "How light is computed: the paper's way, or as nature does.")
        .one_of(kMethodWords),
    property<&RenderInput::samples>("samples", "Rays per pixel: more smooth edges, and noise in path.")
        .within({1, 1'000'000})
        .or_else("1; in path 64"),
    property<&RenderInput::bounces>("bounces", "Reflections followed, black after; in path all scatterings.")
        .within({0, 1000})
        .or_else("8; in path without a limit"),
    property<&RenderInput::seed>("seed", "Another seed, other sample points.").within({0, 2147483647}),
    property<&RenderInput::epsilon>("epsilon", "How far along the normal shadow and mirror rays start.")
        .in(kLength)
        .within(kNotNegative)
        .or_else("follows the rounding error"),
    property<&RenderInput::ambient>(
        "ambient", "Classic alone: light from everywhere; 1 shows surfaces in their own colour.")
        .within(kBrightness),
    property<&RenderInput::sampling>("sampling",
                                     "Path alone: what chooses the directions to look for light in.")
        .one_of(kSamplings),
    property<&RenderInput::clamp>(
        "clamp", "Path alone: the most that a path adds after its first bounce; 0: no limit.")
        .within(kBrightness),
    property<&RenderInput::exposure>("exposure", "Path alone: brightens the picture; 1 doubles its light.")
        .in("stops")
        .within(kExposure),
    property<&RenderInput::tone>("tone", "Path alone: the curve that brings bright light into the picture.")
        .one_of(kTones),
    property<&RenderInput::white_balance>("white_balance",
                                          "Path alone: the light that shall look white, or its temperature.")
        .within(kBrightness)
        .in("or kelvin")
        .or_else("1"),
};

// A grey would balance nothing: one number is a temperature. Nothing where it is none, which has been told.
std::optional<Vector3d> white_of(const ColorValue& written, BlockContext& block) {
  constexpr double kColdest = 1000, kHottest = 40000;
  const Vector3d& c = written.rgb;
  const bool is_grey = c.x == c.y && c.y == c.z;
  if (!is_grey && std::min({c.x, c.y, c.z}) > 0) return c;
  if (c == Vector3d(1)) return c;
  if (is_grey && c.x >= kColdest && c.x <= kHottest) return black_body_color(c.x);
  block.error("white_balance",
              is_grey ? "'white_balance' takes a colour, or a temperature between 1000 and 40000 kelvin"
                      : "'white_balance' takes the colour of a light, which has some of red, green and blue",
              "white_balance 3200");
  return std::nullopt;
}

void build_render(const RenderInput& in, BlockContext& block) {
  RenderDraft& render = block.draft().render;
  if (in.white_balance) {
    const std::optional<Vector3d> white = white_of(*in.white_balance, block);
    if (!white) return;
    render.white = *white;
  }
  render.method = in.method;
  render.samples = in.samples;
  render.bounces = in.bounces;
  render.sampling = in.sampling;
  render.clamp = in.clamp;
  render.epsilon = in.epsilon;
  render.seed = in.seed;
  render.ambient = in.ambient;
  render.exposure = in.exposure;
  render.tone = in.tone;
  for (const std::string_view word : {"sampling", "clamp", "exposure", "tone", "white_balance"}) {
    if (block.is_given(word)) render.particular.push_back({word, Method::kPath, block.place_of(word)});
  }
  if (block.is_given("ambient"))
    render.particular.push_back({"ambient", Method::kClassic, block.place_of("ambient")});
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

struct GroupInput {};
void build_group(const GroupInput&, BlockContext& block) { block.build_children(); }

KindRow setting(KindRow row, Placing placing = Placing::kNone) {
  row.block_class = BlockClass::kSetting;
  row.placing = placing;
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
