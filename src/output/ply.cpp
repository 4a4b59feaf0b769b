// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "leafhull/version.h"
#include "output/binary_record.h"
#include "output/mesh_head.h"
#include "output/mesh_vertex.h"
#include "output/writers.h"

namespace leafhull {

void write_ply_head(std::uint64_t vertices, std::uint64_t triangles, bool far_out,
                    std::ostream& stream) {
  const char* const real = far_out ? "double" : "float";
  stream << "ply\nformat binary_little_endian 1.0\n"
         << "comment leafhull " << kVersion << "\n"
         << "element vertex " << vertices << "\n";
  for (const char axis : {'x', 'y', 'z'}) stream << "property " << real << " " << axis << "\n";
  for (const char axis : {'x', 'y', 'z'}) stream << "property float n" << axis << "\n";
  stream << "element face " << triangles << "\n"
         << "property list uchar uint vertex_indices\nend_header\n";
}

void write_ply(const Mesh& mesh, std::ostream& stream) {
  const bool far_out = mesh.origin != Vec3d{};
  write_ply_head(mesh.positions.size(), mesh.triangles.size(), far_out, stream);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (far_out) {
      write_record(stream, world_position(mesh, i), unit_normal(mesh, i));
    } else {
      write_record(stream, mesh.positions[i], unit_normal(mesh, i));
    }
  }
  for (const auto& triangle : mesh.triangles) write_record(stream, std::uint8_t{3}, triangle);
}

}  // namespace leafhull
