// What every shape promises, checked for every shape, placement and scale by random rays.
#include "raytracer/shapes.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "unit/make_meshes.hpp"

namespace {

using namespace raytracer;

/// Uniform numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vector3d in_box(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  Vector3d unit() {
    for (;;) {
      const Vector3d v = in_box(1);
      if (glm::length(v) > 0.1 && glm::length(v) < 1) return glm::normalize(v);
    }
  }

 private:
  std::mt19937_64 engine_;
};

/// A shape about 1 in size around the origin of its own space, and what is known of it there.
struct Case {
  std::string name;
  std::function<std::unique_ptr<Shape>(const Transform&)> make;
  /// Negative on one side of the surface (inside of closed ones), positive on the other.
  std::function<double(const Vector3d&)> side;
  /// Whether a point where side() is 0 belongs to the surface, which is made smaller by `margin`.
  std::function<bool(const Vector3d&, double margin)> is_within;
  bool is_closed = true;
  bool is_convex = true;    // a ray that leaves to the front never meets the shape again
  bool is_rounded = false;  // its corners are floats
};

bool always(const Vector3d&, double) { return true; }

double cylinder_side(const Vector3d& p) { return std::max(std::hypot(p.x, p.z) - 0.5, std::abs(p.y) - 0.8); }

double cone_radius(double y, double base, double top) { return base + (top - base) * (y + 0.5); }

double cone_side(const Vector3d& p, double base, double top) {
  return std::max(std::hypot(p.x, p.z) - cone_radius(p.y, base, top), std::abs(p.y) - 0.5);
}

double torus_side(const Vector3d& p, double ring, double tube) {
  const double rho = std::hypot(p.x, p.z);
  const double near = std::hypot(rho - ring, p.y) - tube, far = std::hypot(rho + ring, p.y) - tube;
  return std::max(near, -far);  // the inner part of a spindle is outside by parity
}

/// A ball of flat triangles, convex.
Case mesh_case() {
  const MeshData ball = ball_mesh(1);
  const auto side = [ball](const Vector3d& p) {
    double most = -1;
    for (const auto& t : ball.triangles) {
      const Vector3d a(ball.positions[t[0]]), b(ball.positions[t[1]]), c(ball.positions[t[2]]);
      most = std::max(most, glm::dot(glm::normalize(glm::cross(b - a, c - a)), p - a));
    }
    return most;
  };
  Case mesh{"mesh", [ball](const Transform& m) { return make_mesh(ball, m); }, side, always};
  mesh.is_rounded = true;
  return mesh;
}

std::vector<Case> closed_cases() {
  const Vector3d base(0, -0.5, 0), top(0, 0.5, 0), up(0, 1, 0);
  const auto torus = [&](const char* name, double ring, double tube) {
    return Case{name,
                [=](const Transform& m) { return make_torus(Vector3d(0), up, ring, tube, m); },
                [=](const Vector3d& p) { return torus_side(p, ring, tube); },
                always,
                true,
                false};
  };
  const auto cone = [&](const char* name, double r0, double r1) {
    return Case{name, [=](const Transform& m) { return make_cone(base, r0, top, r1, false, m); },
                [=](const Vector3d& p) { return cone_side(p, r0, r1); }, always};
  };
  return {
      {"sphere", [](const Transform& m) { return make_sphere(Vector3d(0.1, 0, 0), 0.9, m); },
       [](const Vector3d& p) { return glm::length(p - Vector3d(0.1, 0, 0)) - 0.9; }, always},
      {"cube", [](const Transform& m) { return make_cube(Vector3d(0, 0.1, 0), Vector3d(1, 1.5, 0.4), m); },
       [](const Vector3d& p) {
         const Vector3d q = glm::abs(p - Vector3d(0, 0.1, 0)) - Vector3d(0.5, 0.75, 0.2);
         return std::max({q.x, q.y, q.z});
       },
       always},
      {"cylinder",
       [](const Transform& m) {
         return make_cylinder(Vector3d(0, -0.8, 0), Vector3d(0, 0.8, 0), 0.5, false, m);
       },
       cylinder_side, always},
      mesh_case(),
      cone("cone", 0.7, 0),
      cone("cone on its tip", 0, 0.7),
      cone("stump", 0.6, 0.25),
      torus("torus", 0.7, 0.25),
      torus("thin torus", 0.9, 0.02),
      torus("spindle", 0.4, 0.55),
  };
}

