// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "png.h"
#include "scene/poisson_disk.h"
#include "scene_files.h"

namespace leafhull {
namespace {

double distance(Vec2d a, Vec2d b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The least distance between any two points; sorts them along x.
double least_distance(std::vector<Vec2d> points) {
  std::ranges::sort(points, {}, &Vec2d::x);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size() && points[j].x - points[i].x < least; ++j) {
      least = std::min(least, distance(points[i], points[j]));
    }
  }
  return least;
}

std::vector<Vec2d> places(const Scene& scene) {
  std::vector<Vec2d> points;
  for (const PlacedTree& tree : scene.trees) points.push_back({tree.position.x, tree.position.z});
  return points;
}

TEST(PoissonDisks, AreAsManyAsAskedForAndKeepTheirDistance) {
  for (const std::size_t count : {1, 2, 3, 7, 100, 5000}) {
    for (const Vec2d area : {Vec2d{10, 10}, Vec2d{1000, 1}, Vec2d{0.001, 0.002}}) {
      Random random(count);
      const Disks disks = poisson_disks(area, count, random);
      EXPECT_EQ(disks.centres.size(), count);
      EXPECT_GE(least_distance(disks.centres), disks.distance);
      EXPECT_GT(disks.distance, 0.6 * std::sqrt(area.x * area.y / double(count)));
      for (const Vec2d p : disks.centres) {
        EXPECT_TRUE(p.x >= 0 && p.x < area.x && p.y >= 0 && p.y < area.y);
      }
    }
  }
}

TEST(PoissonDisks, LeaveNoGaps) {
  Random random(3);
  const Disks disks = poisson_disks({100, 100}, 2500, random);
  std::array<std::array<int, 5>, 5> in_part{};
  for (const Vec2d p : disks.centres) ++in_part[std::size_t(p.x / 20)][std::size_t(p.y / 20)];
  for (const auto& row : in_part) {
    for (const int points : row) EXPECT_NEAR(points, 100, 15);
  }
}

TEST(PoissonDisks, AMillionTakesSeconds) {
  const auto start = std::chrono::steady_clock::now();
  Random random(1);
  const Disks disks = poisson_disks({1000, 1000}, 1'000'000, random);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(disks.centres.size(), 1'000'000u);
  EXPECT_GE(least_distance(disks.centres), 0.7);
  EXPECT_LT(seconds.count(), 120) << "a search of all pairs would take hours";
}

TEST(RandomNumbers, AreThoseOfTheStandardsEngine) {
  // The 10,000th number of mt19937_64 with seed 5489 is 9981545732273789042 ([rand.predef]).
  Random random(5489);
  for (int i = 1; i < 10'000; ++i) random.number();
  EXPECT_EQ(random.number(), double(9981545732273789042u >> 11) / double(1ull << 53));
}

class Scatter : public testing::Test {
 protected:
  void SetUp() override {
    options.trees = {folder.tree("birch.glb", 8), folder.tree("ash.glb", 16)};
    options.count = 1000;
  }

  Scene scatter(const std::string& name = "scene.csv") {
    write_scatter(options, folder / name);
    return read_scene(folder / name, {});
  }

  void refuse(ErrorCode code, const std::string& words) {
    try {
      write_scatter(options, folder / "bad.csv");
      ADD_FAILURE() << "expected: " << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_FALSE(error.remedy().empty());
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "bad.csv"));
  }

  test::SceneFolder folder;
  ScatterOptions options;
};

TEST_F(Scatter, IsReadAgain) {
  options.area = Vec2d{200, 100};
  const Scene scene = scatter();
  EXPECT_EQ(folder.read("scene.csv").substr(0, 22), "model,x,y,z,yaw,scale\n");
  ASSERT_EQ(scene.trees.size(), 1000u);
  ASSERT_EQ(scene.models.size(), 2u);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_GT(least_distance(places(scene)), 0.7 * std::sqrt(20.));
  std::map<std::uint32_t, int> of_model;
  double mean_scale = 0;
  for (const PlacedTree& tree : scene.trees) {
    ++of_model[tree.model];
    EXPECT_LE(std::abs(tree.position.x), 100);
    EXPECT_LE(std::abs(tree.position.z), 50);
    EXPECT_EQ(tree.position.y, 0);
    const double scale = tree.linear[4];
    EXPECT_TRUE(scale > 0.7999 && scale < 1.2001) << scale;
    mean_scale += scale / 1000;
  }
  EXPECT_NEAR(of_model[0], 500, 80);
  EXPECT_NEAR(mean_scale, 1, 0.02);
}

TEST_F(Scatter, YawsGoAllTheWayAround) {
  int in_quarter[4] = {};
  for (const PlacedTree& tree : scatter().trees) {
    ++in_quarter[(tree.linear[0] > 0) + 2 * (tree.linear[2] > 0)];
  }
  for (const int trees : in_quarter) EXPECT_NEAR(trees, 250, 60);
}

TEST_F(Scatter, TheSameOptionsGiveTheSameBytes) {
  scatter("first.csv");
  scatter("again.csv");
  options.seed = 2;
  scatter("other.csv");
  EXPECT_EQ(folder.read("first.csv"), folder.read("again.csv"));
  EXPECT_NE(folder.read("first.csv"), folder.read("other.csv"));
}

TEST_F(Scatter, SpacingIsInCrownWidths) {
  // The crowns are 15 and 31 wide along x and flat along z, so their mean width is 11.5.
  options.count = 2500;
  options.spacing = 0.5;
  options.scale_low = 1, options.scale_high = 3;
  Box box;
  for (const PlacedTree& tree : scatter().trees) box.include(tree.position);
  EXPECT_NEAR(box.size().x, 0.5 * 11.5 * 2 * 50, 12);
  EXPECT_NEAR(box.size().z, 0.5 * 11.5 * 2 * 50, 12);
}

TEST_F(Scatter, ScaleOfOneValueIsKept) {
  options.scale_low = options.scale_high = 0.123456789;
  EXPECT_EQ(scatter().trees[5].linear[4], 0.123456789f);
}

TEST_F(Scatter, SmallForestsKeepTheirDigits) {
  options.area = Vec2d{2e-6, 1e-6};
  options.scale_low = 1e-7, options.scale_high = 2e-7;
  const Scene scene = scatter();
  EXPECT_EQ(scene.trees.size(), 1000u);
  EXPECT_GT(least_distance(places(scene)), 0.7 * std::sqrt(2e-15));
}

TEST_F(Scatter, NamesTreesFromTheFileThatNamesThem) {
  options.trees = {folder.tree("trees/a, b.glb"), folder.tree("deep/er/oak.glb")};
  std::filesystem::create_directory(folder / "scenes");
  std::filesystem::create_directory_symlink(folder / "deep" / "er", folder / "link");
  const Scene scene = scatter("scenes/forest.csv");
  EXPECT_EQ(scene.models.size(), 2u);
  EXPECT_NE(folder.read("scenes/forest.csv").find("\n\"../trees/a, b.glb\","), std::string::npos);
  EXPECT_NE(folder.read("scenes/forest.csv").find("\n../deep/er/oak.glb,"), std::string::npos);
  EXPECT_EQ(scatter("link/forest.csv").models.size(), 2u);
  EXPECT_NE(folder.read("link/forest.csv").find("\noak.glb,"), std::string::npos);
}

TEST_F(Scatter, HeightsAreBetweenThePixels) {
  // Black is on the left and white on the right; the lower row is half as bright.
  const std::vector<std::uint8_t> pixels{0, 0, 0, 255, 254, 254, 254, 255,
                                         0, 0, 0, 255, 127, 127, 127, 255};
  options.ground = {folder.write("hills.png", test::png(2, 2, pixels)), 100};
  options.area = Vec2d{40, 20};
  for (const PlacedTree& tree : scatter().trees) {
    const double right = tree.position.x / 40 + 0.5, down = tree.position.z / 20 + 0.5;
    EXPECT_NEAR(tree.position.y, 100 * right * (254 - 127 * down) / 255, 1e-3);
  }
  options.ground->height = -7;
  for (const PlacedTree& tree : scatter().trees) EXPECT_LE(tree.position.y, 0);
}

TEST_F(Scatter, ReplacesAFileThatIsThere) {
  folder.write("scene.csv", std::string(100'000, 'x'));
  EXPECT_EQ(scatter().trees.size(), 1000u);
}

TEST_F(Scatter, ValuesOutOfRangeAreRefused) {
  const ScatterOptions good = options;
  const auto refuse_with = [&](auto change, const std::string& words) {
    options = good;
    change(options);
    refuse(ErrorCode::usage, words);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuse_with([](auto& o) { o.trees.clear(); }, "no tree is given");
  refuse_with([](auto& o) { o.count = 0; }, "--count 0 is out of range");
  refuse_with([](auto& o) { o.count = 1'000'001; }, "--count 1000001 is out of range");
  refuse_with([](auto& o) { o.area = Vec2d{0, 5}; }, "--area has a side that is not");
  refuse_with([=](auto& o) { o.area = Vec2d{5, nan}; }, "--area has a side that is not");
  refuse_with([](auto& o) { o.area = Vec2d{1, 1e7}; }, "--area is a line");
  refuse_with([](auto& o) { o.spacing = 0; }, "--spacing is not a positive number");
  refuse_with([](auto& o) { o.scale_low = 0; }, "--scale is not a range");
  refuse_with([](auto& o) { o.scale_low = 2; }, "--scale is not a range");
  refuse_with([=](auto& o) { o.scale_high = nan; }, "--scale is not a range");
  refuse_with([=](auto& o) { o.ground = {"none.png", nan}; }, "--height is not a number");
}

TEST_F(Scatter, BadFilesAreRefused) {
  options.ground = {folder / "none.png", 1};
  refuse(ErrorCode::input, "none.png cannot be read: No such file or directory");
  options.ground->picture = folder.write("text.png", std::string("hills"));
  refuse(ErrorCode::input, "text.png is not a PNG picture");
  options.ground->picture = folder.write("cut.png", std::string("\x89PNG\r\n\x1A\n"));
  refuse(ErrorCode::input, "cut.png is damaged");
  options.ground.reset();
  options.trees.push_back(folder / "oak.glb");
  refuse(ErrorCode::input, "oak.glb: cannot be read: No such file or directory");
  test::GlbBuilder bare;
  bare.add_node("", bare.add_mesh("trunk", {test::square(bare.add_material("bark"))}));
  options.trees = {folder.write("bare.glb", bare.glb())};
  options.area = Vec2d{10, 10};
  refuse(ErrorCode::input, "no leaves in");
}

TEST_F(Scatter, TheOutputIsCheckedFirst) {
  options.trees = {folder / "missing.glb"};
  EXPECT_THROW(write_scatter(options, folder / "scene.txt"), Error);
  try {
    write_scatter(options, folder / "nowhere" / "scene.csv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output);
  }
}

}  // namespace
}  // namespace leafhull
