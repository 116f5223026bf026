#include "shapes/parallelogram.hpp"

#include <algorithm>
#include <cmath>

#include "shapes/checks.hpp"

namespace raytracer::shapes {

namespace {

/// Farther away than this many diagonals the directions are nearly uniform over the area, which is chosen in
/// a tenth of the time.
constexpr double kNear = 1;
/// Below this solid angle (a rectangle seen edge-on) the sums of angles lose their digits.
constexpr double kLeastSolidAngle = 1e-5;
/// Below this cosine of the angle between the edges they count as orthogonal.
constexpr double kOrthogonal = 1e-9;

/// A number on the unit circle of the complex plane, and what it is times another.
struct Turn {
  double cosine, sine;

  Turn operator*(const Turn& other) const {
    return {cosine * other.cosine - sine * other.sine, cosine * other.sine + sine * other.cosine};
  }
};

/// A rectangle as seen from a point: C. Ureña, M. Fajardo, A. King, "An Area-Preserving Parametrization for
/// Spherical Rectangles", EGSR 2013. Names as there; the inner angles are kept as complex numbers, whose
/// product has their sum as its angle, so that one atan2 replaces four acos.
class SphericalRectangle {
 public:
  SphericalRectangle(const Parallelogram& shape, const Vector3d& from)
      : width_(glm::length(shape.width)), height_(glm::length(shape.height)) {
    const Vector3d to_corner = shape.corner - from;
    x0_ = glm::dot(to_corner, shape.width) / width_;
    y0_ = glm::dot(to_corner, shape.height) / height_;
    z0_ = -std::abs(glm::dot(to_corner, shape.normal));
    x1_ = x0_ + width_;
    y1_ = y0_ + height_;
    // The normals of the planes through the point and an edge: (0, a, b) or (a, 0, b), of unit length.
    const Side bottom = side(y0_), right = side(x1_), top = side(y1_), left = side(x0_);
    b0_ = -bottom.b;
    b1_ = top.b;
    third_and_fourth_ =
        inner_angle(top.a, top.b, left.a, -left.b) * inner_angle(left.a, -left.b, bottom.a, -bottom.b);
    const Turn sum = inner_angle(bottom.a, -bottom.b, right.a, right.b) *
                     inner_angle(right.a, right.b, top.a, top.b) * third_and_fourth_;
    const double angle = std::atan2(sum.sine, sum.cosine);
    solid_angle_ = angle < 0 ? angle + 2 * kPi : angle;
  }

  double solid_angle() const { return solid_angle_; }

  glm::dvec2 choose(const Vector2f& u) const {
    const double part = static_cast<double>(u.x) * solid_angle_;
    const Turn au =
        Turn{std::cos(part), std::sin(part)} * Turn{third_and_fourth_.cosine, -third_and_fourth_.sine};
    const double fu = (au.cosine * b0_ - b1_) / au.sine;
    const double cu = std::clamp(std::copysign(1 / std::sqrt(fu * fu + b0_ * b0_), fu), -1.0, 1.0);
    const double xu = std::clamp(-(cu * z0_) / std::sqrt(std::max(1 - cu * cu, 1e-300)), x0_, x1_);
    const double d = std::sqrt(xu * xu + z0_ * z0_);
    const double h0 = y0_ / std::sqrt(d * d + y0_ * y0_), h1 = y1_ / std::sqrt(d * d + y1_ * y1_);
    const double hv = h0 + static_cast<double>(u.y) * (h1 - h0);
    const double rest = 1 - hv * hv;
    const double yv = rest > 1e-15 ? hv * d / std::sqrt(rest) : y1_;
    return {share((xu - x0_) / width_), share((yv - y0_) / height_)};
  }

 private:
  struct Side {
    double a, b;
  };
  Side side(double offset) const {
    const double length = std::sqrt(z0_ * z0_ + offset * offset);
    return {z0_ / length, offset / length};
  }
  // Between planes with the normals (0, a1, b1) and (a2, 0, b2); the sine without cancellation.
  static Turn inner_angle(double a1, double b1, double a2, double b2) {
    const double sine_squared = a1 * a1 + a2 * a2 - a1 * a1 * a2 * a2;
    return {-(b1 * b2), std::sqrt(std::max(sine_squared, 0.0))};
  }
  // NaN becomes 0.
  static double share(double x) { return x > 0 ? std::min(x, 1.0) : 0.0; }

  double width_, height_;
  double x0_, y0_, z0_, x1_, y1_;
  double b0_, b1_;
  Turn third_and_fourth_{1, 0};
  double solid_angle_ = 0;
};

bool is_rectangle(const Parallelogram& shape) {
  const double slant = glm::dot(shape.width, shape.height);
  return slant * slant <= kOrthogonal * kOrthogonal * glm::dot(shape.width, shape.width) *
                              glm::dot(shape.height, shape.height);
}

}  // namespace

Parallelogram::Parallelogram(const Vector3d& from_corner, const Vector3d& along_width,
                             const Vector3d& along_height, const Vector3d& unit_normal)
    : corner(from_corner),
      width(along_width),
      height(along_height),
      normal(unit_normal),
      area_(glm::length(glm::cross(width, height))) {
  const Vector3d diagonal = width + height;
  middle_ = corner + 0.5 * diagonal;
  if (is_rectangle(*this)) near_squared_ = kNear * kNear * glm::dot(diagonal, diagonal);
}

Box3f Parallelogram::bounds() const {
  Vector3d lower = corner, upper = corner;
  for (const Vector3d& other : {corner + width, corner + height, corner + width + height}) {
    lower = glm::min(lower, other);
    upper = glm::max(upper, other);
  }
  return rounded_bounds(lower, upper);
}

float Parallelogram::choose_near(const Vector3d& from, const Vector2f& u, glm::dvec2& st) const {
  if (glm::dot(from - corner, normal) == 0) return 0;
  const SphericalRectangle seen(*this, from);
  if (seen.solid_angle() > kLeastSolidAngle) {
    st = seen.choose(u);
    return usable_density(1 / seen.solid_angle());
  }
  st = {static_cast<double>(u.x), static_cast<double>(u.y)};
  return area_density(from, at(st));
}

float Parallelogram::pdf_near(const Vector3d& from, const Vector3d& position) const {
  const SphericalRectangle seen(*this, from);
  if (seen.solid_angle() > kLeastSolidAngle) return usable_density(1 / seen.solid_angle());
  return area_density(from, position);
}

}  // namespace raytracer::shapes
