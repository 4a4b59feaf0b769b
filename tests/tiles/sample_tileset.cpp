// SPDX-License-Identifier: Apache-2.0
// sample_tileset FOLDER writes a tileset of three levels with a ball in every tile. The tiles lie
// on both sides of the origin and higher towards +x; each coarser level has a gap, and one ball is
// far from its mesh's origin.
#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
#include <vector>

#include "forest/tileset.h"
#include "output/writers.h"
#include "unit/output_sample.h"

namespace leafhull::test {
namespace {

constexpr double kEdge = 16;  // the edge of a tile of level 0
constexpr std::array kErrors{0.25, 0.75, 2.0};
constexpr std::array kRings{24, 12, 6};

std::set<TileId> tile_ids() {
  std::set<TileId> ids;
  for (int x = -3; x < 5; ++x) {
    for (int z = -2; z < 6; ++z) {
      TileId id{0, {x, x > 1 ? 1 : 0, z}};
      ids.insert(id);
      if (x == -3) continue;  // the coarser levels have no surface there
      id = id.parent();
      ids.insert(id);
      if (z < 4) ids.insert(id.parent());
    }
  }
  return ids;
}

Mesh ball(const TileId& id) {
  const double edge = kEdge * (1 << id.level);
  const Vec3d centre = (to_vec3d(id.at) + Vec3d{0.5, 0.5, 0.5}) * edge;
  Mesh mesh = sphere(kRings[static_cast<std::size_t>(id.level)]);  // the radius is 2
  if (id.at.z > 0) mesh.origin = {0, 0, edge * id.at.z};
  for (Vec3f& position : mesh.positions) {
    position = Vec3f(Vec3d(position) * (0.23 * edge) + centre - mesh.origin);
  }
  return mesh;
}

Box bounds_of(const Mesh& mesh) {
  Box box;
  for (const Vec3f& position : mesh.positions) box.include(mesh.origin + Vec3d(position));
  return box;
}

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream << bytes;
  if (!stream.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

void write_sample(const std::filesystem::path& folder) {
  std::filesystem::remove_all(folder);
  std::vector<TileRecord> tiles;
  for (const TileId& id : tile_ids()) {
    const Mesh mesh = ball(id);
    const std::string glb = written([&](std::ostream& stream) { write_glb(mesh, stream); });
    write(folder / file_of(id), glb);
    TileRecord& tile = tiles.emplace_back(id);
    tile.mesh = {.bytes = glb.size(), .sha256 = "not looked at"};
    tile.vertices = mesh.positions.size();
    tile.triangles = mesh.triangles.size();
    tile.bounds = bounds_of(mesh);
  }
  write(folder / "tileset.json", tileset_json(tiles, kErrors));
}

}  // namespace
}  // namespace leafhull::test

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: sample_tileset FOLDER\n";
    return 2;
  }
  leafhull::test::write_sample(argv[1]);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