std::vector<Case> open_cases() {
  const Vector3d w(1, 0.2, 0), h(0.1, 0.3, 0.9), corner(-0.5, -0.3, -0.4), n = glm::cross(w, h);
  const auto plane_side = [=](const Vector3d& p) { return glm::dot(n, p - corner) / glm::length(n); };
  const auto weights = [=](const Vector3d& p) {
    const Vector3d q = p - corner;
    return glm::dvec2(glm::dot(glm::cross(q, h), n), glm::dot(glm::cross(w, q), n)) / glm::dot(n, n);
  };
  return {
      {"quad", [=](const Transform& m) { return make_quad(corner, w, h, m); }, plane_side,
       [=](const Vector3d& p, double margin) {
         const glm::dvec2 uv = weights(p);
         return uv.x >= margin && uv.x <= 1 - margin && uv.y >= margin && uv.y <= 1 - margin;
       },
       false, true},
      {"triangle", [=](const Transform& m) { return make_triangle(corner, corner + w, corner + h, m); },
       plane_side,
       [=](const Vector3d& p, double margin) {
         const glm::dvec2 uv = weights(p);
         return uv.x >= margin && uv.y >= margin && uv.x + uv.y <= 1 - margin;
       },
       false, true},
      {"plane", [=](const Transform& m) { return make_plane(corner, n, m); }, plane_side, always, false},
      {"disk", [=](const Transform& m) { return make_disk(corner, n, 0.8, m); }, plane_side,
       [=](const Vector3d& p, double margin) { return glm::length(p - corner) <= 0.8 - margin; }, false},
      {"open cylinder",
       [](const Transform& m) {
         return make_cylinder(Vector3d(0, -0.8, 0), Vector3d(0, 0.8, 0), 0.5, true, m);
       },
       [](const Vector3d& p) { return std::hypot(p.x, p.z) - 0.5; },
       [](const Vector3d& p, double margin) { return std::abs(p.y) <= 0.8 - margin; }, false},
      {"open cone",
       [](const Transform& m) {
         return make_cone(Vector3d(0, -0.5, 0), 0.7, Vector3d(0, 0.5, 0), 0, true, m);
       },
       [](const Vector3d& p) { return std::hypot(p.x, p.z) - cone_radius(p.y, 0.7, 0); },
       [](const Vector3d& p, double margin) { return std::abs(p.y) <= 0.5 - margin; }, false},
  };
}

std::vector<Case> all_cases() {
  std::vector<Case> cases = closed_cases();
  for (Case& one : open_cases()) cases.push_back(one);
  return cases;
}

glm::dmat3 rotation(Random& random) {
  const Vector3d x = random.unit();
  const Vector3d y = glm::normalize(glm::cross(x, random.unit()));
  return {x, y, glm::cross(x, y)};
}

/// Stretched, sheared and turned; mirrored every second time.
glm::dmat3 affine(Random& random) {
  glm::dmat3 m = rotation(random);
  for (int i = 0; i < 3; ++i) m[i] *= random.in(0.3, 2);
  if (random.in(0, 1) < 0.5) m[0] = -m[0];
  return rotation(random) * m * rotation(random);
}

