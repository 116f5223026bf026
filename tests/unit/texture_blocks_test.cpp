// Sixteen points are asked at once as each would be alone, to the last bit.
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image/picture.hpp"
#include "make_meshes.hpp"
#include "raytracer/scene_file.hpp"
#include "raytracer/shapes.hpp"
#include "scene/texture_queries.hpp"
#include "textures/image_texture.hpp"
#include "textures/patterns.hpp"
#include "textures/texture_block.hpp"

using namespace raytracer;

namespace {

struct Random {
  std::mt19937 engine{11};
  float in(float low, float high) {
    return low + (high - low) * static_cast<float>(engine() >> 8U) * 0x1p-24F;
  }
  Vector3f vector(float size) {
    const float x = in(-size, size), y = in(-size, size);
    return {x, y, in(-size, size)};
  }
};

struct Named {
  std::string name;
  TexturePointer texture;
};

PatternSetup setup(PatternMap map, float scale = 1) {
  PatternSetup result{Color3f(0.9F, 0.5F, 0.1F), Color3f(0.2F, 0.3F, 0.8F), {}};
  result.space.map = map;
  result.space.linear = glm::mat3(scale * 0.8F, 0.1F, 0, -0.3F, scale, 0.2F, 0, 0.1F, scale * 1.3F);
  result.space.translation = {0.3F, -0.2F, 0.7F};
  return result;
}

std::vector<Named> patterns(PatternMap map, float scale) {
  const auto of = [&] { return setup(map, scale); };
  std::vector<Named> all = {{"checker", make_checker(of())},
                            {"stripes", make_stripes(of(), 0.3F)},
                            {"brick", make_brick(of(), {})},
                            {"linear gradient", make_gradient(of(), GradientShape::kLinear)},
                            {"radial gradient", make_gradient(of(), GradientShape::kRadial)},
                            {"angle gradient", make_gradient(of(), GradientShape::kAngle)},
                            {"marble", make_marble(of(), 0.6F, 4)},
                            {"marble of other veins", make_marble(of(), 0.2F, 0.7F)},
                            {"wood", make_wood(of(), 0.3F)},
                            {"granite", make_granite(of())},
                            {"distances of cells", make_cells(of(), CellSort::kDistance, 1, 0.1F)},
                            {"borders of cells", make_cells(of(), CellSort::kBorders, 0.5F, 0.1F)},
                            {"flat cells", make_cells(of(), CellSort::kFlat, 1, 0.1F)},
                            {"dots", make_dots(of(), 0.3F)}};
  for (const NoiseSort sort : {NoiseSort::kFbm, NoiseSort::kTurbulence, NoiseSort::kRidged}) {
    for (const float warp : {0.0F, 0.4F}) {
      all.push_back({"noise", make_noise(of(), {sort, 5, 0.6F, warp, 1.3F})});
    }
  }
  PatternSetup nested = of();
  nested.a = TextureInput(make_checker(of()));
  nested.b = TextureInput(make_noise(of(), {}));
  all.push_back({"stripes of textures", make_stripes(std::move(nested), 0.5F)});
  all.push_back(
      {"ramp", make_ramp(make_noise(of(), {}),
                         {{0.2F, Color3f(1, 0, 0)}, {0.5F, Color3f(0, 1, 0)}, {0.8F, Color3f(0, 0, 1)}})});
  all.push_back({"ramp of textures",
                 make_ramp(make_noise(of(), {}), {{0.4F, make_checker(of())}, {0.6F, Color3f(0.1F)}})});
  Rescaling rescaling;
  rescaling.around = Color3f(0.5F);
  rescaling.factor = make_dots(of(), 0.4F);
  rescaling.least = 0.2F;
  rescaling.channels = {1, 1, 0};
  all.push_back({"rescaled", make_rescaled(make_checker(of()), rescaling)});
  return all;
}

TextureBlock random_block(Random& random, int count, bool is_rough, float size, float width) {
  TextureBlock block;
  block.count = count;
  block.is_rough = is_rough;
  for (int i = 0; i < count; ++i) {
    TexturePoint point;
    point.uv = Vector2f(random.vector(size));
    point.position = random.vector(size);
    point.normal = glm::normalize(random.vector(1) + Vector3f(1e-3F));
    const float here = width * random.in(0, 1) * random.in(0, 1);
    point.uv_dx = Vector2f(random.vector(here));
    point.uv_dy = Vector2f(random.vector(here));
    point.position_dx = random.vector(here);
    point.position_dy = random.vector(here);
    block.set(i, point);
  }
  return block;
}

bool is_same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }
bool are_same(const Color3f& a, const Color3f& b) {
  return is_same(a.x, b.x) && is_same(a.y, b.y) && is_same(a.z, b.z);
}

