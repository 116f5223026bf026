// Which triangles of an OBJ file have which material of its MTL files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "meshes/mesh_data.hpp"
#include "meshes/read_mesh.hpp"

namespace raytracer::meshes {

/// From this triangle on the material of this name is used ("usemtl").
struct MaterialUse {
  std::size_t triangle;
  std::string_view name;
};

/// Reads the material files that `libraries` name ("mtllib", each one or several) and fills the mesh's
/// materials and ranges. Files and materials that are not there are told in remarks.
void add_materials(const std::vector<std::string_view>& libraries, const std::vector<MaterialUse>& uses,
                   const std::string& folder, const MayRead& may_read, MeshData& mesh);

/// The material files that an OBJ file names and the pictures that these name, whether they are there or not.
std::vector<std::string> files_named_in_obj(std::string_view text, const std::string& folder);

}  // namespace raytracer::meshes
