#include "scene_file/functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/lane_math.hpp"
#include "core/noise.hpp"
#include "core/numeric.hpp"
#include "scene_file/colors.hpp"

namespace raytracer::scene_file {
namespace {

using Arguments = std::span<const Value>;

FunctionResult problem(std::string text) { return {{}, std::move(text)}; }

FunctionResult wrong_argument(std::size_t index, std::string_view wanted, const Value& found) {
  constexpr std::string_view kOrdinals[] = {"first", "second", "third", "fourth"};
  return problem(fmt::format("takes {} as its {} argument, found {}", wanted,
                             kOrdinals[std::min<std::size_t>(index, 3)], describe(found.type)));
}

// --- functions of plain numbers
// ------------------------------------------------------------------------------------

template <double (*F)(double)>
FunctionResult of_number(Arguments a) {
  if (!a[0].is_number()) return wrong_argument(0, "a number", a[0]);
  return {Value::number(F(a[0].x())), {}};
}

FunctionResult tangent(Arguments a) {
  if (!a[0].is_number()) return wrong_argument(0, "a number", a[0]);
  const double c = cosine_of_degrees(a[0].x());
  if (c == 0) return problem(fmt::format("of {} degrees is infinite", a[0].x()));
  return {Value::number(sine_of_degrees(a[0].x()) / c), {}};
}

template <double (*F)(double)>
FunctionResult inverse_of_share(Arguments a) {
  if (!a[0].is_number()) return wrong_argument(0, "a number", a[0]);
  if (!(std::abs(a[0].x()) <= 1))
    return problem(fmt::format("takes a number between -1 and 1, found {}", a[0].x()));
  return {Value::number(glm::degrees(F(a[0].x()))), {}};
}

FunctionResult arc_tangent(Arguments a) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (!a[i].is_number()) return wrong_argument(i, "a number", a[i]);
  }
  return {Value::number(glm::degrees(std::atan2(a[0].x(), a[1].x()))), {}};
}

FunctionResult square_root(Arguments a) {
  if (!a[0].is_number()) return wrong_argument(0, "a number", a[0]);
  if (a[0].x() < 0) return problem(fmt::format("of {}: a negative number has no square root", a[0].x()));
  return {Value::number(std::sqrt(a[0].x())), {}};
}

FunctionResult logarithm(Arguments a) {
  if (!a[0].is_number()) return wrong_argument(0, "a number", a[0]);
  if (a[0].x() <= 0) return problem(fmt::format("of {}: only numbers above 0 have a logarithm", a[0].x()));
  return {Value::number(std::log(a[0].x())), {}};
}

FunctionResult power(Arguments a) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (!a[i].is_number()) return wrong_argument(i, "a number", a[i]);
  }
  return {Value::number(std::pow(a[0].x(), a[1].x())), {}};
}

// --- functions that take vectors component by component, as in GLSL
// --------------------------------------------------

// All arguments are numbers or vectors; one vector makes the result a vector, and numbers count for each
// component.
template <std::size_t N, class F>
FunctionResult by_component(Arguments a, F f) {
  bool is_vector = false;
  for (std::size_t i = 0; i < N; ++i) {
    if (!a[i].is_number() && !a[i].is_vector()) return wrong_argument(i, "a number or a vector", a[i]);
    is_vector = is_vector || a[i].is_vector();
  }
  Vector3d result(0);
  for (int c = 0; c < (is_vector ? 3 : 1); ++c) {
    std::array<double, N> x;
    for (std::size_t i = 0; i < N; ++i) x[i] = a[i].is_number() ? a[i].x() : a[i].vector[c];
    result[c] = std::apply(f, x);
  }
  return {is_vector ? Value::of_vector(result) : Value::number(result.x), {}};
}

