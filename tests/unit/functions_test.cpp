#include "scene_file/functions.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "raytracer/scene_file.hpp"
#include "core/noise.hpp"

using raytracer::load_scene_text;
using raytracer::LoadedScene;
using raytracer::Vector3d;
using namespace raytracer::scene_file;

namespace {

using raytracer::random_number;
using raytracer::gradient_noise;

using Numbers = std::vector<double>;

// What a value holds, as `raytracer params` prints it: one number, or three.
Numbers read_value(const std::string& text) {
  if (text.front() == '#') {
    const Vector3d rgb =
        Vector3d(std::stoi(text.substr(1, 2), nullptr, 16), std::stoi(text.substr(3, 2), nullptr, 16),
                 std::stoi(text.substr(5, 2), nullptr, 16)) /
        255.0;
    return {rgb.x, rgb.y, rgb.z};
  }
  Numbers numbers;
  const char* place = text.data() + (text.front() == '(' ? 1 : 0);
  const char* const end = text.data() + text.size();
  while (place < end) {
    double number = 0;
    const auto [behind, status] = std::from_chars(place, end, number);
    if (status != std::errc()) return {};
    numbers.push_back(number);
    place = behind;
    while (place < end && (*place == ',' || *place == ' ' || *place == ')')) ++place;
  }
  return numbers;
}

struct Row {
  const char* call;
  Numbers value;
};

LoadedScene load_lets(const std::vector<std::string>& expressions) {
  std::string text;
  for (std::size_t i = 0; i < expressions.size(); ++i)
    text += "let v" + std::to_string(i) + " = " + expressions[i] + "\n";
  return load_scene_text(text + "sphere { }\n", "functions.txt");
}

std::vector<std::string> calls_of(const std::vector<Row>& rows) {
  std::vector<std::string> calls;
  for (const Row& row : rows) calls.emplace_back(row.call);
  return calls;
}

void check_values(const std::vector<Row>& rows) {
  const LoadedScene scene = load_lets(calls_of(rows));
  for (const auto& diagnostic : scene.diagnostics) UNSCOPED_INFO(to_text(diagnostic));
  REQUIRE(scene.ok());
  REQUIRE(scene.parameters.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Numbers found = read_value(scene.parameters[i].value);
    INFO(rows[i].call << " is " << scene.parameters[i].value);
    REQUIRE(found.size() == rows[i].value.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      CHECK(std::abs(found[k] - rows[i].value[k]) <= 1e-12 * std::max(1.0, std::abs(rows[i].value[k])));
    }
  }
}

// Each function is in here: a new row of all_functions() needs rows here too.
const std::vector<Row>& known_values() {
  static const std::vector<Row> rows = {
      {"sin(0)", {0}},
      {"sin(30)", {0.5}},
      {"sin(90)", {1}},
      {"sin(-90)", {-1}},
      {"sin(45)", {0.70710678118654752}},
      {"sin(450)", {1}},
      {"cos(0)", {1}},
      {"cos(60)", {0.5}},
      {"cos(180)", {-1}},
      {"cos(-60)", {0.5}},
      {"cos(36)", {0.80901699437494742}},
      {"tan(45)", {1}},
      {"tan(-45)", {-1}},
      {"tan(60)", {1.7320508075688773}},
      {"asin(1)", {90}},
      {"asin(-0.5)", {-30}},
      {"asin(0)", {0}},
      {"acos(1)", {0}},
      {"acos(-1)", {180}},
      {"acos(0.5)", {60}},
      {"atan2(1, 1)", {45}},
      {"atan2(1, 0)", {90}},
      {"atan2(0, -1)", {180}},
      {"atan2(-1, 0)", {-90}},
      {"atan2(-1, -1)", {-135}},
      {"atan2(2, 1)", {63.434948822922011}},
      {"sqrt(2)", {1.4142135623730951}},
      {"sqrt(0)", {0}},
      {"sqrt(144)", {12}},
      {"exp(0)", {1}},
      {"exp(1)", {2.7182818284590452}},
      {"exp(-2)", {0.13533528323661270}},
      {"log(1)", {0}},
      {"log(10)", {2.3025850929940457}},
      {"pow(2, 10)", {1024}},
      {"pow(2, -1)", {0.5}},
      {"pow(-2, 3)", {-8}},
      {"pow(9, 0.5)", {3}},
      {"pow(0, 0)", {1}},
      {"abs(-2.5)", {2.5}},
      {"abs(2.5)", {2.5}},
      {"abs((-1, 2, -3))", {1, 2, 3}},
      {"min(3, 2)", {2}},
      {"min(3, 2, 5, -1, 7)", {-1}},
      {"min((1, 5, 3), (4, 2, 6))", {1, 2, 3}},
      {"min((1, 5, 3), 2)", {1, 2, 2}},
      {"min(2, 4, (1, 5, 3))", {1, 2, 2}},
      {"max(3, 2)", {3}},
      {"max(3, 2, 5, -1, 7)", {7}},
      {"max((1, 5, 3), (4, 2, 6))", {4, 5, 6}},
      {"max(2, (1, 5, 3), 0)", {2, 5, 3}},
      {"floor(2.7)", {2}},
      {"floor(-2.1)", {-3}},
      {"floor((0.5, -0.5, 3))", {0, -1, 3}},
      {"ceil(2.1)", {3}},
      {"ceil(-2.9)", {-2}},
      {"ceil((0.5, -0.5, 3))", {1, 0, 3}},
      {"round(2.5)", {3}},
      {"round(-2.5)", {-3}},
      {"round(2.4)", {2}},
      {"round((0.5, -0.4, 3.6))", {1, 0, 4}},
      {"sign(-7)", {-1}},
      {"sign(0)", {0}},
      {"sign(0.1)", {1}},
      {"sign((-2, 0, 2))", {-1, 0, 1}},
      {"mod(7, 3)", {1}},
      {"mod(-7, 3)", {2}},
      {"mod(7, -3)", {-2}},
      {"mod(-7, -3)", {-1}},
      {"mod(5.5, 2)", {1.5}},
      {"mod((7, -7, 6), 3)", {1, 2, 0}},
      {"mod(7, (2, 3, 4))", {1, 1, 3}},
      {"clamp(5, 0, 3)", {3}},
      {"clamp(-5, 0, 3)", {0}},
      {"clamp(2, 0, 3)", {2}},
      {"clamp((-1, 0.5, 2), 0, 1)", {0, 0.5, 1}},
      {"clamp(5, (0, 6, 1), (3, 8, 9))", {3, 6, 5}},
      {"mix(10, 20, 0.25)", {12.5}},
      {"mix(10, 20, 0)", {10}},
      {"mix(10, 20, 1)", {20}},
      {"mix(10, 20, 2)", {30}},
      {"mix((0, 0, 0), (1, 2, 4), 0.5)", {0.5, 1, 2}},
      {"mix((0, 0, 0), (1, 2, 4), (0, 0.5, 1))", {0, 1, 4}},
      {"mix(0, 10, (0, 0.5, 1))", {0, 5, 10}},
      {"mix(black, white, 0.5)", {0.5, 0.5, 0.5}},
      {"smoothstep(0, 1, 0.5)", {0.5}},
      {"smoothstep(0, 1, 0.25)", {0.15625}},
      {"smoothstep(0, 1, -1)", {0}},
      {"smoothstep(0, 1, 2)", {1}},
      {"smoothstep(2, 6, 3)", {0.15625}},
      {"smoothstep(1, 0, 0.25)", {0.84375}},
      {"smoothstep(0, 1, (0.25, 0.5, 3))", {0.15625, 0.5, 1}},
      {"length((3, 4, 12))", {13}},
      {"length((0, 0, 0))", {0}},
      {"length(white)", {1.7320508075688773}},
      {"normalize((0, 3, 4))", {0, 0.6, 0.8}},
      {"normalize((-5, 0, 0))", {-1, 0, 0}},
      {"dot((1, 2, 3), (4, -5, 6))", {12}},
      {"cross((1, 0, 0), (0, 1, 0))", {0, 0, 1}},
      {"cross((0, 1, 0), (1, 0, 0))", {0, 0, -1}},
      {"cross((1, 2, 3), (4, 5, 6))", {-3, 6, -3}},
      // These numbers are promised for ever.
      {"random(0)", {0.36818951565166946}},
      {"random(1)", {0.7308752672706617}},
      {"random(1, 2)", {0.24189019898156183}},
      {"random(2, 1)", {0.47545631692985335}},
      {"random(-1.5)", {0.09371076099209219}},
      {"random((1, 2, 3))", {0.44247708336097946}},
      {"noise(0)", {0}},
      {"noise(0.5)", {0.0}},
      {"noise((0.5, 0.25, 0.75))", {0.2227029800415039}},
      {"noise((-12.3, 4.56, 789.01))", {-0.2482670046988482}},
      {"hsv(0, 1, 1)", {1, 0, 0}},
      {"hsv(120, 1, 1)", {0, 1, 0}},
      {"hsv(240, 1, 1)", {0, 0, 1}},
      {"hsv(60, 1, 1)", {1, 1, 0}},
      {"hsv(180, 1, 0.5)", {0, 0.5, 0.5}},
      {"hsv(30, 1, 1)", {1, 0.5, 0}},
      {"hsv(-60, 1, 1)", {1, 0, 1}},
      {"hsv(780, 1, 1)", {1, 1, 0}},
      {"hsv(77, 0, 0.3)", {0.3, 0.3, 0.3}},
      {"hsv(210, 0.5, 0.8)", {0.4, 0.6, 0.8}},
      {"kelvin(800).r", {1}},
      {"kelvin(800).b", {0}},
      {"kelvin(40000).b", {1}},
  };
  return rows;
}

}  // namespace

