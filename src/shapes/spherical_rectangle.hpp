// A rectangle as seen from a point.
#pragma once

#include <cmath>

#include "core/turns.hpp"
#include "raytracer/vector3f.hpp"

namespace raytracer::shapes {

/// The points corner + x across + y up with 0 <= x <= width and 0 <= y <= height; `across` and `up` are
/// orthogonal unit vectors.
struct Rectangle {
  Vector3d corner{0.0}, across{0.0}, up{0.0};
  Vector3d normal{0.0};  ///< unit length
  double width = 0, height = 0;
};

/// C. Ureña, M. Fajardo, A. King, "An Area-Preserving Parametrization for Spherical Rectangles", EGSR 2013.
/// Names as there; the inner angles are kept as complex numbers, whose product has their sum as its angle, so
/// that one arc tangent replaces four arc cosines. Without branches: loops over many points become the
/// processor's own vectors.
class SphericalRectangle {
 public:
  [[gnu::always_inline]] SphericalRectangle(const Rectangle& shape, const Vector3d& from)
      : width_(shape.width), height_(shape.height) {
    const Vector3d to_corner = shape.corner - from;
    x0_ = glm::dot(to_corner, shape.across);
    y0_ = glm::dot(to_corner, shape.up);
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
    const double angle = angle_of(sum);
    // More than half of what there is to see is it only from straight above; else that is rounding about 0.
    const double inside = least(least(-x0_, x1_), least(-y0_, y1_));
    const double unless_beside = inside > 0 ? angle : 0.0;
    solid_angle_ = angle > kPi ? unless_beside : angle;
  }

  double solid_angle() const { return solid_angle_; }

  /// The shares of width and height, in [0, 1], of a point uniform over the directions; u in [0, 1).
  [[gnu::always_inline]] glm::dvec2 choose(double u, double v) const {
    const Turn au = turn_by(u * solid_angle_) * third_and_fourth_.conjugate();
    const double fu = (au.cosine * b0_ - b1_) / au.sine;
    const double cu = limited(std::copysign(1 / std::sqrt(fu * fu + b0_ * b0_), fu), -1.0, 1.0);
    const double rest_of_cu = 1 - cu * cu;
    const double xu = limited(-(cu * z0_) / std::sqrt(rest_of_cu > 1e-300 ? rest_of_cu : 1e-300), x0_, x1_);
    const double d2 = xu * xu + z0_ * z0_;
    const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
    const double hv = h0 + v * (h1 - h0);
    const double rest = 1 - hv * hv;
    const double yv = rest > 1e-15 ? hv * std::sqrt(d2 / rest) : y1_;
    return {share((xu - x0_) / width_), share((yv - y0_) / height_)};
  }

 private:
  struct Side {
    double a, b;
  };
  Side side(double offset) const {
    const double scale = 1 / std::sqrt(z0_ * z0_ + offset * offset);
    return {z0_ * scale, offset * scale};
  }
  // Between planes with the normals (0, a1, b1) and (a2, 0, b2); the sine without cancellation.
  static Turn inner_angle(double a1, double b1, double a2, double b2) {
    const double sine_squared = a1 * a1 + a2 * a2 - a1 * a1 * a2 * a2;
    return {-(b1 * b2), std::sqrt(sine_squared > 0 ? sine_squared : 0.0)};
  }
  static double least(double a, double b) { return a < b ? a : b; }
  static double limited(double x, double low, double high) {
    const double at_least = x > low ? x : low;
    return least(at_least, high);
  }
  // NaN becomes 0.
  static double share(double x) {
    const double positive = x > 0 ? x : 0.0;
    return positive < 1 ? positive : 1.0;
  }

  double width_, height_;
  double x0_, y0_, z0_, x1_, y1_;
  double b0_, b1_;
  Turn third_and_fourth_{1, 0};
  double solid_angle_ = 0;
};

}  // namespace raytracer::shapes
