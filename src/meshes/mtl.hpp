// Wavefront MTL: what an OBJ file's materials look like. "MTL material format", appendix B2 of the Advanced
// Visualizer's manual (Wavefront, 1995), and the words for metals that exporters add (Pr, Pm, norm).
#pragma once

#include <string>
#include <string_view>

#include "meshes/mesh_data.hpp"

namespace raytracer::meshes {

/// Appends the materials of the file. Statements that say nothing that a NamedMaterial holds are skipped, as
/// are numbers that are none. Throws Error where there are more than 65,536 materials in all.
void read_mtl(std::string_view text, const std::string& folder,
              std::vector<MeshData::NamedMaterial>& materials);

}  // namespace raytracer::meshes
