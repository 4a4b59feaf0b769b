// SPDX-License-Identifier: Apache-2.0
// What a plan of a forest refuses before any tile is computed.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "leafhull/device.h"
#include "leafhull/error.h"
#include "leafhull/forest.h"
#include "leafhull/ranks.h"
#include "unit/temporary_folder.h"

namespace leafhull::test {
namespace {

namespace fs = std::filesystem;

constexpr int kUsage = static_cast<int>(ErrorCode::usage);
constexpr int kOutput = static_cast<int>(ErrorCode::output);

class ForestPlans : public testing::Test {
 protected:
  ForestPlan plan_with(const fs::path& single) const {
    ForestOptions options;
    options.single = single;
    return plan_forest(options, folder_ / "stand", folder_ / "stand.csv");
  }

  /// The code of the error that `action` throws with `words` in its sentence; 0 if it throws none.
  template <class Action>
  int code_of(const Action& action, const std::string& words) const {
    try {
      action();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      return static_cast<int>(error.code());
    }
    return 0;
  }

  int refusal(const fs::path& single, const std::string& words) const {
    return code_of([&] { (void)plan_with(single); }, words);
  }

  TemporaryFolder folder_;
};

TEST_F(ForestPlans, CheckTheWeldedMesh) {
  EXPECT_EQ(refusal(folder_ / "stand.glb", ""), 0);
  EXPECT_EQ(refusal(folder_ / "stand" / "all.PLY", ""), 0);
  EXPECT_EQ(refusal(folder_ / "stand.obj", "--single cannot be written"), kUsage);
  EXPECT_EQ(refusal(folder_ / "all", "--single cannot be written"), kUsage);
  EXPECT_EQ(refusal(folder_ / "stand" / "forest.glb", "the forest's files"), kUsage);
  EXPECT_EQ(refusal(folder_ / "missing" / "stand.glb", "missing does not exist"), kOutput);
  EXPECT_EQ(folder_.names(), std::set<std::string>{});
  fs::create_directory(folder_ / "folder.glb");
  EXPECT_EQ(refusal(folder_ / "folder.glb", "folder.glb"), kOutput);
}

TEST_F(ForestPlans, HoldTheWeldedMeshRelativeToTheFolder) {
  const ForestPlan plan = plan_with(folder_ / "stand.glb");
  EXPECT_EQ(plan.options().single, "../stand.glb");
  EXPECT_EQ(plan.single()->path(), folder_ / "stand.glb");
}

TEST_F(ForestPlans, CheckTheScene) {
  const auto plan = [&](const fs::path& scene) {
    return [this, scene] { (void)plan_forest({}, folder_ / "stand", scene); };
  };
  EXPECT_EQ(code_of(plan({}), ""), 0);
  EXPECT_EQ(code_of(plan(folder_ / "stand" / "forest.csv"), ""), 0);
  EXPECT_EQ(code_of(plan(folder_ / "stand" / "forest.glb"), "the scene"), kUsage);
  ForestOptions options;
  options.single = folder_ / "scene.glb";
  EXPECT_EQ(code_of([&] { plan_forest(options, folder_ / "stand", *options.single); },
                    "is the input itself"),
            kUsage);
}

TEST_F(ForestPlans, CheckTheReport) {
  const ForestPlan plan = plan_forest({}, folder_ / "stand", folder_ / "scene.json");
  const auto report = [&](const fs::path& file) {
    return [&plan, file] { (void)plan.report_file(file); };
  };
  EXPECT_EQ(code_of(report(folder_ / "stand" / "report.json"), ""), 0);
  EXPECT_EQ(code_of(report(folder_ / "report.txt"), "not a .json file"), kUsage);
  EXPECT_EQ(code_of(report(folder_ / "scene.json"), "is the input itself"), kUsage);
  EXPECT_EQ(code_of(report(folder_ / "stand" / "tileset.json"), "--report"), kUsage);
}

TEST_F(ForestPlans, KeepTheModels) {
  const auto run = [&](const fs::path& model) {
    return [this, model] {
      Scene scene;
      scene.models.emplace_back().file = model;
      Device device({});
      run_forest(scene, plan_with(folder_ / "tree.glb"), device, *single_rank());
    };
  };
  EXPECT_EQ(code_of(run(folder_ / "tree.glb"), "is the input itself"), kUsage);
  EXPECT_EQ(code_of(run(folder_ / "stand" / "tiles" / "tree.glb"), "the model"), kUsage);
  EXPECT_FALSE(fs::exists(folder_ / "stand"));
}

}  // namespace
}  // namespace leafhull::test
