// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "forest/seam_pieces.h"
#include "forest/stored_tiles.h"
#include "forest/tile_json.h"
#include "forest/tile_mesh.h"
#include "forest/weld.h"
#include "output/writers.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

/// Tiles in memory at once.
constexpr int kPlacedAtOnce = 8;

/// A tile that loses nothing is the file that it was.
PlacedTile place_whole(const StoredTiles& tiles, std::size_t t) {
  const TileRecord& record = tiles[t];
  ForestFolder& folder = tiles.folder();
  if (record.triangles == 0) {
    remove_path(folder.tile(record.id));
  } else {
    tiles.mesh_file(t);  // for its checksum
    folder.link(folder.mesh(record.id), folder.tile(record.id));
  }
  return {.mesh = record.mesh,
          .kept_seam = {},
          .vertices = record.vertices,
          .triangles = record.triangles,
          .own_vertices = record.own_vertices,
          .bounds = record.bounds};
}

PlacedTile place_rest(const StoredTiles& tiles, std::size_t t,
                      std::span<const std::uint32_t> dropped) {
  const TileRecord& record = tiles[t];
  ForestFolder& folder = tiles.folder();
  Seam seam = tiles.seam(t);
  Mesh mesh = tiles.mesh(t, seam);
  drop_pieces(mesh, seam, dropped);

  PlacedTile placed{.mesh = {},
                    .kept_seam = {},
                    .vertices = mesh.positions.size(),
                    .triangles = mesh.triangles.size(),
                    .own_vertices = seam.own_vertices,
                    .bounds = bounds_of(mesh)};
  if (mesh.triangles.empty()) {
    remove_path(folder.tile(record.id));
    seam.loose = std::move(mesh);
  } else {
    placed.mesh = folder.write(folder.tile(record.id),
                               [&](std::ostream& stream) { write_glb_again(mesh, stream); });
  }
  placed.kept_seam = folder.write(folder.kept_seam(record.id),
                                  [&](std::ostream& stream) { write_seam(seam, stream); });
  return placed;
}

FinishedTile finished(const TileId& id, const PlacedTile& placed) {
  return {.id = id,
          .mesh = placed.mesh,
          .vertices = placed.vertices,
          .triangles = placed.triangles,
          .bounds = placed.bounds};
}

}  // namespace

FinishedForest put_in_place(Store& store, std::span<const TileId> ids, int tile_edge,
                            const SmallPieces& small, const std::optional<fs::path>& single) {
  const StoredTiles tiles(store, ids, tile_edge);
  const DroppedPieces dropped = find_small_pieces(tiles, small);
  FinishedForest forest;
  forest.dropped_components = dropped.count;

  std::vector<PlacedTile> placed(tiles.size());
  tbb::task_arena few(std::min(kPlacedAtOnce, tbb::this_task_arena::max_concurrency()));
  few.execute([&] {
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t t) {
      const auto& pieces = dropped.of_tile[t];
      placed[t] = pieces.empty() ? place_whole(tiles, t) : place_rest(tiles, t, pieces);
    });
  });
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    if (placed[t].triangles > 0) forest.tiles.push_back(finished(tiles[t].id, placed[t]));
  }
  tiles.folder().sync();
  if (single && !forest.tiles.empty()) forest.single = weld(tiles, placed, *single);
  return forest;
}

void finish_store(Store& store, std::span<const FinishedTile> tiles,
                  const std::map<std::string, FileRecord>& files) {
  Json others = Json::object(), rows = Json::array();
  for (const auto& [name, record] : files) others[name] = record;
  for (const FinishedTile& tile : tiles) {
    Json row{{"file", "tiles/" + name_of(tile.id) + ".glb"}};
    row.update(Json(tile.mesh));
    row["vertices"] = tile.vertices;
    row["triangles"] = tile.triangles;
    row["bounds"] = json_of(tile.bounds);
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
