// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "forest/tileset.h"
#include "leafhull/error.h"
#include "leafhull/version.h"

namespace leafhull::test {
namespace {

using nlohmann::json;

constexpr std::array kErrors{0.25, 0.75, 2.0, 6.0};

/// A tile whose surface fills a part of its cube. Cubes of level 0 have an edge of 16.
TileRecord tile(int level, Coord at) {
  const double edge = 16.0 * (1 << level);
  TileRecord tile({level, at});
  tile.mesh = {.bytes = 1, .sha256 = "a"};
  tile.bounds.include((to_vec3d(at) + Vec3d{0.1, 0.2, 0.3}) * edge);
  tile.bounds.include((to_vec3d(at) + Vec3d{0.7, 0.8, 0.9}) * edge);
  return tile;
}

TileRecord empty_tile(int level, Coord at) { return TileRecord({level, at}); }

json tileset(const std::vector<TileRecord>& tiles) {
  return json::parse(tileset_json(tiles, kErrors));
}

std::string uri(const json& tile) {
  return tile.contains("content") ? tile.at("content").at("uri").get<std::string>() : "";
}

std::string uri(const TileId& id) {
  return "tiles/" + std::to_string(id.level) + "/" + std::to_string(id.at.x) + "_" +
         std::to_string(id.at.y) + "_" + std::to_string(id.at.z) + ".glb";
}

/// Calls `visit` for every tile with its ancestors, the root first.
template <class Visit>
void visit_tiles(const json& tile, Visit&& visit, std::vector<const json*> ancestors = {}) {
  visit(tile, ancestors);
  ancestors.push_back(&tile);
  if (!tile.contains("children")) return;
  for (const json& child : tile.at("children")) visit_tiles(child, visit, ancestors);
}

std::vector<std::string> uris(const json& tileset) {
  std::vector<std::string> found;
  visit_tiles(tileset["root"], [&](const json& tile, const auto&) {
    if (!uri(tile).empty()) found.push_back(uri(tile));
  });
  std::ranges::sort(found);
  return found;
}

/// Checks every tile against its ancestors, and that each surface occurs exactly once.
void check(const json& tileset, const std::vector<TileRecord>& tiles) {
  std::map<std::string, Box> surfaces;
  for (const TileRecord& tile : tiles) {
    if (!tile.mesh.sha256.empty()) surfaces[uri(tile.id())] = tile.bounds;
  }
  std::vector<std::string> expected;
  for (const auto& [name, bounds] : surfaces) expected.push_back(name);
  std::ranges::sort(expected);
  EXPECT_EQ(uris(tileset), expected);

  const auto contains = [](const json& tile, const Box& bounds) {
    const auto box = tile["boundingVolume"]["box"].get<std::array<double, 12>>();
    for (const std::size_t off_axis : {4, 5, 6, 8, 9, 10}) {
      if (box[off_axis] != 0) return false;
    }
    return box[0] - box[3] <= bounds.low.x && box[0] + box[3] >= bounds.high.x &&
           box[1] - box[7] <= -bounds.high.z && box[1] + box[7] >= -bounds.low.z &&
           box[2] - box[11] <= bounds.low.y && box[2] + box[11] >= bounds.high.y;
  };
  EXPECT_GT(tileset["geometricError"], tileset["root"]["geometricError"]);
  visit_tiles(tileset["root"], [&](const json& tile, const std::vector<const json*>& ancestors) {
    if (!ancestors.empty()) {
      EXPECT_GE((*ancestors.back())["geometricError"], tile["geometricError"]);
    }
    if (uri(tile).empty()) {
      EXPECT_TRUE(tile.contains("children") && !tile.at("children").empty()) << "leads nowhere";
      return;
    }
    const Box& bounds = surfaces.at(uri(tile));
    EXPECT_TRUE(contains(tile, bounds)) << tile;
    for (const json* ancestor : ancestors) EXPECT_TRUE(contains(*ancestor, bounds)) << *ancestor;
  });
}

TEST(Tileset, HasOneTileForASingleSurface) {
  const TileRecord only = tile(0, {1, 2, 3});
  const json tileset = test::tileset({only});
  EXPECT_EQ(tileset["asset"]["version"], "1.1");
  EXPECT_EQ(tileset["asset"]["extras"]["generator"], std::string("leafhull ") + kVersion);
  const json& root = tileset["root"];
  EXPECT_EQ(root["refine"], "REPLACE");
  EXPECT_EQ(root["geometricError"], kErrors[0]);
  EXPECT_EQ(uri(root), "tiles/0/1_2_3.glb");
  EXPECT_FALSE(root.contains("children"));
  check(tileset, {only});
}

TEST(Tileset, TurnsBoxesUpright) {
  TileRecord flat = tile(0, {});
  flat.bounds = {};
  flat.bounds.include({10, 100, -7});  // y is up, as in glTF
  flat.bounds.include({12, 104, -1});
  const json box = test::tileset({flat})["root"]["boundingVolume"]["box"];
  EXPECT_EQ(box, json({11, 4, 102, 1, 0, 0, 0, 3, 0, 0, 0, 2}));  // z is up
}

TEST(Tileset, ReplacesATileByThoseWithinIt) {
  const std::vector tiles{tile(0, {4, 2, 0}), tile(0, {5, 3, 1}), tile(0, {6, 2, 0}),
                          tile(1, {2, 1, 0}), tile(1, {3, 1, 0}), tile(2, {1, 0, 0})};
  const json tileset = test::tileset(tiles);
  const json& root = tileset["root"];
  EXPECT_EQ(uri(root), "tiles/2/1_0_0.glb");
  EXPECT_EQ(root["geometricError"], kErrors[2]);
  ASSERT_EQ(root.at("children").size(), 2u);
  const json& left = root.at("children")[0];
  EXPECT_EQ(uri(left), "tiles/1/2_1_0.glb");
  EXPECT_EQ(left["geometricError"], kErrors[1]);
  ASSERT_EQ(left.at("children").size(), 2u);
  EXPECT_EQ(uri(left.at("children")[1]), "tiles/0/5_3_1.glb");
  EXPECT_EQ(left.at("children")[1]["geometricError"], kErrors[0]);
  check(tileset, tiles);
}

TEST(Tileset, StandsOverSeveralTilesOfTheCoarsestLevel) {
  const std::vector tiles{tile(1, {0, 0, 0}), tile(1, {7, 0, 0})};
  const json tileset = test::tileset(tiles);
  const json& root = tileset["root"];
  EXPECT_EQ(uri(root), "");
  EXPECT_EQ(root.at("children").size(), 2u);
  EXPECT_GT(root["geometricError"], 7 * 32) << "what is missing is as wide as the forest";
  check(tileset, tiles);
}

TEST(Tileset, FindsTheParentOfNegativeCoordinates) {
  const std::vector tiles{tile(0, {-1, -2, 0}), tile(0, {-3, 0, 0}), tile(1, {-1, -1, 0}),
                          tile(1, {-2, 0, 0}), tile(1, {0, 0, 0})};
  const json tileset = test::tileset(tiles);
  for (const json& coarse : tileset["root"].at("children")) {
    if (uri(coarse) == "tiles/1/-1_-1_0.glb") {
      ASSERT_EQ(coarse.at("children").size(), 1u);
      EXPECT_EQ(uri(coarse.at("children")[0]), "tiles/0/-1_-2_0.glb");
    } else if (uri(coarse) == "tiles/1/-2_0_0.glb") {
      ASSERT_EQ(coarse.at("children").size(), 1u);
      EXPECT_EQ(uri(coarse.at("children")[0]), "tiles/0/-3_0_0.glb");
    } else {
      EXPECT_FALSE(coarse.contains("children"));
    }
  }
  check(tileset, tiles);
}

TEST(Tileset, MakesParentsThatHaveNoSurface) {
  const std::vector tiles{tile(0, {0, 0, 0}), tile(0, {40, 0, 0}), tile(2, {0, 0, 0}),
                          empty_tile(1, {20, 0, 0})};
  const json tileset = test::tileset(tiles);
  const json& far = tileset["root"].at("children")[1];  // an ancestor of the tile at 40
  EXPECT_EQ(uri(far), "");
  EXPECT_EQ(far["geometricError"], kErrors[2]);
  EXPECT_EQ(uri(far.at("children")[0]), "");
  EXPECT_EQ(far.at("children")[0]["geometricError"], kErrors[1]);
  EXPECT_EQ(uri(far.at("children")[0].at("children")[0]), "tiles/0/40_0_0.glb");
  check(tileset, tiles);
}

TEST(Tileset, LeavesEmptyTilesOut) {
  const std::vector tiles{tile(0, {0, 0, 0}), empty_tile(0, {1, 0, 0}), tile(1, {0, 0, 0}),
                          empty_tile(1, {5, 0, 0}), empty_tile(2, {0, 0, 0})};
  const json tileset = test::tileset(tiles);
  EXPECT_EQ(uri(tileset["root"]), "tiles/1/0_0_0.glb") << "the coarsest level with a surface";
  check(tileset, tiles);
}

TEST(Tileset, NeedsASurface) {
  EXPECT_THROW(test::tileset({empty_tile(0, {})}), Error);
  EXPECT_THROW(test::tileset({}), Error);
}

/// Tiles of four levels around the origin; a tenth of the coarser ones are missing.
std::vector<TileRecord> forest(int edge, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 16);
  std::set<TileId> ids;
  for (int x = -edge; x < edge; ++x) {
    for (int z = -edge; z < edge; ++z) {
      TileId id{0, {x, static_cast<int>(random() % 2) - 1, z}};
      for (; id.level < 4; id = id.parent()) {
        if (id.level == 0 || random() % 10 != 0) ids.insert(id);
      }
    }
  }
  std::vector<TileRecord> tiles;
  for (const TileId& id : ids) {
    TileRecord tile = test::tile(id.level, id.at);
    const Vec3d corner = to_vec3d(id.at) * (16.0 * (1 << id.level));
    for (int i = 0; i < 2; ++i) {  // the binary digits of these do not end
      tile.bounds.include(corner + Vec3d{place(random), place(random), place(random)});
    }
    tiles.push_back(tile);
  }
  return tiles;
}

TEST(Tileset, HoldsForAForest) {
  const std::vector<TileRecord> tiles = forest(12, 1);
  check(tileset(tiles), tiles);
}

TEST(Tileset, DoesNotDependOnTheOrderOfTiles) {
  std::vector<TileRecord> tiles = forest(6, 2);
  const std::string text = tileset_json(tiles, kErrors);
  std::ranges::reverse(tiles);
  EXPECT_EQ(tileset_json(tiles, kErrors), text);
}

TEST(Tileset, WritesATilePerLine) {
  const std::vector<TileRecord> tiles = forest(3, 3);
  const std::string text = tileset_json(tiles, kErrors);
  std::size_t count = 0;
  visit_tiles(json::parse(text)["root"], [&](const json&, const auto&) { ++count; });
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(text, '\n')), count + 1);
  EXPECT_EQ(text.back(), '\n');
}

}  // namespace
}  // namespace leafhull::test