/// The placements of a shape that every promise is tried in: in place, moved along one axis, far away, and
/// any.
std::vector<Transform> placements(double scale, Random& random) {
  std::vector<Transform> all = {
      {glm::dmat3(1.0), Vector3d(0)},
      {glm::dmat3(1.0), Vector3d(0, -1, 0)},
      {glm::dmat3(1.0), 1000.0 * random.unit()},
      {rotation(random), 10.0 * random.unit()},
      {affine(random), Vector3d(0)},
      {affine(random), 1000.0 * random.unit()},
  };
  for (Transform& one : all) one = {one.linear * scale, one.translation * scale};
  return all;
}

/// One shape in one place, with the way back to its own space.
struct Placed {
  Placed(const Case& of, const Transform& transform)
      : kind(of), to_world(transform), to_own(transform.inverse()), shape(of.make(transform)) {}

  double side(const Vector3d& world) const { return kind.side(to_own.point(world)); }

  /// A ray from own space, its direction of any length, in float.
  Ray3f ray(const Vector3d& origin, const Vector3d& direction, double speed) const {
    Ray3f ray;
    ray.origin = Vector3f(to_world.point(origin));
    ray.direction = Vector3f(glm::normalize(to_world.vector(direction)) * speed);
    return ray;
  }

  /// A ray that starts around the shape and is likely to meet it.
  Ray3f random_ray(Random& random) const {
    const Vector3d origin = random.in_box(3), target = random.in_box(0.9);
    Vector3d direction = target - origin;
    if (random.in(0, 1) < 0.1) {  // along an axis
      const int axis = static_cast<int>(random.in(0, 3));
      direction = Vector3d(0);
      direction[axis] = random.in(0, 1) < 0.5 ? -1 : 1;
    }
    return ray(origin, direction, std::exp2(std::floor(random.in(-6, 6))) * 1.3);
  }

  const Case& kind;
  Transform to_world, to_own;
  std::unique_ptr<Shape> shape;
};

/// Runs `check` for each case, scale and placement; it returns a complaint or nothing, for each of `count`
/// turns.
void for_each_placed(const std::vector<Case>& cases, int count,
                     const std::function<std::string(const Placed&, Random&)>& check) {
  for (const Case& kind : cases) {
    for (const double scale : {1e-3, 1.0, 1e3, 1e6}) {
      Random random(7);
      int number = 0;
      for (const Transform& place : placements(scale, random)) {
        const Placed placed(kind, place);
        int failures = 0;
        std::string first;
        for (int i = 0; i < count; ++i) {
          const std::string complaint = check(placed, random);
          if (!complaint.empty() && failures++ == 0) first = complaint;
        }
        INFO(kind.name << " at scale " << scale << ", placement " << number << ": " << first);
        CHECK(failures == 0);
        ++number;
      }
    }
  }
}

std::string complain(const char* what, std::initializer_list<double> numbers) {
  std::ostringstream text;
  text.precision(9);
  text << what;
  for (const double one : numbers) text << " " << one;
  return text.str();
}

bool is_unit(const Vector3f& v) { return std::abs(glm::length(Vector3d(v)) - 1) < 1e-6; }

Ray3f leaving(const SurfacePoint& point, const Vector3f& towards, float side) {
  Ray3f ray;
  ray.origin = point.position + side * point.position_error * point.normal;
  ray.direction = towards;
  return ray;
}

/// A direction to the side of `normal`; the smaller, the more often grazing.
Vector3f random_leaving_direction(Random& random, const Vector3f& normal, float side) {
  for (;;) {
    const Vector3d n = static_cast<double>(side) * Vector3d(normal);
    const Vector3d tangent = glm::normalize(glm::cross(n, random.unit()));
    const double slope = random.in(0, 1) < 0.2 ? 0.0 : std::pow(10.0, random.in(-8, 1));
    const Vector3f direction(std::exp2(random.in(-3, 3)) * glm::normalize(tangent + slope * n));
    if (glm::dot(Vector3d(direction), n) >= 0) return direction;
  }
}