TEST_CASE("functions have their known values", "[functions]") { check_values(known_values()); }

TEST_CASE("each function has known values", "[functions]") {
  std::set<std::string> tried;
  for (const Row& row : known_values())
    tried.insert(std::string(row.call).substr(0, std::string(row.call).find('(')));
  for (const FunctionRow& function : all_functions()) {
    INFO(function.name);
    REQUIRE(tried.contains(std::string(function.name)));
    REQUIRE_FALSE(function.help.empty());
    REQUIRE_FALSE(function.parameters.empty());
    REQUIRE(find_function(function.name) == &function);
    REQUIRE(is_reserved(function.name));
  }
  REQUIRE(tried.size() == all_functions().size());
}

TEST_CASE("quarter turns are exact", "[functions]") {
  const LoadedScene scene = load_lets(
      {"sin(180) == 0 and sin(-360) == 0 and sin(90) == 1 and sin(270) == -1 and sin(1e9 * 360) == 0",
       "cos(90) == 0 and cos(-90) == 0 and cos(270) == 0 and cos(180) == -1 and cos(450) == 0"});
  REQUIRE(scene.ok());
  REQUIRE(scene.parameters[0].value == "true");
  REQUIRE(scene.parameters[1].value == "true");
}

TEST_CASE("what a function can't take is an error at the call", "[functions]") {
  // The call stands from column 9 to its end; each must be refused there, with one message that names the
  // function.
  const char* const wrong[] = {
      "sin(true)", "sin((1, 2, 3))", "sin(\"a\")", "cos(red)", "tan(90)", "tan(-90)", "tan(270)",
      "tan(\"x\")", "asin(1.001)", "asin(-2)", "asin((1, 0, 0))", "acos(-1.001)", "acos(false)",
      "atan2((1, 2, 3), 1)", "atan2(1, \"a\")", "sqrt(-1)", "sqrt((1, 4, 9))", "exp(1000)", "exp(true)",
      "log(0)", "log(-1)", "log(\"1\")", "pow(0, -1)", "pow(-8, 0.5)", "pow(10, 400)", "pow((1, 2, 3), 2)",
      "pow(2, \"a\")", "abs(true)", "abs(\"a\")", "min(1, true)", "min(\"a\", 1)", "max(1, 2, \"a\")",
      "floor(true)", "ceil(\"1\")", "round(false)", "sign(\"-\")", "mod(1, 0)", "mod(1, (1, 0, 1))",
      "mod((1, 2, 3), 0)", "clamp(1, \"a\", 2)", "mix(true, false, 0.5)", "smoothstep(1, 1, 2)",
      "smoothstep((1, 1, 1), (1, 1, 1), 2)", "smoothstep((0, 0, 0), (1, 0, 1), 0.5)",
      "smoothstep((0, 1, 0), 1, 0.5)", "length(1)", "length(true)", "normalize((0, 0, 0))", "normalize(1)",
      "dot(1, 2)", "dot((1, 2, 3), 4)", "cross((1, 2, 3), 1)", "cross(\"a\", (1, 2, 3))", "random(true)",
      "random(1, \"a\")", "noise(\"a\")", "noise(true)", "hsv(0, 1.1, 1)", "hsv(0, 1, -0.1)",
      "hsv(red, 1, 1)", "kelvin(799)", "kelvin(40001)", "kelvin(-1)", "kelvin(\"warm\")", "kelvin((1, 2, 3))",
      // arity
      "sin()", "sin(1, 2)", "atan2(1)", "min(1)", "max()", "clamp(1, 2)", "clamp(1, 2, 3, 4)", "mix(1, 2)",
      "smoothstep(1, 2)", "cross((1, 2, 3))", "random()", "noise()", "noise(1, 2)", "hsv(1, 1)", "kelvin()"};
  for (const char* call : wrong) {
    const LoadedScene scene = load_lets({call});
    INFO(call);
    CHECK_FALSE(scene.ok());
    CHECK(scene.diagnostics.size() == 1);
    if (scene.diagnostics.size() != 1) continue;
    const auto& message = scene.diagnostics.front();
    INFO(to_text(message));
    const std::string name = std::string(call).substr(0, std::string(call).find('('));
    CHECK(message.line == 1);
    CHECK(message.column == 10);
    CHECK(message.end_column == 10 + std::string(call).size());
    const bool is_overflow = message.message.find("too large") != std::string::npos;
    CHECK((is_overflow || message.message.find("'" + name + "'") != std::string::npos));
  }
}

