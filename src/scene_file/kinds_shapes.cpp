// The rows of the shapes. What the numbers mean for the geometry stands in raytracer/shapes.hpp.
#include "raytracer/error.hpp"
#include "raytracer/shapes.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/kinds.hpp"

namespace raytracer::scene_file {
namespace {

constexpr std::string_view kLength = "scene units";

struct SphereInput {
  Vector3d center{0};
  double radius = 1;
};
constexpr PropertyRow kSphere[] = {
    property<&SphereInput::center>("center", "Its middle.").in(kLength),
    property<&SphereInput::radius>("radius", "From the middle to the surface.").in(kLength).within(kPositive),
};
void build_sphere(const SphereInput& in, BlockContext& block) {
  block.add_shape([&] { return make_sphere(in.center, in.radius, block.placed(in.center)); });
}

struct QuadInput {
  Vector3d origin{0}, width{1, 0, 0}, height{0, 1, 0};
};
constexpr PropertyRow kQuad[] = {
    property<&QuadInput::origin>("origin", "One corner.").in(kLength),
    property<&QuadInput::width>("width", "The edge vector from there to the next corner.").in(kLength),
    property<&QuadInput::height>("height", "The other edge vector at that corner.").in(kLength),
};
void build_quad(const QuadInput& in, BlockContext& block) {
  const Vector3d middle = in.origin + 0.5 * in.width + 0.5 * in.height;
  block.add_shape([&] { return make_quad(in.origin, in.width, in.height, block.placed(middle)); });
}

struct CubeInput {
  Vector3d center{0}, size{1};
};
constexpr PropertyRow kCube[] = {
    property<&CubeInput::center>("center", "Its middle.").in(kLength),
    property<&CubeInput::size>("size", "The length of its edges: one for all, or along x, y and z.")
        .as(PropertyType::kSize)
        .in(kLength)
        .within(kPositive),
};
void build_cube(const CubeInput& in, BlockContext& block) {
  block.add_shape([&] { return make_cube(in.center, in.size, block.placed(in.center)); });
}

struct PlaneInput {
  Vector3d point{0}, normal{0, 1, 0};
};
constexpr PropertyRow kPlane[] = {
    property<&PlaneInput::point>("point", "Any point on it.").in(kLength),
    property<&PlaneInput::normal>("normal", "The direction straight away from it, of any length."),
};
void build_plane(const PlaneInput& in, BlockContext& block) {
  block.add_shape([&] { return make_plane(in.point, in.normal, block.placed(in.point)); });
}

struct DiskInput {
  Vector3d center{0}, normal{0, 1, 0};
  double radius = 1;
};
constexpr PropertyRow kDisk[] = {
    property<&DiskInput::center>("center", "Its middle.").in(kLength),
    property<&DiskInput::normal>("normal", "The direction straight away from it, of any length."),
    property<&DiskInput::radius>("radius", "From the middle to the rim.").in(kLength).within(kPositive),
};
void build_disk(const DiskInput& in, BlockContext& block) {
  block.add_shape([&] { return make_disk(in.center, in.normal, in.radius, block.placed(in.center)); });
}

struct CylinderInput {
  Vector3d base{0}, top{0, 1, 0};
  double radius = 1;
  bool open = false;
};
constexpr PropertyRow kCylinder[] = {
    property<&CylinderInput::base>("base", "The middle of one end.").in(kLength),
    property<&CylinderInput::top>("top", "The middle of the other end.").in(kLength),
    property<&CylinderInput::radius>("radius", "From the axis to the side.").in(kLength).within(kPositive),
    property<&CylinderInput::open>("open", "Without the caps at its ends."),
};
void build_cylinder(const CylinderInput& in, BlockContext& block) {
  const Vector3d middle = 0.5 * in.base + 0.5 * in.top;
  block.add_shape([&] { return make_cylinder(in.base, in.top, in.radius, in.open, block.placed(middle)); });
}

struct ConeInput {
  Vector3d base{0}, top{0, 1, 0};
  double radius = 1, top_radius = 0;
  bool open = false;
};
constexpr PropertyRow kCone[] = {
    property<&ConeInput::base>("base", "The middle of one end.").in(kLength),
    property<&ConeInput::radius>("radius", "Its radius at the base.").in(kLength).within(kNotNegative),
    property<&ConeInput::top>("top", "The middle of the other end.").in(kLength),
    property<&ConeInput::top_radius>("top_radius", "Its radius at the top; 0 is a point.")
        .in(kLength)
        .within(kNotNegative),
    property<&ConeInput::open>("open", "Without the caps at its ends."),
};
void build_cone(const ConeInput& in, BlockContext& block) {
  const Vector3d middle = 0.5 * in.base + 0.5 * in.top;
  block.add_shape(
      [&] { return make_cone(in.base, in.radius, in.top, in.top_radius, in.open, block.placed(middle)); });
}

struct TorusInput {
  Vector3d center{0}, axis{0, 1, 0};
  double radius = 1, tube_radius = 0.25;
};
constexpr PropertyRow kTorus[] = {
    property<&TorusInput::center>("center", "Its middle.").in(kLength),
    property<&TorusInput::axis>("axis", "The direction through the hole, of any length."),
    property<&TorusInput::radius>("radius", "From the middle to the middle of the tube.")
        .in(kLength)
        .within(kPositive),
    property<&TorusInput::tube_radius>("tube_radius", "From the middle of the tube to its surface.")
        .in(kLength)
        .within(kPositive),
};
void build_torus(const TorusInput& in, BlockContext& block) {
  block.add_shape(
      [&] { return make_torus(in.center, in.axis, in.radius, in.tube_radius, block.placed(in.center)); });
}

struct TriangleInput {
  Vector3d a{0}, b{0}, c{0};
};
constexpr PropertyRow kTriangle[] = {
    property<&TriangleInput::a>("a", "The first corner.").in(kLength).must_be_given(),
    property<&TriangleInput::b>("b", "The second corner.").in(kLength).must_be_given(),
    property<&TriangleInput::c>("c", "The third corner; seen from the front a, b, c run counter-clockwise.")
        .in(kLength)
        .must_be_given(),
};
void build_triangle(const TriangleInput& in, BlockContext& block) {
  const Vector3d middle = (in.a + in.b + in.c) / 3.0;
  block.add_shape([&] { return make_triangle(in.a, in.b, in.c, block.placed(middle)); });
}

KindRow shape(KindRow row) {
  row.block_class = BlockClass::kObject;
  row.placing = Placing::kAffine;
  row.takes_material = true;
  return row;
}

KindRow sheet(KindRow row) {
  row = shape(std::move(row));
  row.is_sheet = true;
  return row;
}

}  // namespace

std::span<const KindRow> shape_kinds() {
  static const KindRow rows[] = {
      shape(kind<SphereInput, build_sphere>("sphere", "A ball.", kSphere)),
      sheet(kind<QuadInput, build_quad>(
          "quad", "A flat parallelogram between two edge vectors; normal along width x height.", kQuad)),
      shape(kind<CubeInput, build_cube>("cube", "A box.", kCube)),
      shape(kind<PlaneInput, build_plane>("plane", "An endless plane.", kPlane)),
      sheet(kind<DiskInput, build_disk>("disk", "A flat round disk.", kDisk)),
      shape(kind<CylinderInput, build_cylinder>("cylinder", "A cylinder, closed unless open.", kCylinder)),
      shape(kind<ConeInput, build_cone>("cone", "A cone or its stump, closed unless open.", kCone)),
      shape(kind<TorusInput, build_torus>("torus", "A ring.", kTorus)),
      sheet(kind<TriangleInput, build_triangle>("triangle", "A flat triangle.", kTriangle)),
  };
  return rows;
}

}  // namespace raytracer::scene_file
