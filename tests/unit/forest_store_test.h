// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "forest/store.h"
#include "leafhull/error.h"
#include "runs/checksum.h"
#include "runs/sealed_json.h"
#include "unit/forest_cut.h"
#include "unit/temporary_folder.h"

namespace leafhull::test {

namespace fs = std::filesystem;

inline std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// The content of every file below a folder; folders count as empty files.
inline std::map<std::string, std::string> tree(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    files[fs::relative(entry.path(), folder).string()] =
        entry.is_regular_file() ? content(entry.path()) : "";
  }
  return files;
}

inline std::vector<TileId> ids_of(const Tiles& tiles) {
  std::vector<TileId> ids;
  for (const auto& [id, tile] : tiles) ids.push_back(id);
  return ids;
}

inline Json plan() {
  return {{"scene", "a.csv"}, {"voxel_size", 0.25}, {"models", {{{"file", "a.glb"}}, {{"n", 3}}}}};
}

/// The code, sentence and remedy of the error that `action` throws; empty if it throws none.
template <class Action>
std::string failure_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return std::to_string(static_cast<int>(error.code())) + " " + error.what() + " | " +
           error.remedy();
  }
  return "";
}

inline constexpr int kEdge = 8;

/// Balls over the seams of 2, 4 and 8 tiles on both sides of zero, some of them small. One is
/// hollow, one lies within a tile, and one is all that its tile has.
inline const LatticeMesh& sample() {
  static const LatticeMesh mesh = mesh_of({{{0.3, 0.2, 0.4}, 6.3},      // eight tiles
                                           {{0.3, 0.2, 0.4}, -3},       // hollow
                                           {{8.1, 0.1, 8.2}, 2.9},      // four
                                           {{-8.2, -8.1, -8.3}, 1.4},   // eight, small
                                           {{8.0, -7.8, 3.6}, 1.3},     // four, small
                                           {{-4.3, 8.2, -11.7}, 1.2},   // two, small
                                           {{-12.4, 4.4, -4.2}, 1.6},   // one
                                           {{12, 12, 12}, 6.95},        // eight, in one by a vertex
                                           {{12.3, 12.4, -0.05}, 1.1},  // two, otherwise empty
                                           {{-12, 12, 12}, 2.5}},       // one, near its border
                                          {-24, -24, -24}, {24, 24, 24});
  return mesh;
}
inline Tiles sample_tiles() { return cut(sample(), kEdge); }

inline ExactVolume voxels(double count) {
  return static_cast<ExactVolume>(count * 12 * 549755813888.0);
}
/// Drops balls with a radius below about 1.5.
inline SmallPieces small_pieces() { return {.least = {voxels(14)}}; }

inline TileRecord record(const TileId& id) { return TileRecord(id); }

/// Puts the missing tiles and finishes the forest.
inline FinishedForest finish(Store& store, const Tiles& tiles, const fs::path& single) {
  for (const auto& [id, tile] : tiles) {
    if (!store.done().contains(id)) store.put(tile, record(id));
  }
  FinishedForest forest = put_in_place(store, ids_of(tiles), kEdge, small_pieces(), single);
  const FileRecord tileset = put_file(store, "tileset.json", [](std::ostream& s) { s << "{}"; });
  finish_store(store, forest.tiles, {{"tileset.json", tileset}, {single.string(), *forest.single}});
  return forest;
}

}  // namespace leafhull::test
