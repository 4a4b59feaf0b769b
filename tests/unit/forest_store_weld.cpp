// SPDX-License-Identifier: Apache-2.0
#include <tiny_gltf.h>

#include <cstring>

#include "forest/tile_mesh.h"
#include "unit/forest_store_test.h"
#include "unit/khronos_validator.h"
#include "unit/load_glb.h"

namespace leafhull::test {
namespace {

/// Reads a binary PLY that leafhull wrote.
Mesh read_ply(const std::string& bytes, bool doubles) {
  const std::size_t head = bytes.find("end_header\n") + 11;
  const auto number_behind = [&](const std::string& words) {
    return std::stoul(bytes.substr(bytes.find(words) + words.size()));
  };
  EXPECT_EQ(bytes.find("property double x") < head, doubles);
  Mesh mesh;
  mesh.positions.resize(number_behind("element vertex "));
  mesh.normals.resize(mesh.positions.size());
  mesh.triangles.resize(number_behind("element face "));
  const char* at = bytes.data() + head;
  const auto take = [&]<class T>(T& value) {
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
  };
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (doubles) {
      Vec3d position;
      take(position);
      mesh.positions[v] = Vec3f(position - Vec3d{1 << 20, 0, 0});
    } else {
      take(mesh.positions[v]);
    }
    take(mesh.normals[v]);
  }
  for (auto& triangle : mesh.triangles) {
    EXPECT_EQ(*at++, 3);
    take(triangle);
  }
  EXPECT_EQ(at, bytes.data() + bytes.size());
  return mesh;
}

/// Reads a welded GLB, whose vertices are interleaved.
Mesh read_welded_glb(const std::string& bytes) {
  const tinygltf::Model model = load_glb(bytes);
  const auto& accessors = model.accessors;
  Mesh mesh;
  mesh.positions.resize(accessors.at(0).count);
  mesh.normals.resize(accessors.at(1).count);
  mesh.triangles.resize(accessors.at(2).count / 3);
  const unsigned char* const data = model.buffers.at(0).data.data();
  Box box;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    std::memcpy(&mesh.positions[v], data + 24 * v, 12);
    std::memcpy(&mesh.normals[v], data + 24 * v + 12, 12);
    box.include(Vec3d(mesh.positions[v]));
  }
  std::memcpy(mesh.triangles.data(), data + 24 * mesh.positions.size(), 12 * mesh.triangles.size());
  EXPECT_EQ(accessors.at(0).minValues, (std::vector{box.low.x, box.low.y, box.low.z}));
  EXPECT_EQ(accessors.at(0).maxValues, (std::vector{box.high.x, box.high.y, box.high.z}));
  const std::vector<double>& origin = model.nodes.at(0).translation;
  if (!origin.empty()) mesh.origin = {origin[0], origin[1], origin[2]};
  return mesh;
}

Vec3f unit(Vec3f normal) { return Vec3f(Vec3d(normal) / length(Vec3d(normal))); }

void expect_equal(const Mesh& found, const Mesh& expected) {
  ASSERT_EQ(found.positions.size(), expected.positions.size());
  EXPECT_EQ(found.positions, expected.positions);
  EXPECT_EQ(found.triangles, expected.triangles);
  for (std::size_t v = 0; v < found.normals.size(); ++v) {
    ASSERT_EQ(found.normals[v], unit(expected.normals[v])) << v;
  }
}

class ForestWeld : public testing::Test {
 protected:
  FinishedForest put(const Tiles& tiles, const SmallPieces& small, const fs::path& single) {
    Store store(folder.path(), plan(), "one", true, false);
    for (const auto& [id, tile] : tiles) {
      if (!store.done().contains(id)) store.put(tile, record(id));
    }
    return put_in_place(store, ids_of(tiles), kEdge, small, single);
  }

  TemporaryFolder folder;
};