void require_same(const Named& named, const TextureBlock& block) {
  ColorBlock colors{};
  named.texture->colors_at(block, colors);
  for (int i = 0; i < block.count; ++i) {
    const Color3f alone = named.texture->at(block.at(i)), together = colors.at(i);
    INFO(named.name << ", lane " << i << " of " << block.count << (block.is_rough ? ", rough" : "") << ": "
                    << alone.x << " " << alone.y << " " << alone.z << " alone, " << together.x << " "
                    << together.y << " " << together.z << " together");
    REQUIRE(are_same(alone, together));
    if (named.texture->asks_uv()) continue;
    TexturePoint elsewhere = block.at(i);
    elsewhere.uv += Vector2f(0.37F, 0.61F);
    elsewhere.uv_dx = elsewhere.uv_dy = Vector2f(0);
    REQUIRE(are_same(alone, named.texture->at(elsewhere)));
  }
}

void require_same(const std::vector<Named>& all) {
  Random random;
  for (const Named& named : all) {
    for (const bool is_rough : {false, true}) {
      for (const float width : {0.0F, 0.05F, 0.5F, 3.0F}) {
        for (int round = 0; round < 12; ++round) {
          const int count = 1 + static_cast<int>(random.engine() % 16);
          require_same(named, random_block(random, count, is_rough, round % 3 == 0 ? 1e7F : 4.0F, width));
          require_same(named,
                       random_block(random, count, is_rough, 1e38F, width));  // beyond numbers, in places
        }
      }
    }
  }
}

std::shared_ptr<const Picture> random_picture(Random& random, TexelType type, int channels) {
  auto picture = std::make_shared<Picture>();
  picture->width = 13;
  picture->height = 9;
  picture->channels = channels;
  picture->type = type;
  picture->data = std::make_unique<std::uint8_t[]>(picture->bytes());
  for (std::size_t i = 0; i < picture->bytes(); ++i) {
    picture->data[i] = static_cast<std::uint8_t>(random.engine() >> 24U);
  }
  if (type == TexelType::kFloat) {
    for (std::size_t i = 0; i + 4 <= picture->bytes(); i += 4) {
      const float value = random.in(0, 2);
      std::memcpy(picture->data.get() + i, &value, 4);
    }
  }
  return picture;
}

}  // namespace

TEST_CASE("sixteen points of a pattern get what each gets alone", "[textures]") {
  require_same(patterns(PatternMap::kPosition, 1));
  require_same(patterns(PatternMap::kUv, 3));
}

TEST_CASE("textures say whether they ask for uv", "[textures]") {
  for (const Named& solid : patterns(PatternMap::kPosition, 1)) CHECK_FALSE(solid.texture->asks_uv());
  for (const Named& flat : patterns(PatternMap::kUv, 1)) {
    CHECK(flat.texture->asks_uv());
    PatternSetup around = setup(PatternMap::kPosition);
    around.b = TextureInput(flat.texture);
    CHECK(make_checker(std::move(around))->asks_uv());
  }
}

TEST_CASE("patterns in patterns cost a block no more than its points", "[textures]") {
  TexturePointer texture = make_checker(setup(PatternMap::kPosition));
  for (int depth = 0; depth < 200; ++depth) {
    PatternSetup both = setup(PatternMap::kPosition, 1 + 0.01F * static_cast<float>(depth));
    both.a = both.b = TextureInput(texture);
    texture = make_checker(std::move(both));
  }
  Random random;
  require_same({"chain", texture}, random_block(random, 16, true, 4, 0.1F));
}

TEST_CASE("sixteen points of a picture get what each gets alone", "[textures]") {
  Random random;
  std::vector<Named> all;
  for (const TextureWrap wrap : {TextureWrap::kRepeat, TextureWrap::kMirror, TextureWrap::kClamp}) {
    for (const int channels : {1, 3, 4}) {
      for (const TexelType type : {TexelType::kByte, TexelType::kShort, TexelType::kFloat}) {
        TexturePlacement placement;
        placement.wrap = wrap;
        placement.rotate = 30;
        placement.scale = {0.7F, 1.4F};
        placement.offset = {0.2F, -0.1F};
        for (const TextureChannel channel : {TextureChannel::kAll, TextureChannel::kMean}) {
          TexelUse use;
          use.channel = channel;
          all.push_back(
              {"picture",
               make_image_texture(make_pyramid(random_picture(random, type, channels), use), placement)});
        }
      }
    }
  }
  require_same(all);
}