/// Whether the surface passes between the points that are position_error away on either side, as a complaint.
std::string brackets_surface(const Placed& placed, const SurfacePoint& point) {
  const Vector3d position(point.position);
  const Vector3d step = static_cast<double>(point.position_error) * Vector3d(point.normal);
  double front = placed.side(position + step), back = placed.side(position - step);
  // The tube that ends inside another one in a spindle faces the other way.
  if (placed.kind.name == "spindle" && front < 0) std::swap(front, back);

  double noise = 1e-15 * (1 + glm::length(position) / glm::length(placed.to_world.linear[0]));
  if (placed.kind.is_rounded)
    noise = 4e-7 * (1 + glm::length(position) / glm::length(placed.to_world.linear[0]));
  if (placed.kind.name == "plane")
    noise += 1e-7 * (1 + glm::length(placed.to_own.point(position)));  // its normal is a float
  if (front < -noise) return complain("front of bound is behind the surface", {front});
  // Where the body is thinner than the rounding, as at the tip of a cone, there is no room behind the
  // surface.
  const bool is_thin = placed.kind.is_closed && placed.side(position - 100.0 * step) > 0;
  if (back > noise && !is_thin) return complain("back of bound is before the surface", {back});
  return {};
}

}  // namespace

TEST_CASE("a hit is a point of the surface, within bounds, with a unit normal", "[shapes][contract]") {
  for_each_placed(all_cases(), 1000, [](const Placed& placed, Random& random) -> std::string {
    const Ray3f ray = placed.random_ray(random);
    Hit hit;
    if (!placed.shape->is_hit(ray, hit)) return {};
    const SurfacePoint point = placed.shape->surface_at(ray, hit);
    const Box3f box = placed.shape->bounds();
    const bool is_inside = glm::all(glm::lessThanEqual(box.lower, point.position)) &&
                           glm::all(glm::lessThanEqual(point.position, box.upper));
    if (!is_inside) return "outside of bounds";
    if (!is_unit(point.normal) || point.shading_normal != point.normal) return "normal is not unit";
    const auto is_share = [](float x) { return x >= 0 && x <= 1; };
    const SurfaceDetail detail = placed.shape->detail_at(ray, hit);
    if (box.is_finite() && !(is_share(detail.uv.x) && is_share(detail.uv.y))) {
      return complain("uv out of range", {detail.uv.x, detail.uv.y});
    }
    if (!std::isfinite(glm::length(detail.along_u)) || !std::isfinite(glm::length(detail.along_v))) {
      return "the tangents are no numbers";
    }
    if (!(point.position_error >= 0) || !std::isfinite(point.position_error))
      return "error bound is no number";

    return brackets_surface(placed, point);
  });
}

TEST_CASE("the error bound is about the rounding of the numbers involved", "[shapes][contract]") {
  for_each_placed(all_cases(), 300, [](const Placed& placed, Random& random) -> std::string {
    const Ray3f ray = placed.random_ray(random);
    Hit hit;
    if (!placed.shape->is_hit(ray, hit)) return {};
    const SurfacePoint point = placed.shape->surface_at(ray, hit);
    const double size = glm::length(placed.to_world.linear[0]) + glm::length(placed.to_world.linear[1]) +
                        glm::length(placed.to_world.linear[2]);
    const double magnitude = glm::length(Vector3d(point.position)) + size;
    const double most = 6e-7 * magnitude;  // a mesh comes to 4.7e-7 where its triangles are slender
    return point.position_error <= most ? "" : complain("too wide", {point.position_error, most});
  });
}

TEST_CASE("the length of the direction only scales t", "[shapes][contract]") {
  for_each_placed(all_cases(), 500, [](const Placed& placed, Random& random) -> std::string {
    Ray3f ray = placed.random_ray(random);
    Hit hit, scaled;
    const bool is_hit = placed.shape->is_hit(ray, hit);
    ray.direction *= 8.0f;
    if (placed.shape->is_hit(ray, scaled) != is_hit) return "hit and missed";
    return hit.t == 8 * scaled.t && hit.primitive == scaled.primitive ? "" : complain("t", {hit.t, scaled.t});
  });
}

