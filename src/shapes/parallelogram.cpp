#include "shapes/parallelogram.hpp"

#include <array>
#include <cmath>
#include <cstdint>

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
  if (!is_rectangle(*this)) return;
  near_squared_ = kNear * kNear * glm::dot(diagonal, diagonal);
  rectangle_ = {corner, glm::normalize(width), glm::normalize(height),
                normal, glm::length(width),    glm::length(height)};
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
  const SphericalRectangle seen(rectangle_, from);
  if (seen.solid_angle() > kLeastSolidAngle) {
    st = seen.choose(static_cast<double>(u.x), static_cast<double>(u.y));
    return usable_density(1 / seen.solid_angle());
  }
  st = {static_cast<double>(u.x), static_cast<double>(u.y)};
  return area_density(from, at(st));
}

float Parallelogram::pdf_near(const Vector3d& from, const Vector3d& position) const {
  const SphericalRectangle seen(rectangle_, from);
  if (seen.solid_angle() > kLeastSolidAngle) return usable_density(1 / seen.solid_angle());
  return area_density(from, position);
}

void Parallelogram::choose(const PlacesToSeeFrom& from, PlacesSeen& seen) const {
  std::array<std::uint32_t, kBlockSize> is_near;
  std::uint32_t any = 0;
  for (int i = 0; i < kBlockSize; ++i) {
    const Vector3d place(from.position.at(i));
    const std::uint32_t near = is_near_rectangle(place) ? 1 : 0;
    is_near[static_cast<std::size_t>(i)] = near;
    any |= near;
    const glm::dvec2 st(static_cast<double>(from.u[i]), static_cast<double>(from.v[i]));
    const Vector3d point = at(st);
    seen.set(i, point, area_density(place, point));
  }
  if (any != 0) choose_near(from, is_near, seen);
}

// From and into memory of its own: what may be that of `from`, or be read on one way only, keeps the loop
// from becoming vectors.
void Parallelogram::choose_near(const PlacesToSeeFrom& from,
                                const std::array<std::uint32_t, kBlockSize>& is_near,
                                PlacesSeen& seen) const {
  PlacesSeen near;
  const Rectangle shape = rectangle_;
  const Vector3d along_width = width, along_height = height;
  for (int i = 0; i < kBlockSize; ++i) {
    const Vector3d place(from.position.at(i));
    const SphericalRectangle rectangle(shape, place);
    const double angle = rectangle.solid_angle();
    const double height_above = glm::dot(place - shape.corner, shape.normal);
    const double density = angle > kLeastSolidAngle ? 1 / angle : 0.0;
    const glm::dvec2 st = rectangle.choose(static_cast<double>(from.u[i]), static_cast<double>(from.v[i]));
    near.set(i, shape.corner + st.x * along_width + st.y * along_height,
             static_cast<float>(height_above == 0 ? 0.0 : density));
  }
  for (int i = 0; i < kBlockSize; ++i) {
    const bool is_chosen = (is_near[static_cast<std::size_t>(i)] != 0) & (near.pdf[i] > 0);
    seen.position.choose(i, is_chosen, near.position.at(i));
    seen.pdf[i] = is_chosen ? near.pdf[i] : seen.pdf[i];
  }
}

}  // namespace raytracer::shapes