TEST_CASE("arguments of the wrong type are told as such, not as what they would compute", "[functions]") {
  for (const char* call :
       {"mod(1, \"a\")", "mod(1, false)", "mod(1, true)", "mod(\"a\", 0)", "smoothstep(\"a\", \"b\", 1)",
        "smoothstep(false, false, 1)", "smoothstep(true, true, 1)"}) {
    const LoadedScene scene = load_lets({call});
    INFO(call);
    REQUIRE(scene.diagnostics.size() == 1);
    INFO(to_text(scene.diagnostics.front()));
    CHECK(scene.diagnostics.front().message.find("found") != std::string::npos);
    CHECK(scene.diagnostics.front().message.find("zero") == std::string::npos);
    CHECK(scene.diagnostics.front().message.find("edges") == std::string::npos);
  }
}

TEST_CASE("the least and the greatest vectors keep their length and direction", "[functions]") {
  check_values({{"normalize((1e200, 0, 0))", {1, 0, 0}},
                {"normalize((0, 3e-200, 4e-200))", {0, 0.6, 0.8}},
                {"length((3e200, 4e200, 0)) / 1e200", {5}},
                {"length((0, 3e-200, 4e-200)) * 1e200", {5}}});
}

TEST_CASE("random numbers are the same for ever", "[functions]") {
  const struct {
    Numbers seeds;
    double number;
  } golden[] = {
      {{0}, 0.36818951565166946},
      {{1}, 0.7308752672706617},
      {{2}, 0.933596642873069},
      {{-1}, 0.44130509565010956},
      {{0.5}, 0.22015543039151098},
      {{1e+300}, 0.9155194160222662},
      {{1, 2}, 0.24189019898156183},
      {{2, 1}, 0.47545631692985335},
      {{1, 2, 3}, 0.44247708336097946},
      {{0, 0, 0}, 0.8367955706748803},
      {{3.14, 2.71}, 0.25914214312536754},
      {{100, 200, 300, 400}, 0.4756467132146347},
  };
  for (const auto& row : golden) {
    INFO(row.seeds.front());
    REQUIRE(random_number(row.seeds) == row.number);
  }
}

