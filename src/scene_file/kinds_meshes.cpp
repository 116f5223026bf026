// The row of the mesh.
#include <fmt/format.h>

#include <optional>

#include "meshes/flat_faces.hpp"
#include "raytracer/error.hpp"
#include "scene_file/builder.hpp"
#include "scene_file/kinds.hpp"
#include "shapes/mesh.hpp"

namespace raytracer::scene_file {
namespace {

using Numbers = std::vector<double>;

struct MeshInput {
  FileName file;
  Numbers vertices, normals, uvs, colors;
  IndexList faces;
  std::optional<double> smooth;
  bool flip = false, recenter = false;
  std::optional<double> fit;
};

constexpr Range kFaceIndex{0, 4294967295.0, false};
constexpr Range kCreaseAngle{0, 180, false};

constexpr PropertyRow kMesh[] = {
    property<&MeshInput::file>("file", "An OBJ, PLY or STL file."),
    property<&MeshInput::vertices>("vertices", "In place of a file: the corners, three numbers each.")
        .in("scene units"),
    property<&MeshInput::faces>(
        "faces", "The triangles: the numbers of three corners each, from 0, counter-clockwise from outside.")
        .within(kFaceIndex),
    property<&MeshInput::normals>("normals",
                                  "Where a curved surface faces at each corner, three numbers each."),
    property<&MeshInput::uvs>("uvs", "The place of each corner in a picture, two numbers each."),
    property<&MeshInput::colors>("colors", "The colour of each corner, three numbers each.")
        .within(kNotNegative),
    property<&MeshInput::smooth>(
        "smooth", "Triangles that meet at no more than this angle look curved; 0: every one is flat.")
        .in("degrees")
        .within(kCreaseAngle)
        .or_else("as the file says"),
    property<&MeshInput::flip>("flip", "Turns it inside out."),
    property<&MeshInput::recenter>("recenter", "Moves the middle of its box to 0 0 0."),
    property<&MeshInput::fit>("fit", "Makes the longest side of its box this long.")
        .in("scene units")
        .within(kPositive)
        .or_else("as it is"),
};

MeshOptions options_of(const MeshInput& in) {
  MeshOptions options;
  options.smooth = in.smooth;
  options.flip = in.flip;
  options.recenter = in.recenter;
  options.fit = in.fit.value_or(0);
  return options;
}

Vector3f vector_at(const Numbers& numbers, std::size_t i) {
  return Vector3f(Vector3d(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]));
}

// Whether a list has `each` numbers for every one of `count` things; one that was not given has none.
bool has_all(const Numbers& numbers, std::size_t each, std::size_t count, const char* name,
             BlockContext& block) {
  if (numbers.empty() || numbers.size() == each * count) return true;
  block.error(name, fmt::format("'{}' takes {} numbers for each of the {} vertices, found {}", name, each,
                                count, numbers.size()));
  return false;
}

bool check_faces(const IndexList& faces, std::size_t vertices, BlockContext& block) {
  bool sound = true;
  for (std::size_t i = 0; i < faces.numbers.size(); ++i) {
    if (faces.numbers[i] < static_cast<double>(vertices)) continue;
    block.error_at(faces.places[i], fmt::format("there is no vertex {}: they are numbered 0 to {}",
                                                faces.numbers[i], vertices - 1));
    sound = false;
  }
  if (faces.numbers.size() % 3 == 0) return sound;
  block.error("faces",
              fmt::format("'faces' takes three numbers for each triangle, found {}", faces.numbers.size()));
  return false;
}

// Triangles that nobody can see are left out, as those of a file are.
bool leave_out_flat_faces(MeshData& data, BlockContext& block) {
  try {
    meshes::leave_out_flat_faces(data, 0);
  } catch (const Error& problem) {
    block.error("faces", fmt::format("there is nothing to see of this mesh: {}", problem.what()));
    return false;
  }
  for (const std::string& remark : data.remarks) block.warning("faces", remark);
  return true;
}

std::shared_ptr<MeshData> data_of(const MeshInput& in) {
  const std::size_t count = in.vertices.size() / 3;
  auto data = std::make_shared<MeshData>();
  data->positions.reserve(count + 1);
  for (std::size_t i = 0; i < count; ++i) data->positions.push_back(vector_at(in.vertices, i));
  for (std::size_t i = 0; i < in.normals.size() / 3; ++i) {
    const Vector3f normal = vector_at(in.normals, i);
    data->normals.push_back(normal == Vector3f(0) ? normal : glm::normalize(normal));
  }
  for (std::size_t i = 0; i < in.colors.size() / 3; ++i) data->colors.push_back(vector_at(in.colors, i));
  for (std::size_t i = 0; i + 1 < in.uvs.size(); i += 2)
    data->uvs.emplace_back(static_cast<float>(in.uvs[i]), static_cast<float>(in.uvs[i + 1]));
  const Numbers& faces = in.faces.numbers;
  for (std::size_t i = 0; i < faces.size(); i += 3) {
    data->triangles.push_back({static_cast<std::uint32_t>(faces[i]), static_cast<std::uint32_t>(faces[i + 1]),
                               static_cast<std::uint32_t>(faces[i + 2])});
  }
  return data;
}

void build_inline(const MeshInput& in, BlockContext& block) {
  if (in.vertices.empty() || in.vertices.size() % 3 != 0) {
    return block.error("vertices", fmt::format("'vertices' takes three numbers for each corner, found {}",
                                               in.vertices.size()));
  }
  const std::size_t count = in.vertices.size() / 3;
  bool sound = has_all(in.normals, 3, count, "normals", block);
  sound = has_all(in.uvs, 2, count, "uvs", block) && sound;
  sound = has_all(in.colors, 3, count, "colors", block) && sound;
  sound = check_faces(in.faces, count, block) && sound;
  if (!sound) return;
  std::shared_ptr<MeshData> data = data_of(in);
  if (!leave_out_flat_faces(*data, block)) return;
  block.add_shape([&]() -> std::unique_ptr<Shape> {
    prepare_mesh(*data, options_of(in), block.placed(Vector3d(0)));
    const auto triangles = static_cast<std::uint32_t>(data->triangles.size());
    return std::make_unique<TriangleMesh>(std::move(data), 0, triangles);
  });
}

void build_mesh(const MeshInput& in, BlockContext& block) {
  constexpr const char* kInlineAlone[] = {"vertices", "faces", "normals", "uvs", "colors"};
  if (!block.is_given("file")) {
    for (const char* name : {"vertices", "faces"}) {
      if (block.is_given(name)) continue;
      return block.error({},
                         block.is_given("vertices") || block.is_given("faces")
                             ? fmt::format("mesh has no '{}'", name)
                             : "mesh has neither 'file' nor 'vertices' and 'faces'",
                         R"(file "dragon.ply")");
    }
    return build_inline(in, block);
  }
  for (const char* name : kInlineAlone) {
    if (block.is_given(name))
      return block.error(name, fmt::format("'{}' stands in place of 'file'", name), "write either");
  }
  block.add_mesh_file("file", in.file.name, options_of(in));
}

}  // namespace

std::span<const KindRow> mesh_kinds() {
  static const KindRow rows[] = {[] {
    KindRow row = kind<MeshInput, build_mesh>(
        "mesh", "A surface of triangles, from a file or from lists of numbers.", kMesh);
    row.block_class = BlockClass::kObject;
    row.placing = Placing::kAffine;
    row.takes_material = true;
    return row;
  }()};
  return rows;
}

}  // namespace raytracer::scene_file