TEST_F(ForestWeld, IsTheMeshThatWasCut) {
  const Welded expected = expected_weld(sample(), kEdge, 0);
  ASSERT_EQ(open_edges(sample().mesh), 0u);
  const FinishedForest forest = put(sample_tiles(), {}, "all.ply");
  expect_equal(read_ply(content(folder / "all.ply"), false), expected.mesh);
  EXPECT_EQ(open_edges(read_ply(content(folder / "all.ply"), false)), 0u);
  EXPECT_EQ(forest.dropped_components, 0u);
  EXPECT_EQ(forest.single->sha256, record_of_file(folder / "all.ply").sha256);
  EXPECT_EQ(forest.single->bytes, fs::file_size(folder / "all.ply"));
}

TEST_F(ForestWeld, DropsSmallPiecesOverSeamsAlone) {
  const Welded expected = expected_weld(sample(), kEdge, small_pieces().least[0]);
  ASSERT_EQ(expected.dropped, 4u);
  const FinishedForest forest = put(sample_tiles(), small_pieces(), "all.ply");
  EXPECT_EQ(forest.dropped_components, 4u);
  expect_equal(read_ply(content(folder / "all.ply"), false), expected.mesh);
  EXPECT_EQ(open_edges(expected.mesh), 0u);
}

TEST_F(ForestWeld, EveryWayOfCuttingGivesTheSame) {
  for (const ExactVolume least : {ExactVolume{0}, voxels(14), voxels(1e6)}) {
    for (const int edge : {6, 64}) {
      const TemporaryFolder other;
      Store store(other.path(), plan(), "one", false, false);
      const Tiles tiles = cut(sample(), edge);
      for (const auto& [id, tile] : tiles) store.put(tile, record(id));
      put_in_place(store, ids_of(tiles), edge, {.least = {least}}, "all.ply");
      const Welded expected = expected_weld(sample(), edge, least);
      expect_equal(read_ply(content(other / "all.ply"), false), expected.mesh);
    }
  }
}

TEST_F(ForestWeld, WritesAGlb) {
  const Welded expected = expected_weld(sample(), kEdge, small_pieces().least[0]);
  put(sample_tiles(), small_pieces(), "all.glb");
  const Mesh mesh = read_welded_glb(content(folder / "all.glb"));
  expect_equal(mesh, expected.mesh);
  EXPECT_EQ(mesh.origin, Vec3d{});
}

TEST_F(ForestWeld, PassesTheKhronosValidator) {
  const FinishedForest forest = put(sample_tiles(), small_pieces(), "all.glb");
  std::vector<fs::path> files{folder / "all.glb"};
  for (const auto& entry : fs::directory_iterator(folder / "tiles" / "0")) {
    files.push_back(entry.path());
  }
  EXPECT_EQ(files.size(), 1 + forest.tiles.size());
  expect_valid_gltf(files, folder / "log");
}

TEST_F(ForestWeld, KeepsTheDigitsOfAFarForest) {
  Tiles tiles = sample_tiles();
  const Vec3d far{1 << 20, 0, 0};
  for (auto& [id, tile] : tiles) tile.mesh.origin = far;
  const Welded expected = expected_weld(sample(), kEdge, small_pieces().least[0]);
  put(tiles, small_pieces(), "all.ply");
  expect_equal(read_ply(content(folder / "all.ply"), true), expected.mesh);
  put(tiles, small_pieces(), "all.glb");
  const Mesh mesh = read_welded_glb(content(folder / "all.glb"));
  expect_equal(mesh, expected.mesh);
  EXPECT_EQ(mesh.origin, far);
}