double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
double modulo(double x, double y) { return x - y * std::floor(x / y); }
double smooth(double from, double to, double x) {
  const double s = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

template <double (*F)(double)>
FunctionResult each(Arguments a) {
  return by_component<1>(a, F);
}
FunctionResult absolute(Arguments a) {
  return by_component<1>(a, [](double x) { return std::abs(x); });
}
FunctionResult round_half_away(Arguments a) {
  return by_component<1>(a, [](double x) { return std::round(x); });
}
FunctionResult floor_of(Arguments a) {
  return by_component<1>(a, [](double x) { return std::floor(x); });
}
FunctionResult ceil_of(Arguments a) {
  return by_component<1>(a, [](double x) { return std::ceil(x); });
}

template <class F>
FunctionResult fold(Arguments a, F f) {
  FunctionResult result{a[0], {}};
  for (std::size_t i = 1; i < a.size() && result.problem.empty(); ++i) {
    const Value pair[] = {result.value, a[i]};
    result = by_component<2>(pair, f);
  }
  return result;
}
FunctionResult least(Arguments a) {
  return fold(a, [](double x, double y) { return std::min(x, y); });
}
FunctionResult greatest(Arguments a) {
  return fold(a, [](double x, double y) { return std::max(x, y); });
}

bool has_zero(const Value& v) {
  return v.x() == 0 || (v.is_vector() && (v.vector.y == 0 || v.vector.z == 0));
}

FunctionResult modulus(Arguments a) {
  const bool divides = a[1].is_number() || a[1].is_vector();
  if (divides && has_zero(a[1])) {
    // The first argument may be of the wrong type, which is worse.
    FunctionResult types = by_component<2>(a, [](double, double) { return 0.0; });
    return types.problem.empty() ? problem("divides by zero") : types;
  }
  return by_component<2>(a, modulo);
}
FunctionResult clamped(Arguments a) {
  return by_component<3>(a,
                         [](double x, double low, double high) { return std::min(std::max(x, low), high); });
}
FunctionResult mixed(Arguments a) {
  return by_component<3>(a, [](double x, double y, double share) { return x * (1 - share) + y * share; });
}
FunctionResult smooth_step(Arguments a) {
  bool has_edge = true;
  FunctionResult result = by_component<3>(a, [&](double from, double to, double x) {
    has_edge = has_edge && from != to;
    return smooth(from, to, x);
  });
  return has_edge ? result : problem("needs two different edges");
}

// --- vectors, colours, chance
// ----------------------------------------------------------------------------------------

// A vector and the power of two that was taken out of it, so that no square of its components leaves the
// range of doubles. Powers of two change no digit.
struct Scaled {
  Vector3d vector;
  int exponent = 0;
};

Scaled scaled(const Vector3d& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0) return {v, 0};
  const int exponent = std::ilogb(largest);
  return {{std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent), std::ldexp(v.z, -exponent)}, exponent};
}

FunctionResult vector_length(Arguments a) {
  if (!a[0].is_vector()) return wrong_argument(0, "a vector", a[0]);
  const Scaled v = scaled(a[0].vector);
  return {Value::number(std::ldexp(glm::length(v.vector), v.exponent)), {}};
}
FunctionResult normalized(Arguments a) {
  if (!a[0].is_vector()) return wrong_argument(0, "a vector", a[0]);
  if (a[0].vector == Vector3d(0)) return problem("of (0, 0, 0): it has no direction");
  return {Value::of_vector(glm::normalize(scaled(a[0].vector).vector)), {}};
}
FunctionResult dot_product(Arguments a) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (!a[i].is_vector()) return wrong_argument(i, "a vector", a[i]);
  }
  return {Value::number(glm::dot(a[0].vector, a[1].vector)), {}};
}
FunctionResult cross_product(Arguments a) {
  for (std::size_t i = 0; i < 2; ++i) {
    if (!a[i].is_vector()) return wrong_argument(i, "a vector", a[i]);
  }
  return {Value::of_vector(glm::cross(a[0].vector, a[1].vector)), {}};
}

FunctionResult random_of(Arguments a) {
  std::vector<double> seeds;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!a[i].is_number() && !a[i].is_vector()) return wrong_argument(i, "a number or a vector", a[i]);
    for (int c = 0; c < (a[i].is_vector() ? 3 : 1); ++c) seeds.push_back(a[i].vector[c]);
  }
  return {Value::number(random_number(seeds)), {}};
}
FunctionResult noise_at(Arguments a) {
  if (!a[0].is_number() && !a[0].is_vector()) return wrong_argument(0, "a number or a vector", a[0]);
  return {Value::number(gradient_noise(a[0].vector)), {}};
}

FunctionResult hsv_color(Arguments a) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!a[i].is_number()) return wrong_argument(i, "a number", a[i]);
    if (i > 0 && !(a[i].x() >= 0 && a[i].x() <= 1)) {
      return problem(fmt::format("takes saturation and value between 0 and 1, found {}", a[i].x()));
    }
  }
  return {Value::display_color(hsv(a[0].x(), a[1].x(), a[2].x())), {}};
}
constexpr double kColdest = 800, kHottest = 40000;  // kelvin

FunctionResult kelvin_color(Arguments a) {
  if (!a[0].is_number()) return wrong_argument(0, "a number", a[0]);
  if (!(a[0].x() >= kColdest && a[0].x() <= kHottest)) {
    return problem(
        fmt::format("takes a temperature between {} and {}, found {}", kColdest, kHottest, a[0].x()));
  }
  return {Value::color(black_body_color(a[0].x())), {}};
}

// Where a surface asks, what is out of range is brought back into it.
Vector3d hsv_at_hit(const Vector3d& v) {
  return hsv(v.x, std::clamp(v.y, 0.0, 1.0), std::clamp(v.z, 0.0, 1.0));
}
Vector3d kelvin_at_hit(const Vector3d& v) { return black_body_color(std::clamp(v.x, kColdest, kHottest)); }

constexpr std::size_t kMany = 64;
using Form = FunctionForm;
using Step = ExpressionStep;