TEST_CASE("random numbers depend on each seed, their order and number, and not on the sign of 0",
          "[functions]") {
  const Numbers minus_zero = {-0.0}, zero = {0.0};
  REQUIRE(random_number(minus_zero) == random_number(zero));
  std::set<double> different;
  const std::vector<Numbers> seeds = {{},        {0},       {0, 0},       {0, 0, 0},    {1, 2, 3},
                                      {1, 3, 2}, {2, 1, 3}, {2, 3, 1},    {3, 1, 2},    {3, 2, 1},
                                      {1, 2},    {2, 1},    {1, 2, 3, 0}, {0, 1, 2, 3}, {1},
                                      {-1},      {1e-300},  {1e300},      {0.1},        {0.1 + 1e-16}};
  for (const Numbers& row : seeds) different.insert(random_number(row));
  REQUIRE(different.size() == seeds.size());
}

TEST_CASE("random numbers are spread evenly in [0, 1)", "[functions]") {
  // Chi-square over 100 boxes: with 99 degrees of freedom it stays below 160 but in one of 10,000 trials; the
  // numbers never change, so this passes always or never.
  constexpr int kBoxes = 100, kCount = 100'000;
  const auto chi_square = [&](auto seeds_of) {
    std::vector<int> boxes(kBoxes);
    for (int i = 0; i < kCount; ++i) {
      const double x = random_number(seeds_of(i));
      REQUIRE((x >= 0 && x < 1));
      ++boxes[static_cast<std::size_t>(x * kBoxes)];
    }
    double sum = 0;
    for (const int box : boxes) sum += std::pow(box - kCount / kBoxes, 2) / (kCount / kBoxes);
    return sum;
  };
  CHECK(chi_square([](int i) { return Numbers{static_cast<double>(i)}; }) < 160);
  CHECK(chi_square([](int i) { return Numbers{i * 0.1}; }) < 160);
  CHECK(chi_square([](int i) {
          return Numbers{static_cast<double>(i % 317), static_cast<double>(i / 317)};
        }) < 160);
  CHECK(chi_square([](int i) { return Numbers{7, static_cast<double>(-i), 3}; }) < 160);
}