TEST_F(ForestWeld, PutsEveryTileInPlace) {
  const Tiles tiles = sample_tiles();
  const FinishedForest forest = put(tiles, small_pieces(), "all.ply");
  const Welded expected = expected_weld(sample(), kEdge, small_pieces().least[0]);
  std::size_t triangles = 0, lighter = 0;
  std::set<fs::path> files;
  for (const TileRecord& tile : forest.tiles) {
    const TileSurface& before = tiles.at(tile.id());
    const std::string name = std::to_string(tile.x) + "_" + std::to_string(tile.y) + "_" +
                             std::to_string(tile.z) + ".glb";
    const fs::path file = folder / "tiles" / "0" / name;
    files.insert(file);
    EXPECT_EQ(tile.mesh.sha256, record_of_file(file).sha256);
    const Mesh mesh = read_mesh(content(file), file.string());
    EXPECT_EQ(mesh.triangles.size(), tile.triangles);
    EXPECT_EQ(mesh.positions.size(), tile.vertices);
    EXPECT_EQ(bounds_of(mesh).low, tile.bounds.low);
    EXPECT_EQ(bounds_of(mesh).high, tile.bounds.high);
    triangles += mesh.triangles.size();
    if (mesh.positions.size() == before.mesh.positions.size()) {
      EXPECT_EQ(mesh.positions, before.mesh.positions);
      EXPECT_EQ(fs::hard_link_count(file), 2u) << "copied where a second name does";
    } else {
      ++lighter;
    }
  }
  EXPECT_EQ(triangles, expected.mesh.triangles.size());
  EXPECT_GT(lighter, 0u);
  EXPECT_TRUE(std::is_sorted(forest.tiles.begin(), forest.tiles.end(),
                             [](const auto& a, const auto& b) { return a.id() < b.id(); }));
  // Tiles that have lost all pieces have no file.
  std::size_t lost = 0;
  for (const auto& [id, tile] : tiles) {
    const auto is_it = [&, wanted = id](const TileRecord& found) { return found.id() == wanted; };
    lost += !tile.mesh.triangles.empty() &&
            std::none_of(forest.tiles.begin(), forest.tiles.end(), is_it);
  }
  EXPECT_GT(lost, 0u);
  for (const auto& entry : fs::directory_iterator(folder / "tiles" / "0")) {
    EXPECT_TRUE(files.contains(entry.path())) << entry.path();
  }
}

TEST_F(ForestWeld, AgainLeavesWhatWasThere) {
  put(sample_tiles(), small_pieces(), "all.ply");
  const auto before = tree(folder.path());
  put(sample_tiles(), small_pieces(), "all.ply");
  EXPECT_TRUE(tree(folder.path()) == before);
}

TEST_F(ForestWeld, TakesLevelsOneByOne) {
  const Tiles fine = sample_tiles();
  Tiles all = fine;
  for (const auto& [id, tile] : cut(sample(), kEdge, 1)) all[id] = tile;
  const FinishedForest forest = put(all, {.least = {0, voxels(14)}}, "all.ply");
  EXPECT_EQ(forest.dropped_components, 4u);
  expect_equal(read_ply(content(folder / "all.ply"), false),
               expected_weld(sample(), kEdge, 0).mesh);
  EXPECT_EQ(forest.tiles.back().level, 1);
}

TEST_F(ForestWeld, ATileMayHaveVerticesAlone) {
  const Tiles tiles = sample_tiles();
  const auto loose = std::count_if(tiles.begin(), tiles.end(), [](const auto& entry) {
    const Mesh& mesh = entry.second.mesh;
    return mesh.triangles.empty() && !mesh.positions.empty();
  });
  EXPECT_GT(loose, 0) << "the sample no longer tests it";
}

TEST_F(ForestWeld, ACrackIsAnError) {
  for (const bool whole_tile : {false, true}) {
    const TemporaryFolder other;
    Tiles tiles = sample_tiles();
    auto lender = std::find_if(tiles.begin(), tiles.end(), [](const auto& entry) {
      return entry.first.at == Coord{0, 0, 0};
    });
    if (whole_tile) {
      tiles.erase(lender);
    } else {
      lender->second.lent.erase(lender->second.lent.begin() + 1);
    }
    Store store(other.path(), plan(), "one", true, false);
    for (const auto& [id, tile] : tiles) store.put(tile, record(id));
    const std::string failure = failure_of(
        [&] { put_in_place(store, ids_of(tiles), kEdge, small_pieces(), std::nullopt); });
    EXPECT_TRUE(failure.starts_with("1 ")) << failure;
    EXPECT_NE(failure.find("0/0_0_0"), std::string::npos) << failure;
  }
}

}  // namespace
}  // namespace leafhull::test