namespace {

// Shapes with u and v, and a mesh without.
SceneDescription some_shapes() {
  SceneDescription scene;
  scene.materials.emplace_back();
  const auto add = [&](std::unique_ptr<Shape> shape) {
    scene.shapes.push_back(std::move(shape));
    scene.material_of.push_back(0);
  };
  add(make_sphere({0, 0, 0}, 1, {}));
  add(make_quad({-3, -1, -3}, {6, 0, 1}, {0, 0.5, 6}, {}));
  add(make_cube({2, 0, 0}, {1, 1, 1}, {}));
  add(make_mesh(cube_mesh(), {glm::dmat3(0.4), Vector3d(-2, 0, 0)}));
  return scene;
}

RayCone some_cone(Random& random) {
  RayCone cone;
  cone.spread = {random.in(0, 0.01F), random.in(0, 0.01F), false};
  cone.edges.origin_dx = random.vector(1e-3F);
  cone.edges.direction_dx = random.vector(1e-2F);
  if (random.in(0, 1) < 0.8F) cone.edges.direction_dy = random.vector(1e-2F);
  return cone;
}

}  // namespace

TEST_CASE("sixteen points of a formula get what each gets alone", "[textures]") {
  std::vector<Named> all;
  std::vector<LoadedScene> scenes;
  for (const std::string formula :
       {"0.5 + 0.3 * sin(360 * u) * cos(180 * v) + 0.1 * tan(p.x)", "abs(n) * (p.x % 1, p.y, -p.z / v)",
        "noise(4 * p) * random(floor(p.x), floor(p.y)) + length(p) - dot(p, n)",
        "p.x < 0.2 or v > 0.5 ? normalize(p) : (u, v, max(p.x, p.y) ^ 1.5)",
        "mix(clamp(p.y, 0, 1), smoothstep(0, 1, u), round(v)) + sqrt(u) + exp(-p.x * p.x)"}) {
    scenes.push_back(load_scene_text("sphere { material { color (" + formula + ") } }", "formula"));
    INFO(formula);
    REQUIRE(scenes.back().ok());
    const SceneDescription& description = scenes.back().scene_at(0)->description();
    all.push_back({formula, description.materials[description.material_of[0]].textures->color});
  }
  require_same(all);
}

TEST_CASE("textures are asked where each hit alone would ask them", "[textures]") {
  const Scene scene(some_shapes());
  Random random;
  for (int round = 0; round < 400; ++round) {
    TextureQueries queries;
    queries.is_rough = round % 2 == 0;
    std::vector<TexturePoint> alone;
    Vector3Block position{}, normal{};
    while (queries.count < 16) {
      const Vector3f origin = random.vector(4) + Vector3f(0, 3, 0);
      const Ray3f ray{origin, glm::normalize(Vector3f(random.vector(2)) - origin)};
      Hit hit;
      if (!scene.is_hit(ray, hit)) continue;
      const SurfacePoint surface = scene.surface_at(ray, hit);
      const RayCone cone = some_cone(random);
      if (!queries.is_rough && !cone.is_one_of_many()) continue;
      if (surface.normal != surface.shading_normal) continue;
      position.set(queries.count, surface.position);
      normal.set(queries.count, surface.normal);
      queries.set_detail(queries.count, scene.detail_at(ray, hit));
      if (queries.is_rough) {
        Footprint footprint;
        footprint.is_rough = true;
        footprint.width = random.in(1e-3F, 1);
        queries.width[queries.count] = footprint.width;
        alone.push_back(scene.texture_point(ray, hit, footprint, surface));
      } else {
        queries.set_seen(queries.count, ray, hit.t, cone);
        alone.push_back(scene.texture_point(ray, hit, cone.footprint_at(hit.t), surface));
      }
      ++queries.count;
    }
    TextureBlock block;
    texture_points(queries, position, normal, block);
    REQUIRE(block.is_rough == queries.is_rough);
    for (int i = 0; i < queries.count; ++i) {
      const TexturePoint together = block.at(i), one = alone[static_cast<std::size_t>(i)];
      CHECK(together.uv == one.uv);
      CHECK(together.position == one.position);
      CHECK(together.normal == one.normal);
      CHECK(together.uv_dx == one.uv_dx);
      CHECK(together.uv_dy == one.uv_dy);
      CHECK(together.position_dx == one.position_dx);
      CHECK(together.position_dy == one.position_dy);
    }
  }
}
