#include "textures/expression_texture.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/noise.hpp"
#include "core/numeric.hpp"

namespace raytracer {
namespace {

constexpr double kDegrees = 180 / kPi;

Vector3d vector_at(const double* p) { return {p[0], p[1], p[2]}; }
void put(double* to, const Vector3d& v) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
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

// One step; everything is a place in r.
void take(const ExpressionInstruction& i, double* r, std::span<const ExpressionFunction> functions) {
  using Step = ExpressionStep;
  double* to = r + i.to;
  const double *a = r + i.a, *b = r + i.b, *c = r + i.c;
  switch (i.step) {
    case Step::kCopy:
      *to = *a;
      return;
    case Step::kNegate:
      *to = -*a;
      return;
    case Step::kAdd:
      *to = *a + *b;
      return;
    case Step::kSubtract:
      *to = *a - *b;
      return;
    case Step::kMultiply:
      *to = *a * *b;
      return;
    case Step::kDivide:
      *to = *b == 0 ? 0 : *a / *b;
      return;
    case Step::kRemainder:
      *to = *b == 0 ? 0 : std::fmod(*a, *b);
      return;
    case Step::kModulo:
      *to = *b == 0 ? 0 : *a - *b * std::floor(*a / *b);
      return;
    case Step::kPower:
      *to = power(*a, *b);
      return;
    case Step::kMultiplyAdd:
      *to = *a * *b + *c;
      return;
    case Step::kAddVector:
      return put(to, vector_at(a) + vector_at(b));
    case Step::kSubtractVector:
      return put(to, vector_at(a) - vector_at(b));
    case Step::kMultiplyVector:
      return put(to, vector_at(a) * vector_at(b));
    case Step::kScaleVector:
      return put(to, vector_at(a) * *b);
    case Step::kLess:
      *to = *a < *b ? 1 : 0;
      return;
    case Step::kLessEqual:
      *to = *a <= *b ? 1 : 0;
      return;
    case Step::kEqual:
      *to = *a == *b ? 1 : 0;
      return;
    case Step::kAnd:
      *to = *a != 0 && *b != 0 ? 1 : 0;
      return;
    case Step::kOr:
      *to = *a != 0 || *b != 0 ? 1 : 0;
      return;
    case Step::kNot:
      *to = *a == 0 ? 1 : 0;
      return;
    case Step::kChoose:
      *to = *a != 0 ? *b : *c;
      return;
    case Step::kSin:
      *to = sine(*a);
      return;
    case Step::kCos:
      *to = cosine(*a);
      return;
    case Step::kTan: {
      const double divisor = cosine(*a);
      *to = divisor == 0 ? 0 : sine(*a) / divisor;
      return;
    }
    case Step::kAsin:
      *to = kDegrees * std::asin(std::clamp(*a, -1.0, 1.0));
      return;
    case Step::kAcos:
      *to = kDegrees * std::acos(std::clamp(*a, -1.0, 1.0));
      return;
    case Step::kAtan2:
      *to = kDegrees * std::atan2(*a, *b);
      return;
    case Step::kSqrt:
      *to = *a > 0 ? std::sqrt(*a) : 0;
      return;
    case Step::kExp:
      *to = std::exp(*a);
      return;
    case Step::kLog:
      *to = *a > 0 ? std::log(*a) : 0;
      return;
    case Step::kAbs:
      *to = std::abs(*a);
      return;
    case Step::kMin:
      *to = std::min(*a, *b);
      return;
    case Step::kMax:
      *to = std::max(*a, *b);
      return;
    case Step::kFloor:
      *to = std::floor(*a);
      return;
    case Step::kCeil:
      *to = std::ceil(*a);
      return;
    case Step::kRound:
      *to = std::round(*a);
      return;
    case Step::kSign:
      *to = *a > 0 ? 1 : *a < 0 ? -1 : 0;
      return;
    case Step::kClamp:
      *to = std::min(std::max(*a, *b), *c);
      return;
    case Step::kMix:
      *to = *a * (1 - *c) + *b * *c;
      return;
    case Step::kSmoothstep:
      *to = smoothstep(*a, *b, *c);
      return;
    case Step::kLength:
      *to = length_of(vector_at(a));
      return;
    case Step::kNormalize:
      return put(to, normalized(vector_at(a)));
    case Step::kDot:
      *to = glm::dot(vector_at(a), vector_at(b));
      return;
    case Step::kCross:
      return put(to, glm::cross(vector_at(a), vector_at(b)));
    case Step::kNoise: {
      const Vector3d p = vector_at(a);
      *to = is_finite(p) ? gradient_noise(p) : 0;
      return;
    }
    case Step::kRandom:
      *to = random_number(std::span(a, i.b));
      return;
    case Step::kCall:
      return put(to, functions[i.b](vector_at(a)));
  }
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
  for (const ExpressionInstruction& instruction : instructions) take(instruction, r, functions);
  const Vector3d value = is_vector ? vector_at(r + result) : Vector3d(r[result], 0, 0);
  return {std::isfinite(value.x) ? value.x : 0, std::isfinite(value.y) ? value.y : 0,
          std::isfinite(value.z) ? value.z : 0};
}

TexturePointer make_expression_texture(ExpressionProgram program) {
  return std::make_shared<ExpressionTexture>(std::move(program));
}

}  // namespace raytracer
