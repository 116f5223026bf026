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
constexpr Range kFieldOfView{0.001, 360, false};
constexpr double kWidestFlat = 179;  // degrees: beyond, no flat picture shows it
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
  Projection projection = Projection::kPerspective;
  std::optional<double> width;
  double aperture = 0;
  std::optional<double> f_number, focal_length, focus;
  std::string focus_on;
  int blades = 0;
  double blade_rotate = 0;
  std::array<double, 2> shift{0, 0}, tilt{0, 0};
  double stereo = 0;
  std::optional<double> iso, shutter_speed;
  double shutter = 0;
};
constexpr std::string_view kProjections[] = {"perspective", "orthographic", "fisheye", "panorama",
                                             "cube_map"};
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
    property<&CameraInput::projection>("projection", "How what is around the eye becomes a flat picture.")
        .one_of(kProjections),
    property<&CameraInput::width>("width", "Of what an orthographic camera shows.")
        .in(kLength)
        .within(kPositive)
        .or_else("as wide as fov shows at look_at"),
    property<&CameraInput::aperture>("aperture", "The radius of the lens; 0 shows everything sharp.")
        .in(kLength)
        .within(kNotNegative),
    property<&CameraInput::focal_length>("focal_length", "With f_number, in place of aperture.")
        .in(kLength)
        .within(kPositive)
        .or_else("not given"),
    property<&CameraInput::f_number>("f_number", "The focal length divided by the lens's diameter.")
        .within(kPositive)
        .or_else("not given"),
    property<&CameraInput::focus>("focus", "How far away what is sharp is, along the view.")
        .in(kLength)
        .within(kPositive)
        .or_else("the distance to look_at"),
    property<&CameraInput::focus_on>("focus_on", "The name of a shape to be sharp, in place of focus.")
        .as(PropertyType::kName)
        .or_else("not given"),
    property<&CameraInput::blades>("blades", "The corners of the lens's opening; 0 is round.")
        .within({0, 100}),
    property<&CameraInput::blade_rotate>("blade_rotate", "Turns them, counter-clockwise.").in(kDegrees),
    property<&CameraInput::shift>("shift",
                                  "Moves the view right and up, in widths and heights of the picture.")
        .within({-100, 100}),
    property<&CameraInput::tilt>("tilt", "Turns the plane that is sharp: the right, and the top, away.")
        .in(kDegrees)
        .within({-89, 89}),
    property<&CameraInput::stereo>("stereo", "How far two eyes are apart; the left one's picture is left.")
        .in(kLength)
        .within(kNotNegative),
    property<&CameraInput::iso>("iso",
                                "Path alone: the film's speed; with it the exposure is a photograph's.")
        .within({1, 1e7})
        .or_else("100")
        .only_in(Method::kPath),
    property<&CameraInput::shutter_speed>("shutter_speed", "Likewise: how long the film is exposed.")
        .in("seconds")
        .within({1e-6, 1e6})
        .or_else("1")
        .only_in(Method::kPath),
    property<&CameraInput::shutter>("shutter",
                                    "The share of a frame's time that it is open: blurs what moves.")
        .within(kShare),
};
// The lens and all else but where it looks; nothing where that contradicts itself, which has been reported.
std::optional<Optics> optics_of(const CameraInput& in, BlockContext& block) {
  Optics optics;
  optics.projection = in.projection;
  optics.lens_radius = in.aperture;
  if (in.focal_length) {
    if (!in.f_number || block.is_given("aperture")) {
      block.error(in.f_number ? "aperture" : "focal_length",
                  "a lens has either 'aperture' or 'focal_length' and 'f_number'",
                  in.f_number ? "remove 'aperture'" : "f_number 2.8");
      return std::nullopt;
    }
    optics.lens_radius = *in.focal_length / (2 * *in.f_number);
  } else if (in.f_number && !in.iso && !in.shutter_speed) {
    block.error("f_number", "'f_number' needs 'focal_length' to make a lens, or 'iso' to make an exposure",
                "focal_length 0.05");
    return std::nullopt;
  }
  optics.blades = in.blades;
  optics.blade_turn = glm::radians(in.blade_rotate);
  optics.shift_x = in.shift[0];
  optics.shift_y = in.shift[1];
  optics.tilt_x = glm::radians(in.tilt[0]);
  optics.tilt_y = glm::radians(in.tilt[1]);
  optics.eye_distance = in.stereo;
  return optics;
}

// In stops: none at ISO 100, one second and f/1 (ISO 2720: the exposure is time * speed / f-number^2).
double exposure_of(const CameraInput& in) {
  if (!in.iso && !in.shutter_speed) return 0;
  const double f_number = in.f_number.value_or(1);
  return std::log2(in.shutter_speed.value_or(1) * in.iso.value_or(100) / 100 / (f_number * f_number));
}

void build_camera(const CameraInput& in, BlockContext& block) {
  if (in.fov && in.vertical_fov) {
    return block.error("vertical_fov", "a camera has either 'fov' or 'vertical_fov'", "remove one of them");
  }
  for (const std::string_view word : {"fov", "vertical_fov"}) {
    const double angle = (word == "fov" ? in.fov : in.vertical_fov).value_or(0);
    if (angle <= kWidestFlat || in.projection == Projection::kFisheye) continue;
    return block.value_error(
        word, fmt::format("'{}' must be between 0.001 and {}, found {}", word, kWidestFlat, angle),
        "projection fisheye shows more");
  }
  if (in.focus && !in.focus_on.empty()) {
    return block.error("focus_on", "a camera has either 'focus' or 'focus_on'", "remove one of them");
  }
  const std::optional<Optics> optics = optics_of(in, block);
  if (!optics) return;
  const Transform world = block.placed(in.position);
  CameraDraft camera;
  camera.optics = *optics;
  camera.width = in.width;
  camera.focus = in.focus;
  camera.focus_on = in.focus_on;
  camera.focus_place = block.place_of("focus_on");
  camera.exposure = exposure_of(in);
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
        .within(kBrightness)
        .only_in(Method::kClassic),
    property<&RenderInput::sampling>("sampling",
                                     "Path alone: what chooses the directions to look for light in.")
        .one_of(kSamplings)
        .only_in(Method::kPath),
    property<&RenderInput::clamp>(
        "clamp", "Path alone: the most that a path adds after its first bounce; 0: no limit.")
        .within(kBrightness)
        .only_in(Method::kPath),
    property<&RenderInput::exposure>("exposure", "Path alone: brightens the picture; 1 doubles its light.")
        .in("stops")
        .within(kExposure)
        .only_in(Method::kPath),
    property<&RenderInput::tone>("tone", "Path alone: the curve that brings bright light into the picture.")
        .one_of(kTones)
        .only_in(Method::kPath),
    property<&RenderInput::white_balance>("white_balance",
                                          "Path alone: the light that shall look white, or its temperature.")
        .within(kBrightness)
        .in("or kelvin")
        .or_else("1")
        .only_in(Method::kPath),
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