constexpr FunctionRow kFunctions[] = {
    {"sin", "x", 1, 1, "Of an angle in degrees.", of_number<sine_of_degrees>, Form::kNumbers, Step::kSin},
    {"cos", "x", 1, 1, "Of an angle in degrees.", of_number<cosine_of_degrees>, Form::kNumbers, Step::kCos},
    {"tan", "x", 1, 1, "Of an angle in degrees.", tangent, Form::kNumbers, Step::kTan},
    {"asin", "x", 1, 1, "The angle in degrees, from -90 to 90.", inverse_of_share<std::asin>, Form::kNumbers,
     Step::kAsin},
    {"acos", "x", 1, 1, "The angle in degrees, from 0 to 180.", inverse_of_share<std::acos>, Form::kNumbers,
     Step::kAcos},
    {"atan2", "y, x", 2, 2, "The angle of the point (x, y) in degrees, from -180 to 180.", arc_tangent,
     Form::kNumbers, Step::kAtan2},
    {"sqrt", "x", 1, 1, "The square root.", square_root, Form::kNumbers, Step::kSqrt},
    {"exp", "x", 1, 1, "e to the power x.", of_number<std::exp>, Form::kNumbers, Step::kExp},
    {"log", "x", 1, 1, "The natural logarithm.", logarithm, Form::kNumbers, Step::kLog},
    {"pow", "x, y", 2, 2, "x to the power y, as x ^ y.", power, Form::kNumbers, Step::kPower},
    {"abs", "x", 1, 1, "Without its sign.", absolute, Form::kComponents, Step::kAbs},
    {"min", "x, y, …", 2, kMany, "The least.", least, Form::kFold, Step::kMin},
    {"max", "x, y, …", 2, kMany, "The greatest.", greatest, Form::kFold, Step::kMax},
    {"floor", "x", 1, 1, "The next whole number below.", floor_of, Form::kComponents, Step::kFloor},
    {"ceil", "x", 1, 1, "The next whole number above.", ceil_of, Form::kComponents, Step::kCeil},
    {"round", "x", 1, 1, "The nearest whole number; halves go away from 0.", round_half_away,
     Form::kComponents, Step::kRound},
    {"sign", "x", 1, 1, "-1, 0 or 1.", each<sign_of>, Form::kComponents, Step::kSign},
    {"mod", "x, y", 2, 2, "The rest of x / y with the sign of y.", modulus, Form::kComponents, Step::kModulo},
    {"clamp", "x, low, high", 3, 3, "x, but not below low and not above high.", clamped, Form::kComponents,
     Step::kClamp},
    {"mix", "a, b, share", 3, 3, "a where share is 0, b where it is 1, in between between.", mixed,
     Form::kComponents, Step::kMix},
    {"smoothstep", "from, to, x", 3, 3, "0 below from, 1 above to, a smooth step between.", smooth_step,
     Form::kComponents, Step::kSmoothstep},
    {"length", "v", 1, 1, "Of a vector.", vector_length, Form::kVectorsToNumber, Step::kLength},
    {"normalize", "v", 1, 1, "The vector of length 1 in the same direction.", normalized,
     Form::kVectorsToVector, Step::kNormalize},
    {"dot", "v, w", 2, 2, "The scalar product.", dot_product, Form::kVectorsToNumber, Step::kDot},
    {"cross", "v, w", 2, 2, "The vector product.", cross_product, Form::kVectorsToVector, Step::kCross},
    {"random", "seed, …", 1, kMany, "In [0, 1); the same seeds give the same number for ever.", random_of,
     Form::kSeeds, Step::kRandom},
    {"noise", "p", 1, 1, "In [-1, 1], smooth over space.", noise_at, Form::kPlace, Step::kNoise},
    {"hsv", "h, s, v", 3, 3, "A colour by hue in degrees, saturation and value.", hsv_color, Form::kColor,
     Step::kCall, hsv_at_hit},
    {"kelvin", "k", 1, 1, "The colour of a glowing body; its largest component is 1.", kelvin_color,
     Form::kColor, Step::kCall, kelvin_at_hit},
};

constexpr std::string_view kReserved[] = {"let",  "for",    "from",    "to",   "step",  "if",
                                          "else", "define", "include", "true", "false", "and",
                                          "or",   "not",    "pi",      "t",    "frame", "raytracer"};

}  // namespace

std::string_view describe(ValueType type) {
  switch (type) {
    case ValueType::kUnknown:
      return "nothing";
    case ValueType::kNumber:
      return "a number";
    case ValueType::kBoolean:
      return "true or false";
    case ValueType::kVector:
      return "a vector";
    case ValueType::kColor:
      return "a colour";
    case ValueType::kString:
      return "a string";
  }
  return {};
}

std::span<const FunctionRow> all_functions() { return kFunctions; }

const FunctionRow* find_function(std::string_view name) {
  const auto* row = std::ranges::find(kFunctions, name, &FunctionRow::name);
  return row == std::end(kFunctions) ? nullptr : row;
}

std::span<const std::string_view> reserved_words() { return kReserved; }

bool is_reserved(std::string_view word) {
  return std::ranges::find(kReserved, word) != std::end(kReserved) || find_function(word) != nullptr;
}

}  // namespace raytracer::scene_file
