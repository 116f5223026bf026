// Computed textures: known points, and what is left of them under a wide footprint.
#include "textures/patterns.hpp"

#include <cmath>
#include <random>

#include "catch.hpp"
#include "textures/fractal.hpp"

using namespace raytracer;

namespace {

PatternSetup setup(PatternMap map = PatternMap::kPosition) {
  PatternSetup result{Color3f(0), Color3f(1), {}};  // the colour is the share of b
  result.space.map = map;
  return result;
}

float at(const TexturePointer& texture, const Vector3f& position, float width = 0) {
  TexturePoint point;
  point.position = position;
  point.normal = {0, 0, 1};
  point.uv = {position.x, position.y};
  point.position_dx = {width, 0, 0};
  point.position_dy = {0, width, 0};
  point.uv_dx = {width, 0};
  point.uv_dy = {0, width};
  return texture->at(point).x;
}

// Over a square of that side around a place, by many points.
double mean(const TexturePointer& texture, const Vector3f& middle, float side) {
  constexpr int kSteps = 200;
  double sum = 0;
  for (int j = 0; j < kSteps; ++j) {
    for (int i = 0; i < kSteps; ++i) {
      const Vector3f offset =
          (Vector3f(i, j, 0) + Vector3f(0.5F, 0.5F, 0)) / float{kSteps} - Vector3f(0.5F, 0.5F, 0);
      sum += static_cast<double>(at(texture, middle + side * offset));
    }
  }
  return sum / (kSteps * kSteps);
}

}  // namespace

TEST_CASE("patterns at known points", "[textures]") {
  const struct {
    const char* name;
    TexturePointer texture;
    Vector3f position;
    float share;
  } known[] = {
      {"checker", make_checker(setup()), {0.5F, 0.5F, 0.5F}, 0},
      {"checker", make_checker(setup()), {1.5F, 0.5F, 0.5F}, 1},
      {"checker", make_checker(setup()), {1.5F, 1.5F, 0.5F}, 0},
      {"checker", make_checker(setup()), {-0.5F, 0.5F, 0.5F}, 1},
      {"checker on a face of the cube from 0 to 1", make_checker(setup()), {0.5F, 0.5F, 1}, 0},
      {"stripes", make_stripes(setup(), 0.3F), {0.29F, 7, 0}, 0},
      {"stripes", make_stripes(setup(), 0.3F), {0.31F, 7, 0}, 1},
      {"stripes", make_stripes(setup(), 0.3F), {-0.5F, 7, 0}, 1},
      {"brick", make_brick(setup(), {0.4F, 0.05F, 0.5F}), {0.5F, 0.2F, 0}, 0},
      {"brick, mortar beside", make_brick(setup(), {0.4F, 0.05F, 0.5F}), {0.97F, 0.2F, 0}, 1},
      {"brick, mortar above", make_brick(setup(), {0.4F, 0.05F, 0.5F}), {0.5F, 0.37F, 0}, 1},
      {"brick, next row", make_brick(setup(), {0.4F, 0.05F, 0.5F}), {0.97F, 0.6F, 0}, 0},
      {"brick, next row's mortar", make_brick(setup(), {0.4F, 0.05F, 0.5F}), {0.47F, 0.6F, 0}, 1},
      {"gradient", make_gradient(setup(), GradientShape::kLinear), {3, 0.25F, 0}, 0.25F},
      {"gradient, below", make_gradient(setup(), GradientShape::kLinear), {3, -5, 0}, 0},
      {"gradient, around", make_gradient(setup(), GradientShape::kRadial), {0.3F, 0.4F, 1e-4F}, 0.5F},
      {"gradient, angle", make_gradient(setup(), GradientShape::kAngle), {0, 0, 1}, 0.25F},
      {"noise at a whole place",
       make_noise(setup(PatternMap::kUv), {NoiseSort::kFbm, 1, 0.5F, 0, 1}),
       {3, 4, 0},
       0.5F},
      {"marble", make_marble(setup(), 0, 1), {0.25F, 0, 0}, 1},
      {"marble", make_marble(setup(), 0, 2), {0.5F, 0, 0}, 0.25F},
      {"dots", make_dots(setup(), 0.25F), {0.5F, 0.5F, 0}, 0},
      {"dots", make_dots(setup(), 0.25F), {0.5F, 0.8F, 0}, 1},
      {"cells in a lattice",
       make_cells(setup(PatternMap::kUv), CellSort::kDistance, 0, 0.1F),
       {0.5F, 0.8F, 0},
       0.3F},
      {"cells, a border", make_cells(setup(PatternMap::kUv), CellSort::kBorders, 0, 0.1F), {1, 0.5F, 0}, 1},
      {"cells, inside", make_cells(setup(PatternMap::kUv), CellSort::kBorders, 0, 0.1F), {0.6F, 0.5F, 0}, 0},
  };
  for (const auto& k : known) {
    INFO(k.name << " at " << k.position.x << ' ' << k.position.y << ' ' << k.position.z);
    CHECK(std::abs(at(k.texture, k.position) - k.share) < 2e-3F);
  }
}

