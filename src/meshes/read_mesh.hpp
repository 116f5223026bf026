// The door to all readers of meshes.
#pragma once

#include <functional>
#include <string>

#include "meshes/mesh_data.hpp"

namespace raytracer {

/// Whether another file (MTL) that a mesh names may be read; throws Error where not.
using MayRead = std::function<void(const std::string& path)>;

/// Reads an OBJ, PLY or STL file, told apart by content where the name's ending does not tell. Memory taken
/// stays a small multiple of the file's size. Throws Error (kScene) whose message names line or byte and what
/// is wrong; the file's name is not part of it. Faces without area or with equal corners are left out and
/// told in a remark.
MeshData read_mesh(const std::string& path, const MayRead& may_read = {});

/// The material files that an OBJ file names and the pictures that these name, whether they are there or not;
/// nothing where the file is another one or can't be read.
std::vector<std::string> files_named_by_mesh(const std::string& path);

}  // namespace raytracer