TEST_CASE("random numbers of neighbouring seeds have nothing to do with each other", "[functions]") {
  double product = 0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const Numbers here = {static_cast<double>(i)}, next = {static_cast<double>(i + 1)};
    product += (random_number(here) - 0.5) * (random_number(next) - 0.5);
  }
  REQUIRE(std::abs(12 * product / kCount) < 0.015);  // the correlation, within five standard deviations
}

TEST_CASE("noise is the same for ever", "[functions]") {
  const struct {
    Vector3d point;
    double value;
  } golden[] = {
      {Vector3d(0.5, 0.5, 0.5), 0.25},
      {Vector3d(0.1, 0.2, 0.3), -0.21506648174182402},
      {Vector3d(-0.1, -0.2, -0.3), 0.011871707128729966},
      {Vector3d(10.25, -3.75, 7.5), 0.2964787483215332},
      {Vector3d(1000.1, 2000.2, 3000.3), -0.27314504776332715},
      {Vector3d(0.999, 0.001, 0.5), 0.5009999924862821},
      {Vector3d(-1000000.25, 0.5, 0.125), 0.4373101219534874},
  };
  for (const auto& row : golden) {
    INFO(row.point.x << ' ' << row.point.y << ' ' << row.point.z);
    REQUIRE(std::abs(gradient_noise(row.point) - row.value) < 1e-12);
  }
}

TEST_CASE("noise is 0 where all coordinates are whole", "[functions]") {
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      for (int z = -4; z <= 4; ++z) REQUIRE(gradient_noise(Vector3d(x, y, z)) == 0);
    }
  }
  REQUIRE(gradient_noise(Vector3d(1e300, -1e300, 1e17)) == 0);
}