TEST_CASE("hits lie strictly between t_min and t_max, and a miss leaves the hit alone",
          "[shapes][contract]") {
  for_each_placed(all_cases(), 500, [](const Placed& placed, Random& random) -> std::string {
    Ray3f ray = placed.random_ray(random);
    Hit hit;
    if (!placed.shape->is_hit(ray, hit)) return {};
    Hit other;
    other.t = -7;
    other.shape = 11;
    other.primitive = 12;
    other.u = other.v = -3;
    ray.t_max = hit.t;
    if (placed.shape->is_hit(ray, other)) return "found at t_max";
    if (other.t != -7 || other.shape != 11 || other.primitive != 12 || other.u != -3 || other.v != -3) {
      return "touched the hit of a miss";
    }
    ray.t_max = std::nextafter(hit.t, kInfinity);
    if (!placed.shape->is_hit(ray, other) || other.t != hit.t) return "not found just before t_max";
    if (other.shape != 11) return "touched Hit::shape";
    ray.t_min = std::nextafter(hit.t, 0.0f);
    if (!placed.shape->is_hit(ray, other) || other.t != hit.t) return "not found just after t_min";
    ray.t_min = hit.t;
    ray.t_max = kInfinity;
    return placed.shape->is_hit(ray, other) && other.t <= hit.t ? "found at t_min" : "";
  });
}

TEST_CASE("nothing is crossed before the nearest hit, nor where there is none", "[shapes][contract]") {
  for_each_placed(all_cases(), 150, [](const Placed& placed, Random& random) -> std::string {
    constexpr int kSamples = 300;
    constexpr double kMargin =
        1e-3;  // of the size of the shape, far above the rounding of a shape 1000 sizes away
    const Ray3f ray = placed.random_ray(random);
    const Vector3d origin = placed.to_own.point(Vector3d(ray.origin));
    const Vector3d direction = placed.to_own.linear * Vector3d(ray.direction);
    Hit hit;
    const bool is_hit = placed.shape->is_hit(ray, hit);
    const double reach = is_hit ? static_cast<double>(hit.t) : 8 / glm::length(direction);
    if (is_hit) {
      const Vector3d found = origin + reach * direction;
      if (std::abs(placed.kind.side(found)) > kMargin)
        return complain("hit off the surface", {placed.kind.side(found)});
      if (!placed.kind.is_within(found, -kMargin)) return "hit beyond the edge";
    }
    double last = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Vector3d p = origin + reach * i / kSamples * direction;
      const double side = placed.kind.side(p);
      if (std::abs(side) < kMargin) continue;
      const Vector3d previous = p - reach / kSamples * direction;
      const bool is_away_from_edge = placed.kind.is_within(p, 0.1) && placed.kind.is_within(previous, 0.1);
      if (last * side < 0 && is_away_from_edge) return complain("went through at", {reach * i / kSamples});
      last = side;
    }
    return {};
  });
}

TEST_CASE("a closed shape is crossed an even number of times from outside", "[shapes][contract]") {
  for_each_placed(closed_cases(), 500, [](const Placed& placed, Random& random) -> std::string {
    Ray3f ray = placed.random_ray(random);
    if (placed.side(Vector3d(ray.origin)) < 1e-3) return {};
    int crossings = 0;
    Hit hit;
    for (; placed.shape->is_hit(ray, hit) && crossings < 10; ++crossings) ray.t_min = hit.t;
    return crossings % 2 == 0 && crossings <= 4 ? ""
                                                : complain("crossings", {static_cast<double>(crossings)});
  });
}

TEST_CASE("a closed shape is hit from inside in every direction", "[shapes][contract]") {
  for_each_placed(closed_cases(), 500, [](const Placed& placed, Random& random) -> std::string {
    const Ray3f ray = placed.ray(random.in_box(1), random.unit(), 1);
    if (placed.side(Vector3d(ray.origin)) > -0.005) return {};
    Hit hit;
    return placed.shape->is_hit(ray, hit) ? "" : "seen through";
  });
}

