// SPDX-License-Identifier: Apache-2.0
#include "forest/stored_tiles.h"

#include <algorithm>
#include <utility>

#include "forest/tile_mesh.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorCode::internal, what, "Please report this with the scene and the command.");
}

std::int32_t floor_divided(std::int32_t value, std::int32_t by) {
  return value / by - (value % by < 0 ? 1 : 0);
}

std::string text_of(const SeamVertex& vertex) {
  const auto& [x, y, z] = vertex.cell;
  return "vertex " + std::to_string(vertex.patch) + " of cell " + std::to_string(x) + " " +
         std::to_string(y) + " " + std::to_string(z);
}

}  // namespace

StoredTiles::StoredTiles(Store& store, std::span<const TileId> tiles, int tile_edge)
    : folder_(store.folder()), tile_edge_(tile_edge) {
  std::vector<TileId> ids(tiles.begin(), tiles.end());
  std::ranges::sort(ids);
  for (const TileId& id : ids) {
    const auto done = store.done().find(id);
    if (done == store.done().end()) fail("tile " + name_of(id) + " is not done");
    tiles_.push_back({.record = done->second});
  }
}

Seam StoredTiles::seam(std::size_t tile) const {
  const auto& [record, placed, cut] = tiles_[tile];
  if (record.seam.sha256.empty()) {
    Seam seam;
    seam.own_vertices = static_cast<std::uint32_t>(record.own_vertices);
    return seam;
  }
  const std::filesystem::path file =
      cut ? folder_.kept_seam(record.id()) : folder_.seam(record.id());
  return read_seam(checked_content(file, record.seam), file.string());
}

std::filesystem::path StoredTiles::mesh_path(const StoredTile& tile) const {
  return tile.placed ? folder_.tile(tile.record.id()) : folder_.mesh(tile.record.id());
}

std::string StoredTiles::mesh_file(std::size_t tile) const {
  return checked_content(mesh_path(tiles_[tile]), tiles_[tile].record.mesh);
}

Mesh StoredTiles::mesh(std::size_t tile, Seam& seam) const {
  if (tiles_[tile].record.mesh.sha256.empty()) return std::exchange(seam.loose, {});
  return read_mesh(mesh_file(tile), mesh_path(tiles_[tile]).string());
}

std::size_t StoredTiles::owner(int level, const SeamVertex& vertex) const {
  const auto at = [&](std::int32_t cell) { return floor_divided(cell, tile_edge_); };
  const TileId id{level, {at(vertex.cell.x), at(vertex.cell.y), at(vertex.cell.z)}};
  const auto id_of = [](const StoredTile& tile) { return tile.record.id(); };
  const auto found = std::ranges::lower_bound(tiles_, id, {}, id_of);
  if (found == tiles_.end() || id_of(*found) != id) {
    fail("no tile " + name_of(id) + ", which owns " + text_of(vertex));
  }
  return static_cast<std::size_t>(found - tiles_.begin());
}

void for_each_borrowed(
    const StoredTiles& tiles, std::size_t tile, const Seam& seam,
    const std::function<void(const SeamVertex&, std::size_t, const SeamVertex&)>& visit) {
  std::vector<std::pair<std::size_t, const SeamVertex*>> by_owner;
  for (const SeamVertex& vertex : seam.borrowed) {
    by_owner.emplace_back(tiles.owner(tiles[tile].record.level, vertex), &vertex);
  }
  std::ranges::stable_sort(by_owner, {}, [](const auto& entry) { return entry.first; });

  std::vector<SeamVertex> lent;
  for (std::size_t i = 0; i < by_owner.size(); ++i) {
    const auto& [owner, vertex] = by_owner[i];
    if (i == 0 || owner != by_owner[i - 1].first) lent = tiles.seam(owner).lent;
    const auto found = std::ranges::lower_bound(lent, *vertex);
    if (found == lent.end() || *found != *vertex) {
      fail("tile " + name_of(tiles[owner].record.id()) + " lacks " + text_of(*vertex) +
           ", which tile " + name_of(tiles[tile].record.id()) + " borrows");
    }
    visit(*vertex, owner, *found);
  }
}

}  // namespace leafhull
