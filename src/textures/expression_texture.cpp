#include "textures/expression_texture.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/lane_math.hpp"
#include "core/noise.hpp"
#include "core/numeric.hpp"
#include "textures/texture_block.hpp"

namespace raytracer {
namespace {

constexpr double kDegrees = 180 / kPi;

/// One number, or as many as points are computed side by side.
template <int N>
struct Numbers {
  double at[N];
};

template <int N>
Vector3d vector_at(const double* p, int lane) {
  return {p[lane], p[N + lane], p[2 * N + lane]};
}

// Puts function(lane) of all lanes at `to`. Computed before any is put there, which operands may be, too.
template <int N, class Function>
Numbers<N> put(double* to, const Function& function) {
  Numbers<N> result;
  for (int lane = 0; lane < N; ++lane) result.at[lane] = function(lane);
  for (int lane = 0; lane < N; ++lane) to[lane] = result.at[lane];
  return result;
}

template <int N, class Function>
Numbers<N> put_vector(double* to, const Function& function) {
  Numbers<N> x, y, z;
  for (int lane = 0; lane < N; ++lane) {
    const Vector3d v = function(lane);
    x.at[lane] = v.x;
    y.at[lane] = v.y;
    z.at[lane] = v.z;
  }
  for (int lane = 0; lane < N; ++lane) {
    to[lane] = x.at[lane];
    to[N + lane] = y.at[lane];
    to[2 * N + lane] = z.at[lane];
  }
  return x;
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

template <int N>
bool are_near_degrees(const double* a) {
  bool are_near = true;
  for (int lane = 0; lane < N; ++lane) are_near &= std::abs(a[lane]) < kMostDegrees;
  return are_near;
}

template <int N>
double random_at(const double* seeds, std::size_t count, int lane) {
  if constexpr (N == 1) return random_number(std::span(seeds, count));
  double own[ExpressionProgram::kMostPlaces];
  for (std::size_t k = 0; k < count; ++k) own[k] = seeds[N * k + static_cast<std::size_t>(lane)];
  return random_number(std::span(own, count));
}

// One step; returns the number that it has computed. `last` is that of the step before, everything else is a
// place in r, which has room for N numbers at each.
template <int N>
Numbers<N> take(const ExpressionInstruction& i, double* r, const Numbers<N>& last,
                std::span<const ExpressionFunction> functions) {
  using Step = ExpressionStep;
  double* to = r + N * i.to;
  const double *a = r + N * i.a, *b = r + N * i.b, *c = r + N * i.c;
  switch (i.step) {
    case Step::kCopy:
      return put<N>(to, [=](int l) { return a[l]; });
    case Step::kAdd:
      return put<N>(to, [=](int l) { return a[l] + b[l]; });
    case Step::kSubtract:
      return put<N>(to, [=](int l) { return a[l] - b[l]; });
    case Step::kMultiply:
      return put<N>(to, [=](int l) { return a[l] * b[l]; });
    case Step::kMultiplyAdd:
      return put<N>(to, [=](int l) { return a[l] * b[l] + c[l]; });
    case Step::kMultiplySubtract:
      return put<N>(to, [=](int l) { return c[l] - a[l] * b[l]; });
    case Step::kAddLast:
      return put<N>(to, [=](int l) { return last.at[l] + b[l]; });
    case Step::kSubtractLast:
      return put<N>(to, [=](int l) { return last.at[l] - b[l]; });
    case Step::kSubtractFromLast:
      return put<N>(to, [=](int l) { return a[l] - last.at[l]; });
    case Step::kMultiplyLast:
      return put<N>(to, [=](int l) { return last.at[l] * b[l]; });
    case Step::kMultiplyAddLast:
      return put<N>(to, [=](int l) { return a[l] * b[l] + last.at[l]; });
    case Step::kMultiplyLastAdd:
      return put<N>(to, [=](int l) { return last.at[l] * b[l] + c[l]; });
    case Step::kMultiplySubtractLast:
      return put<N>(to, [=](int l) { return last.at[l] - a[l] * b[l]; });
    case Step::kNegate:
      return put<N>(to, [=](int l) { return -a[l]; });
    case Step::kDivide:
      return put<N>(to, [=](int l) { return b[l] == 0 ? 0 : a[l] / b[l]; });
    case Step::kRemainder:
      return put<N>(to, [=](int l) { return b[l] == 0 ? 0 : std::fmod(a[l], b[l]); });
    case Step::kModulo:
      return put<N>(to, [=](int l) { return b[l] == 0 ? 0 : a[l] - b[l] * std::floor(a[l] / b[l]); });
    case Step::kPower:
      return put<N>(to, [=](int l) { return power(a[l], b[l]); });
    case Step::kAddVector:
      return put_vector<N>(to, [=](int l) { return vector_at<N>(a, l) + vector_at<N>(b, l); });
    case Step::kSubtractVector:
      return put_vector<N>(to, [=](int l) { return vector_at<N>(a, l) - vector_at<N>(b, l); });
    case Step::kMultiplyVector:
      return put_vector<N>(to, [=](int l) { return vector_at<N>(a, l) * vector_at<N>(b, l); });
    case Step::kScaleVector:
      return put_vector<N>(to, [=](int l) { return vector_at<N>(a, l) * b[l]; });
    case Step::kLess:
      return put<N>(to, [=](int l) { return a[l] < b[l] ? 1.0 : 0.0; });
    case Step::kLessEqual:
      return put<N>(to, [=](int l) { return a[l] <= b[l] ? 1.0 : 0.0; });
    case Step::kEqual:
      return put<N>(to, [=](int l) { return a[l] == b[l] ? 1.0 : 0.0; });
    case Step::kAnd:
      return put<N>(to, [=](int l) { return ((a[l] != 0) & (b[l] != 0)) ? 1.0 : 0.0; });
    case Step::kOr:
      return put<N>(to, [=](int l) { return ((a[l] != 0) | (b[l] != 0)) ? 1.0 : 0.0; });
    case Step::kNot:
      return put<N>(to, [=](int l) { return a[l] == 0 ? 1.0 : 0.0; });
    case Step::kChoose:
      return put<N>(to, [=](int l) { return a[l] != 0 ? b[l] : c[l]; });
    case Step::kSin:
      if (are_near_degrees<N>(a)) return put<N>(to, [=](int l) { return sine_of_near_degrees(a[l]); });
      return put<N>(to, [=](int l) { return sine_of_degrees(a[l]); });
    case Step::kCos:
      if (are_near_degrees<N>(a)) return put<N>(to, [=](int l) { return cosine_of_near_degrees(a[l]); });
      return put<N>(to, [=](int l) { return cosine_of_degrees(a[l]); });
    case Step::kTan:
      return put<N>(to, [=](int l) {
        const double divisor = cosine_of_degrees(a[l]);
        return divisor == 0 ? 0 : sine_of_degrees(a[l]) / divisor;
      });
    case Step::kAsin:
      return put<N>(to, [=](int l) { return kDegrees * std::asin(std::clamp(a[l], -1.0, 1.0)); });
    case Step::kAcos:
      return put<N>(to, [=](int l) { return kDegrees * std::acos(std::clamp(a[l], -1.0, 1.0)); });
    case Step::kAtan2:
      return put<N>(to, [=](int l) { return kDegrees * std::atan2(a[l], b[l]); });
    case Step::kSqrt:
      return put<N>(to, [=](int l) { return a[l] > 0 ? std::sqrt(a[l]) : 0; });
    case Step::kExp:
      return put<N>(to, [=](int l) { return std::exp(a[l]); });
    case Step::kLog:
      return put<N>(to, [=](int l) { return a[l] > 0 ? std::log(a[l]) : 0; });
    case Step::kAbs:
      return put<N>(to, [=](int l) { return std::abs(a[l]); });
    case Step::kMin:
      return put<N>(to, [=](int l) { return b[l] < a[l] ? b[l] : a[l]; });
    case Step::kMax:
      return put<N>(to, [=](int l) { return a[l] < b[l] ? b[l] : a[l]; });
    case Step::kFloor:
      return put<N>(to, [=](int l) { return std::floor(a[l]); });
    case Step::kCeil:
      return put<N>(to, [=](int l) { return std::ceil(a[l]); });
    case Step::kRound:
      return put<N>(to, [=](int l) { return std::round(a[l]); });
    case Step::kSign:
      return put<N>(to, [=](int l) { return a[l] > 0 ? 1.0 : a[l] < 0 ? -1.0 : 0.0; });
    case Step::kClamp:
      return put<N>(to, [=](int l) {
        const double above = a[l] < b[l] ? b[l] : a[l];
        return c[l] < above ? c[l] : above;
      });
    case Step::kMix:
      return put<N>(to, [=](int l) { return a[l] * (1 - c[l]) + b[l] * c[l]; });
    case Step::kSmoothstep:
      return put<N>(to, [=](int l) { return smoothstep(a[l], b[l], c[l]); });
    case Step::kLength:
      return put<N>(to, [=](int l) { return length_of(vector_at<N>(a, l)); });
    case Step::kNormalize:
      return put_vector<N>(to, [=](int l) { return normalized(vector_at<N>(a, l)); });
    case Step::kDot:
      return put<N>(to, [=](int l) { return glm::dot(vector_at<N>(a, l), vector_at<N>(b, l)); });
    case Step::kCross:
      return put_vector<N>(to, [=](int l) { return glm::cross(vector_at<N>(a, l), vector_at<N>(b, l)); });
    case Step::kNoise:
      return put<N>(to, [=](int l) {
        const Vector3d p = vector_at<N>(a, l);
        return is_finite(p) ? gradient_noise(p) : 0;
      });
    case Step::kRandom:
      return put<N>(to, [=](int l) { return random_at<N>(a, i.b, l); });
    case Step::kCall:
      return put_vector<N>(to, [=](int l) { return functions[i.b](vector_at<N>(a, l)); });
  }
  return last;
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

// Runs the program for N points. `r` has the points' values; results that are not finite become 0.
template <int N>
void run_all(const ExpressionProgram& program, double* r) {
  for (std::size_t k = 0; k < program.constants.size(); ++k) {
    double* to = r + N * (ExpressionProgram::kFirstConstant + k);
    for (int lane = 0; lane < N; ++lane) to[lane] = program.constants[k];
  }
  Numbers<N> last{};
  for (const ExpressionInstruction& i : program.instructions) last = take<N>(i, r, last, program.functions);
  double* result = r + N * program.result;
  const int count = program.is_vector ? 3 * N : N;
  for (int k = 0; k < count; ++k) result[k] = std::isfinite(result[k]) ? result[k] : 0;
}

template <int N>
void put_point(const TexturePoint& point, double* r, int lane) {
  using Program = ExpressionProgram;
  for (int axis = 0; axis < 3; ++axis) {
    r[N * (Program::kPosition + axis) + lane] = static_cast<double>(point.position[axis]);
    r[N * (Program::kNormal + axis) + lane] = static_cast<double>(point.normal[axis]);
  }
  r[N * Program::kU + lane] = static_cast<double>(point.uv.x);
  r[N * Program::kV + lane] = static_cast<double>(point.uv.y);
}

// Or may: not every step reads all of its three places.
bool reads_uv(const ExpressionProgram& program) {
  const auto is_uv = [](std::uint16_t place) {
    return place == ExpressionProgram::kU || place == ExpressionProgram::kV;
  };
  return is_uv(program.result) ||
         std::ranges::any_of(program.instructions, [&](const ExpressionInstruction& i) {
           return is_uv(i.a) || is_uv(i.b) || is_uv(i.c);
         });
}

class ExpressionTexture final : public Texture {
 public:
  explicit ExpressionTexture(ExpressionProgram program)
      : Texture(reads_uv(program)), program_(std::move(program)) {}

  Color3f at(const TexturePoint& point) const override { return color_of(program_.run(point)); }

  void colors_at(const TextureBlock& points, ColorBlock& colors) const override {
    constexpr int kLanes = 8;  // of double precision, in the largest vectors that there are
    alignas(64) double r[kLanes * ExpressionProgram::kMostPlaces];
    for (int first = 0; first < points.count; first += kLanes) {
      for (int lane = 0; lane < kLanes; ++lane) put_point<kLanes>(points.at(first + lane), r, lane);
      run_all<kLanes>(program_, r);
      const double* result = r + kLanes * program_.result;
      for (int lane = 0; lane < kLanes; ++lane) {
        colors.set(first + lane, color_of(program_.is_vector ? vector_at<kLanes>(result, lane)
                                                             : Vector3d(result[lane], 0, 0)));
      }
    }
  }

 private:
  Color3f color_of(Vector3d value) const {
    if (!program_.is_vector) value = Vector3d(value.x);
    // Beyond, single precision loses its footing.
    constexpr double kMost = 1e18;
    return Color3f(glm::clamp(value, -kMost, kMost));
  }

  ExpressionProgram program_;
};

}  // namespace

Vector3d ExpressionProgram::run(const TexturePoint& point) const {
  double r[kMostPlaces];
  put_point<1>(point, r, 0);
  run_all<1>(*this, r);
  return is_vector ? vector_at<1>(r + result, 0) : Vector3d(r[result], 0, 0);
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