TEST_CASE("a ray that leaves a convex or flat shape does not meet it again", "[shapes][contract]") {
  std::vector<Case> cases;
  for (const Case& one : all_cases()) {
    if (one.is_convex) cases.push_back(one);
  }
  for_each_placed(cases, 5000, [](const Placed& placed, Random& random) -> std::string {
    const Ray3f ray = placed.random_ray(random);
    Hit hit;
    if (!placed.shape->is_hit(ray, hit)) return {};
    const SurfacePoint point = placed.shape->surface_at(ray, hit);
    const bool is_curved = !placed.kind.is_closed && placed.kind.name.starts_with("open");
    const bool is_back_free = !placed.kind.is_closed && !is_curved;
    const float side = is_back_free && random.in(0, 1) < 0.5 ? -1.0f : 1.0f;
    const Vector3f direction = random_leaving_direction(random, point.normal, side);
    const Ray3f next = leaving(point, direction, side);
    Hit again;
    if (!placed.shape->is_hit(next, again)) return {};
    const double cosine = glm::dot(Vector3d(point.normal), glm::normalize(Vector3d(direction)));
    return complain("meets itself: t, cosine, bound", {again.t, cosine, point.position_error});
  });
}

TEST_CASE("a ray that leaves a closed shape inwards crosses its inside", "[shapes][contract]") {
  for_each_placed(closed_cases(), 1000, [](const Placed& placed, Random& random) -> std::string {
    if (placed.kind.name == "spindle") return {};
    const Ray3f ray = placed.random_ray(random);
    Hit hit;
    if (!placed.shape->is_hit(ray, hit)) return {};
    const SurfacePoint point = placed.shape->surface_at(ray, hit);
    const Ray3f next = leaving(point, random_leaving_direction(random, point.normal, -1), -1);
    Hit again;
    // Beside an edge the rounding may carry the origin out through the neighbouring face; those of a cube are
    // floats.
    const double size = glm::length(placed.to_world.linear[0]);
    const double noise = placed.kind.name == "cube" || placed.kind.is_rounded
                             ? 1e-7 * glm::length(Vector3d(point.position)) / size
                             : 1e-13;
    if (placed.side(Vector3d(next.origin)) > -noise) return {};
    if (!placed.shape->is_hit(next, again)) return "no way out";
    const Vector3d middle =
        Vector3d(next.origin) + 0.5 * static_cast<double>(again.t) * Vector3d(next.direction);
    return placed.side(middle) < 0 ? "" : complain("meets itself at t", {again.t});
  });
}

TEST_CASE("a ray that leaves a torus meets it only farther on", "[shapes][contract]") {
  std::vector<Case> cases;
  for (const Case& one : closed_cases()) {
    if (one.name == "torus" || one.name == "thin torus") cases.push_back(one);
  }
  for_each_placed(cases, 5000, [](const Placed& placed, Random& random) -> std::string {
    const Ray3f ray = placed.random_ray(random);
    Hit hit;
    if (!placed.shape->is_hit(ray, hit)) return {};
    const SurfacePoint point = placed.shape->surface_at(ray, hit);
    const Ray3f next = leaving(point, random_leaving_direction(random, point.normal, 1), 1);
    Hit again;
    if (!placed.shape->is_hit(next, again)) return {};
    // Towards the axis the surface bends up, at most like a circle of radius ring - tube: a ray that starts
    // at the height h along the surface meets it after sqrt(2 h radius).
    const double size = glm::length(placed.to_world.linear[0]);
    const double distance = static_cast<double>(again.t) * glm::length(Vector3d(next.direction));
    const double least = 0.1 * std::sqrt(static_cast<double>(point.position_error) * 0.4 * size);
    return distance > least ? "" : complain("meets itself after, not", {distance, least});
  });
}
