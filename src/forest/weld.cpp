// SPDX-License-Identifier: Apache-2.0
#include "forest/weld.h"

#include <limits>

#include "forest/tile_mesh.h"
#include "leafhull/error.h"
#include "output/binary_record.h"
#include "output/destination.h"
#include "output/mesh_head.h"
#include "output/mesh_vertex.h"
#include "runs/sealed_json.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

class Weld {
 public:
  explicit Weld(const StoredTiles& tiles);

  void write_ply(std::ostream& stream) const;
  void write_glb(std::ostream& stream) const;

 private:
  Vec3d middle_origin() const;
  std::optional<Vec3f> colour() const;
  template <class Write>
  void for_each_vertex(const Write& write) const;
  template <class Write>
  void for_each_triangle(const Write& write) const;
  std::vector<std::uint32_t> welded(std::size_t tile, const Seam& seam, std::size_t size) const;

  const StoredTiles& tiles_;
  std::vector<std::uint32_t> first_vertex_;  ///< of each tile of level 0
  std::uint64_t vertices_ = 0, triangles_ = 0;
  bool far_out_ = false;
  Box box_;
};

Weld::Weld(const StoredTiles& tiles) : tiles_(tiles) {
  for (std::size_t t = 0; t < tiles.size() && tiles[t].record.level == 0; ++t) {
    const TileRecord& tile = tiles[t].record;
    first_vertex_.push_back(static_cast<std::uint32_t>(vertices_));
    vertices_ += tile.own_vertices;
    triangles_ += tile.triangles;
    if (tile.vertices == 0) continue;
    far_out_ = far_out_ || tile.origin != Vec3d{};
    box_.include(tile.bounds.low);
    box_.include(tile.bounds.high);
  }
  if (vertices_ > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::output,
                std::to_string(vertices_) + " vertices are too many for a file's 32-bit indices",
                "Leave --single out, or choose larger voxels.");
  }
}

/// The tile origin nearest the middle; floats are finest there.
Vec3d Weld::middle_origin() const {
  const Vec3d middle = (box_.low + box_.high) * 0.5;
  Vec3d origin;
  double least = HUGE_VAL;
  for (std::size_t t = 0; t < first_vertex_.size(); ++t) {
    const TileRecord& tile = tiles_[t].record;
    const double distance = length(tile.origin - middle);
    if (tile.vertices == 0 || !(distance < least)) continue;
    least = distance;
    origin = tile.origin;
  }
  return origin;
}

/// The mesh's colour; all tiles of a level have the same.
std::optional<Vec3f> Weld::colour() const {
  for (std::size_t t = 0; t < first_vertex_.size(); ++t) {
    if (tiles_[t].record.mesh.sha256.empty()) continue;
    Seam seam = tiles_.seam(t);
    return tiles_.mesh(t, seam).colour;
  }
  return std::nullopt;
}

template <class Write>
void Weld::for_each_vertex(const Write& write) const {
  for (std::size_t t = 0; t < first_vertex_.size(); ++t) {
    if (tiles_[t].record.own_vertices == 0) continue;
    Seam seam = tiles_.seam(t);
    const Mesh mesh = tiles_.mesh(t, seam);
    for (std::uint32_t v = 0; v < seam.own_vertices; ++v) {
      write(world_position(mesh, v), mesh.normals[v]);
    }
  }
}

/// The indices of a tile's vertices in the whole mesh.
std::vector<std::uint32_t> Weld::welded(std::size_t tile, const Seam& seam,
                                        std::size_t size) const {
  constexpr auto kNowhere = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> welded(size, kNowhere);
  for (std::uint32_t v = 0; v < seam.own_vertices; ++v) welded[v] = first_vertex_[tile] + v;
  for_each_borrowed(tiles_, tile, seam,
                    [&](const SeamVertex& borrowed, std::size_t owner, const SeamVertex& lent) {
                      welded[borrowed.vertex] = first_vertex_[owner] + lent.vertex;
                    });
  for (const std::uint32_t v : welded) {
    if (v != kNowhere) continue;
    throw Error(ErrorCode::internal,
                "tile " + name_of(tiles_[tile].record.id()) + " has a vertex that no tile owns",
                "Please report this with the scene and the command.");
  }
  return welded;
}

template <class Write>
void Weld::for_each_triangle(const Write& write) const {
  for (std::size_t t = 0; t < first_vertex_.size(); ++t) {
    if (tiles_[t].record.triangles == 0) continue;
    Seam seam = tiles_.seam(t);
    const Mesh mesh = tiles_.mesh(t, seam);
    const auto at = welded(t, seam, mesh.positions.size());
    for (const auto& [a, b, c] : mesh.triangles) write(std::array{at[a], at[b], at[c]});
  }
}

void Weld::write_ply(std::ostream& stream) const {
  write_ply_head(vertices_, triangles_, far_out_, stream);
  for_each_vertex([&](Vec3d position, Vec3f normal) {
    if (far_out_) {
      write_record(stream, position, normal);
    } else {
      write_record(stream, Vec3f(position), normal);
    }
  });
  for_each_triangle([&](const auto& triangle) { write_record(stream, std::uint8_t{3}, triangle); });
}

void Weld::write_glb(std::ostream& stream) const {
  const Vec3d origin = middle_origin();
  const auto rounded = [&](Vec3d position) { return Vec3f(position - origin); };
  Box box;
  if (!box_.empty()) {
    box.low = Vec3d(rounded(box_.low));
    box.high = Vec3d(rounded(box_.high));
  }
  write_glb_head({.vertices = vertices_,
                  .triangles = triangles_,
                  .origin = origin,
                  .box = box,
                  .colour = colour()},
                 stream);
  for_each_vertex(
      [&](Vec3d position, Vec3f normal) { write_record(stream, rounded(position), normal); });
  for_each_triangle([&](const auto& triangle) { write_record(stream, triangle); });
}

}  // namespace

FileRecord weld(const StoredTiles& tiles, const fs::path& file) {
  ForestFolder& folder = tiles.folder();
  const Weld weld(tiles);
  const auto write = [&](std::ostream& stream) {
    lower_extension(file) == ".ply" ? weld.write_ply(stream) : weld.write_glb(stream);
  };
  // Tell the forest of the file before it is there, so that a restart can remove it.
  const auto announce = [&](const FileRecord& record) {
    const Json files{{file.string(), record}};
    folder.write(folder.files(), sealed_text({{"schema", kFilesSchema}, {"files", files}}));
    folder.sync();
  };
  const fs::path destination = resolve_destination(folder.path() / file);
  FileRecord record = folder.write(destination, write, announce);
  folder.sync();
  return record;
}

}  // namespace leafhull
