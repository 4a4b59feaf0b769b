// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "forest/stored_tiles.h"
#include "forest/tile_mesh.h"
#include "forest/weld.h"
#include "output/writers.h"
#include "surface/disjoint_sets.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

/// Pieces of surface that cross seams and are too small.
struct DroppedPieces {
  std::vector<std::vector<std::uint32_t>> of_tile;  ///< indices into Seam::components
  std::uint64_t count = 0;
};

/// Joins the components that tiles share and measures the volume that they enclose together.
DroppedPieces find_small_pieces(const StoredTiles& tiles, const SmallPieces& small) {
  std::vector<ExactVolume> volumes;     // of all tiles' components, in one sequence
  std::vector<std::uint32_t> first{0};  // each tile's first component in it
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    for (const SeamComponent& component : tiles.seam(t).components) {
      volumes.push_back(component.volume);
    }
    first.push_back(static_cast<std::uint32_t>(volumes.size()));
  }
  DisjointSets sets(volumes.size());
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    for_each_borrowed(tiles, t, tiles.seam(t),
                      [&](const SeamVertex& borrowed, std::size_t owner, const SeamVertex& lent) {
                        sets.unite(first[owner] + lent.component, first[t] + borrowed.component);
                      });
  }
  const std::vector<std::uint32_t> piece = std::move(sets).lowest();
  std::vector<ExactVolume> whole(volumes.size(), 0);
  for (std::size_t c = 0; c < piece.size(); ++c) whole[piece[c]] += volumes[c];

  DroppedPieces dropped;
  dropped.of_tile.resize(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const auto level = static_cast<std::size_t>(tiles[t].record.level);
    const ExactVolume least = level < small.least.size() ? small.least[level] : 0;
    for (std::uint32_t c = first[t]; c < first[t + 1]; ++c) {
      const ExactVolume volume = whole[piece[c]];  // a hollow's volume is negative
      if (volume >= least || -volume >= least) continue;
      dropped.of_tile[t].push_back(c - first[t]);
      if (piece[c] == c) ++dropped.count;
    }
  }
  return dropped;
}

/// Tiles in memory at once.
constexpr int kPlacedAtOnce = 8;

/// Places a tile that loses nothing: its file stays as it is.
void place_whole(StoredTiles& tiles, std::size_t t) {
  const TileRecord& record = tiles[t].record;
  ForestFolder& folder = tiles.folder();
  if (record.triangles == 0) {
    remove_path(folder.tile(record.id()));
  } else {
    tiles.mesh_file(t);  // for its checksum
    folder.link(folder.mesh(record.id()), folder.tile(record.id()));
  }
  tiles[t].placed = true;
}

void place_rest(StoredTiles& tiles, std::size_t t, std::span<const std::uint32_t> dropped) {
  auto& [record, placed, cut] = tiles[t];
  ForestFolder& folder = tiles.folder();
  Seam seam = tiles.seam(t);
  Mesh mesh = tiles.mesh(t, seam);
  drop_pieces(mesh, seam, dropped);
  record.vertices = mesh.positions.size();
  record.triangles = mesh.triangles.size();
  record.own_vertices = seam.own_vertices;
  record.bounds = bounds_of(mesh);
  if (mesh.triangles.empty()) {
    remove_path(folder.tile(record.id()));
    record.mesh = {};
    seam.loose = std::move(mesh);
  } else {
    record.mesh = folder.write(folder.tile(record.id()),
                               [&](std::ostream& stream) { write_glb_again(mesh, stream); });
  }
  record.seam = folder.write(folder.kept_seam(record.id()),
                             [&](std::ostream& stream) { write_seam(seam, stream); });
  placed = cut = true;
}

}  // namespace

FinishedForest put_in_place(Store& store, std::span<const TileId> ids, int tile_edge,
                            const SmallPieces& small, const std::optional<fs::path>& single) {
  StoredTiles tiles(store, ids, tile_edge);
  const DroppedPieces dropped = find_small_pieces(tiles, small);
  tbb::task_arena few(std::min(kPlacedAtOnce, tbb::this_task_arena::max_concurrency()));
  few.execute([&] {
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
      const auto& pieces = dropped.of_tile[t];
      pieces.empty() ? place_whole(tiles, t) : place_rest(tiles, t, pieces);
    });
  });
  tiles.folder().sync();
  FinishedForest forest;
  forest.dropped_components = dropped.count;
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (tiles[t].record.triangles > 0) forest.tiles.push_back(tiles[t].record);
  }
  if (single && !forest.tiles.empty()) forest.single = weld(tiles, *single);
  return forest;
}

void finish_store(Store& store, std::span<const TileRecord> tiles,
                  const std::map<std::string, FileRecord>& files) {
  Json others = Json::object(), rows = Json::array();
  for (const auto& [name, record] : files) others[name] = record;
  for (const TileRecord& tile : tiles) {
    Json row{{"file", file_of(tile.id())}};
    row.update(Json(tile.mesh));
    row["vertices"] = tile.vertices;
    row["triangles"] = tile.triangles;
    row["bounds"] = tile.bounds;
    rows.push_back(std::move(row));
  }
  ForestFolder& folder = store.folder();
  folder.write(folder.manifest(), sealed_text({{"schema", kManifestSchema},
                                               {"plan", store.plan()},
                                               {"files", std::move(others)},
                                               {"tiles", std::move(rows)}}));
  folder.sync();
  folder.remove_work();
}

}  // namespace leafhull
