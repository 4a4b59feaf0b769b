// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdint>
#include <limits>
#include <string>

#include "leafhull/error.h"
#include "leafhull/version.h"
#include "output/binary_record.h"
#include "output/mesh_vertex.h"
#include "output/writers.h"

namespace leafhull {

void write_stl(const Mesh& mesh, std::ostream& stream) {
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::output,
                "the mesh has " + std::to_string(mesh.triangles.size()) +
                    " triangles, more than an STL file can count",
                "Write a .ply, or choose a lower resolution.");
  }
  std::array<char, 80> header{};  // must not start with "solid", which marks the text form
  (std::string("leafhull ") + kVersion).copy(header.data(), header.size());
  write_record(stream, header, static_cast<std::uint32_t>(mesh.triangles.size()));

  constexpr std::uint16_t kNoAttributes = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d p = world_position(mesh, a), q = world_position(mesh, b),
                r = world_position(mesh, c);
    const Vec3f normal(normalized(cross(q - p, r - p)));
    write_record(stream, normal, Vec3f(p), Vec3f(q), Vec3f(r), kNoAttributes);
  }
}

}  // namespace leafhull
