// The rows of the textures. What the numbers mean stands in textures/patterns.hpp and image_texture.hpp.
#include <algorithm>

#include "scene_file/builder.hpp"
#include "scene_file/kinds.hpp"
#include "textures/image_texture.hpp"
#include "textures/patterns.hpp"

namespace raytracer::scene_file {
namespace {

constexpr Range kOctaves{1, 16, false};
constexpr Range kSomeShare{0, 1, true};

float number(double x) { return static_cast<float>(x); }

TextureInput input_of(const ColorOrTexture& value) {
  if (value.texture) return TextureInput(value.texture);
  return TextureInput(Color3f(value.rgb));
}

// --- patterns of two colours
// --------------------------------------------------------------------------------

// Of all kinds, each of which has rows for some.
struct PatternInput {
  ColorOrTexture a{Vector3d(1), nullptr}, b{Vector3d(0), nullptr};
  PatternMap map = PatternMap::kPosition;
  double stripe_width = 0.5;
  double brick_height = 0.4, mortar = 0.05, offset = 0.5;
  GradientShape gradient = GradientShape::kLinear;
  NoiseSort noise = NoiseSort::kFbm;
  int octaves = 6;
  double gain = 0.5, warp = 0, contrast = 1.5;
  double marble_turbulence = 1, sharpness = 3;
  double wood_turbulence = 0.3;
  CellSort cells = CellSort::kFlat;
  double jitter = 1, border = 0.1;
  double radius = 0.25;
};

constexpr PropertyRow color_a(std::string_view help) {
  return property<&PatternInput::a>("a", help).within(kNotNegative);
}
constexpr PropertyRow color_b(std::string_view help) {
  return property<&PatternInput::b>("b", help).within(kNotNegative);
}
constexpr std::string_view kMaps[] = {"position", "uv"};
constexpr PropertyRow kMap =
    property<&PatternInput::map>("map", "Lies in the world, or on the surface's u and v.").one_of(kMaps);

constexpr PropertyRow kChecker[] = {color_a("The colour of the one half of its cubes, of edge 1."),
                                    color_b("That of the other."), kMap};
constexpr PropertyRow kStripes[] = {
    color_a("The first stripe of each period of 1 along x."), color_b("The other."), kMap,
    property<&PatternInput::stripe_width>("width", "How much of it the first fills.").within(kShare)};
constexpr PropertyRow kBrick[] = {
    color_a("The bricks; each is 1 long, with its mortar."),
    color_b("The mortar."),
    kMap,
    property<&PatternInput::brick_height>("height", "Of a row, with its mortar.").within({0, 1000, true}),
    property<&PatternInput::mortar>("mortar", "How wide it is.").within({0, 0.5, false}),
    property<&PatternInput::offset>("offset", "Of each row against the one below.").within(kShare),
};
constexpr std::string_view kGradients[] = {"linear", "radial", "angle"};
constexpr PropertyRow kGradient[] = {
    color_a("The colour where it begins."), color_b("Where it ends."), kMap,
    property<&PatternInput::gradient>("shape", "From y 0 to 1, from the middle outwards, or around y.")
        .one_of(kGradients)};
constexpr std::string_view kNoises[] = {"fbm", "turbulence", "ridged"};
constexpr PropertyRow kNoise[] = {
    color_a("The colour where it is low."),
    color_b("Where it is high."),
    kMap,
    property<&PatternInput::noise>("sort", "Clouds, billows or crests.").one_of(kNoises),
    property<&PatternInput::octaves>("octaves", "How many sizes of detail, each half the one before.")
        .within(kOctaves),
    property<&PatternInput::gain>("gain", "The strength of each against the one before.").within(kSomeShare),
    property<&PatternInput::warp>("warp", "How far it is bent by noise of its own.").within({-100, 100}),
    property<&PatternInput::contrast>("contrast", "Spreads it to both sides of its mean.").within({0, 100}),
};
constexpr PropertyRow kMarble[] = {
    color_a("The stone."), color_b("The veins, one each 1 along x."), kMap,
    property<&PatternInput::marble_turbulence>("turbulence", "How much they are bent.").within({0, 100}),
    property<&PatternInput::sharpness>("sharpness", "How thin they are.").within({0.01, 30})};
constexpr PropertyRow kWood[] = {
    color_a("The wood."), color_b("The rings around y, 1 apart."), kMap,
    property<&PatternInput::wood_turbulence>("turbulence", "How much they are bent.").within({0, 100})};
constexpr PropertyRow kGranite[] = {color_a("The one end of what its grains, of size 1 and less, are."),
                                    color_b("The other end."), kMap};
constexpr std::string_view kCells[] = {"distance", "borders", "flat"};
constexpr PropertyRow kCellRows[] = {
    color_a("Where a cell begins; with borders its inside."),
    color_b("Where it ends; with borders these."),
    kMap,
    property<&PatternInput::cells>("sort", "Shades from the middle, the borders, or a shade for each.")
        .one_of(kCells),
    property<&PatternInput::jitter>("jitter", "0 is a regular lattice of edge 1.").within(kShare),
    property<&PatternInput::border>("border", "How wide the borders are.").within(kShare),
};
constexpr PropertyRow kDots[] = {
    color_a("The dots, one in each square of edge 1."), color_b("What is between them."), kMap,
    property<&PatternInput::radius>("radius", "Of a dot.").within({0, 0.5, true})};

PatternSetup setup_of(const PatternInput& in, const BlockContext& block) {
  PatternSetup setup{input_of(in.a), input_of(in.b), {}};
  const Transform own = block.own_placing().inverse();
  setup.space.map = in.map;
  setup.space.linear = glm::mat3(own.linear);
  setup.space.translation = Vector3f(own.translation);
  return setup;
}

template <TexturePointer (*Make)(const PatternInput& in, PatternSetup setup)>
void build_pattern(const PatternInput& in, BlockContext& block) {
  block.set_texture(Make(in, setup_of(in, block)));
}

TexturePointer checker(const PatternInput&, PatternSetup setup) { return make_checker(std::move(setup)); }
TexturePointer stripes(const PatternInput& in, PatternSetup setup) {
  return make_stripes(std::move(setup), number(in.stripe_width));
}
TexturePointer brick(const PatternInput& in, PatternSetup setup) {
  return make_brick(std::move(setup), {number(in.brick_height), number(std::min(in.mortar, in.brick_height)),
                                       number(in.offset)});
}
TexturePointer gradient(const PatternInput& in, PatternSetup setup) {
  return make_gradient(std::move(setup), in.gradient);
}
TexturePointer noise(const PatternInput& in, PatternSetup setup) {
  return make_noise(std::move(setup),
                    {in.noise, in.octaves, number(in.gain), number(in.warp), number(in.contrast)});
}
TexturePointer marble(const PatternInput& in, PatternSetup setup) {
  return make_marble(std::move(setup), number(in.marble_turbulence), number(in.sharpness));
}
TexturePointer wood(const PatternInput& in, PatternSetup setup) {
  return make_wood(std::move(setup), number(in.wood_turbulence));
}
TexturePointer granite(const PatternInput&, PatternSetup setup) { return make_granite(std::move(setup)); }
TexturePointer cells(const PatternInput& in, PatternSetup setup) {
  return make_cells(std::move(setup), in.cells, number(in.jitter), number(in.border));
}
TexturePointer dots(const PatternInput& in, PatternSetup setup) {
  return make_dots(std::move(setup), number(in.radius));
}

// --- ramp
// ---------------------------------------------------------------------------------------------------

struct RampInput {
  ColorOrTexture by{Vector3d(0), nullptr};
  std::vector<StopValue> stop;
};
constexpr PropertyRow kRamp[] = {
    property<&RampInput::by>("by", "The texture, or expression, that chooses the colour.")
        .within(kAnyNumber)
        .must_be_given(),
    property<&RampInput::stop>("stop", "A value of it and the colour there; given for each.").must_be_given(),
};
void build_ramp(const RampInput& in, BlockContext& block) {
  std::vector<RampStop> stops;
  for (const StopValue& stop : in.stop) {
    if (!stops.empty() && !(number(stop.at) > stops.back().at)) {
      return block.error("stop", "the stops of a ramp go upwards, from the least value to the greatest",
                         "stop 0 black  stop 1 white");
    }
    stops.push_back({number(stop.at), TextureInput(Color3f(stop.rgb))});
  }
  block.set_texture(make_ramp(input_of(in.by), std::move(stops)));
}

// --- pictures
// -----------------------------------------------------------------------------------------------

struct PictureInput {
  FileName file;
  TextureWrap wrap = TextureWrap::kRepeat;
  std::array<double, 2> uv_scale{1, 1}, uv_offset{0, 0};
  double uv_rotate = 0;
  double scale = 1;
  TextureCurve curve = TextureCurve::kOfFile;
  TextureChannel channel = TextureChannel::kAll;
};
constexpr std::string_view kWraps[] = {"repeat", "mirror", "clamp"};
constexpr std::string_view kCurves[] = {"of_file", "srgb", "linear"};
constexpr std::string_view kChannels[] = {"all", "mean", "red", "green", "blue", "alpha"};
constexpr PropertyRow kPicture[] = {
    property<&PictureInput::file>("file", "A PNG, JPEG, Radiance HDR or EXR.").must_be_given(),
    property<&PictureInput::wrap>("wrap", "What it goes on as beyond its edges.").one_of(kWraps),
    property<&PictureInput::uv_scale>("uv_scale", "How often it stands between 0 and 1 along u and v.")
        .within({-1e6, 1e6}),
    property<&PictureInput::uv_offset>("uv_offset", "Where in the picture u and v of 0 are.")
        .within({-1e6, 1e6}),
    property<&PictureInput::uv_rotate>("uv_rotate",
                                       "Turns u and v, counter-clockwise, before they are scaled and moved.")
        .in("degrees"),
    property<&PictureInput::scale>("scale", "Grows it on the surface; the other way round of uv_scale.")
        .within({1e-6, 1e6}),
    property<&PictureInput::curve>("curve", "What its values are, whatever the file says.").one_of(kCurves),
    property<&PictureInput::channel>("channel", "Which of its channels counts.").one_of(kChannels),
};
void build_picture(const PictureInput& in, BlockContext& block) {
  const TexelUse use{block.texture_meaning(), in.curve, in.channel};
  const auto pyramid = block.pyramid("file", in.file.name, use);
  if (pyramid == nullptr) return;
  TexturePlacement placement;
  placement.scale = Vector2f(in.uv_scale[0] / in.scale, in.uv_scale[1] / in.scale);
  placement.offset = Vector2f(in.uv_offset[0], in.uv_offset[1]);
  placement.rotate = number(in.uv_rotate);
  placement.wrap = in.wrap;
  block.set_texture(make_image_texture(pyramid, placement));
}

KindRow texture(std::string_view variant, KindRow row, Placing placing = Placing::kAffine) {
  row.variant = variant;
  row.block_class = BlockClass::kTexture;
  row.placing = placing;
  return row;
}

template <TexturePointer (*Make)(const PatternInput& in, PatternSetup setup)>
KindRow pattern(std::string_view variant, std::string_view help, std::span<const PropertyRow> rows) {
  return texture(variant, kind<PatternInput, build_pattern<Make>>(kTextureKind, help, rows));
}

}  // namespace

std::span<const KindRow> texture_kinds() {
  static const KindRow rows[] = {
      texture("image", kind<PictureInput, build_picture>(kTextureKind, "A picture from a file.", kPicture),
              Placing::kNone),
      pattern<checker>("checker", "Cubes of two colours in turns.", kChecker),
      pattern<stripes>("stripes", "Two colours in turns.", kStripes),
      pattern<brick>("brick", "Bricks and mortar.", kBrick),
      pattern<gradient>("gradient", "From one colour to another.", kGradient),
      pattern<noise>("noise", "Clouds, billows or crests.", kNoise),
      pattern<marble>("marble", "Bent veins.", kMarble),
      pattern<wood>("wood", "Rings of years and fibres.", kWood),
      pattern<granite>("granite", "Grains of many shades.", kGranite),
      pattern<cells>("cells", "Cells around scattered points.", kCellRows),
      pattern<dots>("dots", "Round dots in rows.", kDots),
      texture("ramp",
              kind<RampInput, build_ramp>(kTextureKind, "Colours chosen by another texture's value.", kRamp),
              Placing::kNone),
  };
  return rows;
}

}  // namespace raytracer::scene_file
