#include "textures/expression_texture.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/noise.hpp"
#include "core/numeric.hpp"

namespace raytracer {
namespace {

constexpr double kDegrees = 180 / kPi;

Vector3d vector_at(const double* p) { return {p[0], p[1], p[2]}; }
double put(double* to, const Vector3d& v) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
  return v.x;
}

double sine(double degrees) {
  const double turn = std::fmod(degrees, 360);
  return turn == 0 || std::abs(turn) == 180 ? 0 : std::sin(glm::radians(turn));
}
double cosine(double degrees) {
  const double turn = std::abs(std::fmod(degrees, 360));
  return turn == 90 || turn == 270 ? 0 : std::cos(glm::radians(turn));
}
double power(double base, double exponent) {
  const double result = std::pow(base, exponent);
  return std::isfinite(result) ? result : 0;
}
double smoothstep(double from, double to, double x) {
  if (from == to) return x < from ? 0 : 1;
  const double s = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}
double length_of(const Vector3d& v) {
  const double square = glm::dot(v, v);
  return std::isfinite(square) ? std::sqrt(square) : 0;
}
Vector3d normalized(const Vector3d& v) { return length_of(v) > 0 ? glm::normalize(v) : Vector3d(0); }

// One step; returns the number that it has computed. `last` is that of the step before, everything else is a
// place in r.
double take(const ExpressionInstruction& i, double* r, double last,
            std::span<const ExpressionFunction> functions) {
  using Step = ExpressionStep;
  double* to = r + i.to;
  const double *a = r + i.a, *b = r + i.b, *c = r + i.c;
  switch (i.step) {
    case Step::kCopy:
      return *to = *a;
    case Step::kAdd:
      return *to = *a + *b;
    case Step::kSubtract:
      return *to = *a - *b;
    case Step::kMultiply:
      return *to = *a * *b;
    case Step::kMultiplyAdd:
      return *to = *a * *b + *c;
    case Step::kMultiplySubtract:
      return *to = *c - *a * *b;
    case Step::kAddLast:
      return *to = last + *b;
    case Step::kSubtractLast:
      return *to = last - *b;
    case Step::kSubtractFromLast:
      return *to = *a - last;
    case Step::kMultiplyLast:
      return *to = last * *b;
    case Step::kMultiplyAddLast:
      return *to = *a * *b + last;
    case Step::kMultiplyLastAdd:
      return *to = last * *b + *c;
    case Step::kMultiplySubtractLast:
      return *to = last - *a * *b;
    case Step::kNegate:
      return *to = -*a;
    case Step::kDivide:
      return *to = *b == 0 ? 0 : *a / *b;
    case Step::kRemainder:
      return *to = *b == 0 ? 0 : std::fmod(*a, *b);
    case Step::kModulo:
      return *to = *b == 0 ? 0 : *a - *b * std::floor(*a / *b);
    case Step::kPower:
      return *to = power(*a, *b);
    case Step::kAddVector:
      return put(to, vector_at(a) + vector_at(b));
    case Step::kSubtractVector:
      return put(to, vector_at(a) - vector_at(b));
    case Step::kMultiplyVector:
      return put(to, vector_at(a) * vector_at(b));
    case Step::kScaleVector:
      return put(to, vector_at(a) * *b);
    case Step::kLess:
      return *to = *a < *b ? 1 : 0;
    case Step::kLessEqual:
      return *to = *a <= *b ? 1 : 0;
    case Step::kEqual:
      return *to = *a == *b ? 1 : 0;
    case Step::kAnd:
      return *to = *a != 0 && *b != 0 ? 1 : 0;
    case Step::kOr:
      return *to = *a != 0 || *b != 0 ? 1 : 0;
    case Step::kNot:
      return *to = *a == 0 ? 1 : 0;
    case Step::kChoose:
      return *to = *a != 0 ? *b : *c;
    case Step::kSin:
      return *to = sine(*a);
    case Step::kCos:
      return *to = cosine(*a);
    case Step::kTan: {
      const double divisor = cosine(*a);
      return *to = divisor == 0 ? 0 : sine(*a) / divisor;
    }
    case Step::kAsin:
      return *to = kDegrees * std::asin(std::clamp(*a, -1.0, 1.0));
    case Step::kAcos:
      return *to = kDegrees * std::acos(std::clamp(*a, -1.0, 1.0));
    case Step::kAtan2:
      return *to = kDegrees * std::atan2(*a, *b);
    case Step::kSqrt:
      return *to = *a > 0 ? std::sqrt(*a) : 0;
    case Step::kExp:
      return *to = std::exp(*a);
    case Step::kLog:
      return *to = *a > 0 ? std::log(*a) : 0;
    case Step::kAbs:
      return *to = std::abs(*a);
    case Step::kMin:
      return *to = std::min(*a, *b);
    case Step::kMax:
      return *to = std::max(*a, *b);
    case Step::kFloor:
      return *to = std::floor(*a);
    case Step::kCeil:
      return *to = std::ceil(*a);
    case Step::kRound:
      return *to = std::round(*a);
    case Step::kSign:
      return *to = *a > 0 ? 1 : *a < 0 ? -1 : 0;
    case Step::kClamp:
      return *to = std::min(std::max(*a, *b), *c);
    case Step::kMix:
      return *to = *a * (1 - *c) + *b * *c;
    case Step::kSmoothstep:
      return *to = smoothstep(*a, *b, *c);
    case Step::kLength:
      return *to = length_of(vector_at(a));
    case Step::kNormalize:
      return put(to, normalized(vector_at(a)));
    case Step::kDot:
      return *to = glm::dot(vector_at(a), vector_at(b));
    case Step::kCross:
      return put(to, glm::cross(vector_at(a), vector_at(b)));
    case Step::kNoise: {
      const Vector3d p = vector_at(a);
      return *to = is_finite(p) ? gradient_noise(p) : 0;
    }
    case Step::kRandom:
      return *to = random_number(std::span(a, i.b));
    case Step::kCall:
      return put(to, functions[i.b](vector_at(a)));
  }
  return 0;
}

bool writes_one_number(ExpressionStep step) {
  using Step = ExpressionStep;
  switch (step) {
    case Step::kAddVector:
    case Step::kSubtractVector:
    case Step::kMultiplyVector:
    case Step::kScaleVector:
    case Step::kNormalize:
    case Step::kCross:
    case Step::kCall:
      return false;
    default:
      return true;
  }
}

// The same with an operand that is at `last`, if there is one.
ExpressionInstruction chained(ExpressionInstruction i, std::uint16_t last) {
  using Step = ExpressionStep;
  const bool is_sum = i.step == Step::kAdd, is_product = i.step == Step::kMultiply;
  if (is_sum || is_product) {
    if (i.b == last) std::swap(i.a, i.b);
    if (i.a == last) i.step = is_sum ? Step::kAddLast : Step::kMultiplyLast;
  } else if (i.step == Step::kSubtract) {
    if (i.b == last) i.step = Step::kSubtractFromLast;
    if (i.a == last && i.b != last) i.step = Step::kSubtractLast;
  } else if (i.step == Step::kMultiplyAdd) {
    if (i.b == last) std::swap(i.a, i.b);
    if (i.a == last) i.step = Step::kMultiplyLastAdd;
    if (i.c == last) i.step = Step::kMultiplyAddLast;
  } else if (i.step == Step::kMultiplySubtract && i.c == last) {
    i.step = Step::kMultiplySubtractLast;
  }
  return i;
}

class ExpressionTexture final : public Texture {
 public:
  explicit ExpressionTexture(ExpressionProgram program) : program_(std::move(program)) {}