TEST_CASE("patterns of edges are averaged over the footprint exactly", "[textures]") {
  std::mt19937 engine(3);
  const auto number = [&] { return static_cast<float>(engine()) * 0x1p-32F; };
  for (const TexturePointer& texture : {make_checker(setup()), make_stripes(setup(), 0.3F),
                                        make_dots(setup(), 0.3F), make_dots(setup(), 0.5F)}) {
    for (int i = 0; i < 20; ++i) {
      // The footprint's box is that of a square of side sqrt(1): its own edges.
      const Vector3f middle = {10 * number(), 10 * number(), 0.5F};
      const float side = 4 * number();
      CHECK(std::abs(static_cast<double>(at(texture, middle, side)) - mean(texture, middle, side)) < 0.012);
    }
  }
}

TEST_CASE("no pattern flickers under a wide footprint, and none changes its mean", "[textures]") {
  const TexturePointer textures[] = {make_checker(setup()),
                                     make_stripes(setup(), 0.3F),
                                     make_brick(setup(), {}),
                                     make_noise(setup(), {}),
                                     make_noise(setup(), {NoiseSort::kTurbulence, 4, 0.5F, 0, 1}),
                                     make_noise(setup(), {NoiseSort::kRidged, 4, 0.5F, 0, 1}),
                                     make_marble(setup(), 1, 3),
                                     make_wood(setup(), 0.3F),
                                     make_granite(setup()),
                                     make_cells(setup(), CellSort::kFlat, 1, 0.1F),
                                     make_cells(setup(), CellSort::kDistance, 1, 0.1F),
                                     make_cells(setup(), CellSort::kBorders, 1, 0.1F),
                                     make_dots(setup(), 0.25F)};
  int index = 0;
  for (const TexturePointer& texture : textures) {
    INFO("texture " << index++);
    const double expected = mean(texture, {7.3F, 5.1F, 0.37F}, 37.7F);
    for (int i = 0; i < 10; ++i) {
      const Vector3f place = {3.7F * static_cast<float>(i), 0.9F * static_cast<float>(i), 0.37F};
      CHECK(std::abs(static_cast<double>(at(texture, place, 16)) - expected) < 0.06);
    }
  }
}

TEST_CASE("textures stand in textures, and turn with their space", "[textures]") {
  PatternSetup outer = setup();
  outer.a = TextureInput(make_stripes(setup(), 0.5F));
  outer.space.linear = glm::mat3(0.1f);  // cells of 10
  const TexturePointer texture = make_checker(outer);
  CHECK(at(texture, {0.25F, 5, 5}) == 0);
  CHECK(at(texture, {0.75F, 5, 5}) == 1);
  CHECK(at(texture, {15.25F, 5, 5}) == 1);
}

TEST_CASE("a ramp takes the colour between its stops", "[textures]") {
  const TexturePointer ramp =
      make_ramp(TextureInput(make_gradient(setup(), GradientShape::kLinear)),
                {{0.25F, TextureInput(Color3f(1, 0, 0))}, {0.75F, TextureInput(Color3f(0, 0, 1))}});
  const auto color = [&](float y) {
    TexturePoint point;
    point.position = {0, y, 0};
    point.normal = {0, 0, 1};
    return ramp->at(point);
  };
  CHECK(color(0) == Color3f(1, 0, 0));
  CHECK(color(1) == Color3f(0, 0, 1));
  CHECK(glm::length(color(0.5F) - Color3f(0.5F, 0, 0.5F)) < 1e-5F);
}

TEST_CASE("noise is the same everywhere and for ever", "[textures]") {
  CHECK(lattice_noise({3, -4, 5}) == 0);
  double sum = 0, absolute = 0;
  std::mt19937 engine(1);
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const auto number = [&] { return static_cast<float>(engine()) * 0x1p-32F * 1000 - 500; };
    const float noise = lattice_noise({number(), number(), number()});
    sum += static_cast<double>(noise) / kCount;
    absolute += static_cast<double>(std::abs(noise)) / kCount;
  }
  CHECK(std::abs(sum) < 2e-3);
  CHECK(std::abs(absolute - static_cast<double>(kMeanAbsoluteNoise)) < 3e-3);
  CHECK(std::abs(lattice_noise({0.3F, 0.6F, 0.2F}) - lattice_noise({0.3001F, 0.6F, 0.2F})) < 1e-3F);
}