TEST_CASE("noise stays within -1 and 1 and goes far towards both", "[functions]") {
  std::mt19937 dice(1);
  const auto coordinate = [&] { return static_cast<double>(dice()) / 4294967296.0 * 200 - 100; };
  double least = 0, greatest = 0, sum = 0;
  constexpr int kCount = 200'000;
  for (int i = 0; i < kCount; ++i) {
    const double x = gradient_noise(Vector3d(coordinate(), coordinate(), coordinate()));
    least = std::min(least, x);
    greatest = std::max(greatest, x);
    sum += x;
  }
  REQUIRE((least >= -1 && greatest <= 1));
  REQUIRE((least < -0.7 && greatest > 0.7));
  REQUIRE(std::abs(sum / kCount) < 0.01);
}

TEST_CASE("noise is smooth, across the lattice too", "[functions]") {
  constexpr double kStep = 1e-6;
  std::mt19937 dice(2);
  for (int i = 0; i < 2000; ++i) {
    Vector3d p = Vector3d(dice(), dice(), dice()) / 4294967296.0 * 20.0 - 10.0;
    if (i % 2 == 0)
      p[i / 2 % 3] = std::round(p[i / 2 % 3]) - kStep / 2;  // the step goes through a face of the lattice
    for (int axis = 0; axis < 3; ++axis) {
      Vector3d q = p, r = p;
      q[axis] += kStep;
      r[axis] += 2 * kStep;
      const double first = gradient_noise(q) - gradient_noise(p),
                   second = gradient_noise(r) - gradient_noise(q);
      REQUIRE(std::abs(first) < 4 * kStep);                            // continuous
      REQUIRE(std::abs(second - first) < 40 * kStep * kStep + 1e-13);  // and so is its slope
    }
  }
}

TEST_CASE("noise differs from cell to cell: it has no period", "[functions]") {
  std::map<double, int> seen;
  for (int i = 0; i < 1000; ++i) ++seen[gradient_noise(Vector3d(i + 0.3, 0.4, 0.2))];
  REQUIRE(seen.size() > 990);
}

TEST_CASE("black bodies go from orange over white to blue", "[functions]") {
  const LoadedScene scene = load_lets({"kelvin(2000)", "kelvin(6500)", "kelvin(10000)", "kelvin(3200)"});
  REQUIRE(scene.ok());
  const Numbers orange = read_value(scene.parameters[0].value), white = read_value(scene.parameters[1].value),
                blue = read_value(scene.parameters[2].value), lamp = read_value(scene.parameters[3].value);
  REQUIRE(orange[0] == 1);
  REQUIRE((orange[1] > 0.2 && orange[1] < 0.35));
  REQUIRE((orange[2] >= 0 && orange[2] < 0.02));
  for (const double x : white) REQUIRE((x > 0.92 && x <= 1));
  REQUIRE(blue[2] == 1);
  REQUIRE((blue[0] < blue[1] && blue[1] < blue[2] && blue[0] > 0.5));
  REQUIRE((lamp[0] == 1 && lamp[1] > orange[1] && lamp[1] < white[1] && lamp[2] > orange[2] &&
           lamp[2] < lamp[1]));
}

TEST_CASE("the largest component of a black body's colour is 1 and it turns bluer all the way",
          "[functions]") {
  std::vector<std::string> calls;
  for (int kelvin = 800; kelvin <= 40000; kelvin += 400)
    calls.push_back("kelvin(" + std::to_string(kelvin) + ")");
  const LoadedScene scene = load_lets(calls);
  REQUIRE(scene.ok());
  double ratio_before = -1;
  for (const auto& parameter : scene.parameters) {
    const Numbers rgb = read_value(parameter.value);
    INFO(parameter.name << ' ' << parameter.value);
    REQUIRE(rgb.size() == 3);
    REQUIRE(*std::ranges::max_element(rgb) == 1);
    REQUIRE(*std::ranges::min_element(rgb) >= 0);
    const double ratio = rgb[2] / rgb[0];
    REQUIRE(ratio >= ratio_before);
    ratio_before = ratio;
  }
}