  Color3f at(const TexturePoint& point) const override {
    Vector3d value = program_.run(point);
    if (!program_.is_vector) value = Vector3d(value.x);
    // Beyond, single precision loses its footing.
    constexpr double kMost = 1e18;
    return Color3f(glm::clamp(value, -kMost, kMost));
  }

 private:
  ExpressionProgram program_;
};

}  // namespace

Vector3d ExpressionProgram::run(const TexturePoint& point) const {
  double r[kMostPlaces];
  put(r + kPosition, Vector3d(point.position));
  put(r + kNormal, Vector3d(point.normal));
  r[kU] = static_cast<double>(point.uv.x);
  r[kV] = static_cast<double>(point.uv.y);
  std::copy(constants.begin(), constants.end(), r + kFirstConstant);
  double last = 0;
  for (const ExpressionInstruction& i : instructions) last = take(i, r, last, functions);
  const Vector3d value = is_vector ? vector_at(r + result) : Vector3d(r[result], 0, 0);
  return {std::isfinite(value.x) ? value.x : 0, std::isfinite(value.y) ? value.y : 0,
          std::isfinite(value.z) ? value.z : 0};
}

void chain(ExpressionProgram& program) {
  for (std::size_t k = program.instructions.size(); k-- > 1;) {
    const ExpressionInstruction& before = program.instructions[k - 1];
    if (writes_one_number(before.step)) program.instructions[k] = chained(program.instructions[k], before.to);
  }
}

TexturePointer make_expression_texture(ExpressionProgram program) {
  chain(program);
  return std::make_shared<ExpressionTexture>(std::move(program));
}

}  // namespace raytracer
