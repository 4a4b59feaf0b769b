// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "foliage_models.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

using test::card;
using test::contains;
using test::taken;
using test::with_ellipse;
using test::with_globs;
using test::with_scale;

/// A tree of trunk, twig and crown; the crown has the given names.
TreeModel tree_with(const std::string& material, const std::string& mesh, const std::string& node,
                    AlphaMode mode = AlphaMode::opaque) {
  TreeModel tree = test::tree_of({card(1, 1), card(2, 2), card(4, 4)});
  tree.path = "oak.glb";
  tree.materials = {{.name = "bark"}, {.name = material, .alpha_mode = mode}};
  tree.primitives[0].mesh_name = "trunk";
  tree.primitives[1].mesh_name = "twig";
  tree.primitives[2].mesh_name = mesh;
  tree.primitives[2].material = 1;
  tree.instances[2].node_name = node;
  return tree;
}

TEST(Asked, GlobsReplaceTheDefaultRule) {
  const TreeModel tree = tree_with("Leaf", "crown", "a", AlphaMode::mask);
  EXPECT_EQ(taken(tree, with_globs({"TW?G"})), (std::vector<bool>{false, true, false}));
  EXPECT_EQ(taken(tree, with_globs({"t[vw]ig", "cr*"})), (std::vector<bool>{false, true, true}));
  EXPECT_EQ(taken(tree, with_globs({"row"})), std::vector<bool>(3, false));
}

TEST(Asked, FindLeavesTakesWhatIsSelected) {
  const TreeModel tree = tree_with("leaf", "crown", "a");
  EXPECT_DOUBLE_EQ(find_leaves(tree, {}).bounds.size().x, 4);
  EXPECT_DOUBLE_EQ(find_leaves(tree, with_globs({"twig"})).bounds.size().x, 2);
}

TEST(Asked, GlobThatMatchesNothingIsNamed) {
  const LeafSet leaves =
      find_leaves(tree_with("leaf", "crown", "a"), with_globs({"crown", "acorn*"}));
  ASSERT_EQ(leaves.warnings.size(), 1u);
  EXPECT_PRED2(contains, leaves.warnings[0], "acorn*");
}

TEST(Asked, ControlCharactersOfNamesAreNotPrinted) {
  try {
    find_leaves(tree_with("a\x1b[31mb\nc", "crown", "top"), with_globs({"acorn"}));
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_PRED2(contains, error.what(), "a?[31mb?c");
  }
}

TEST(Asked, NoMatchNamesWhatThereIs) {
  const TreeModel tree = tree_with("green", "crown", "top");
  try {
    find_leaves(tree, with_globs({"acorn"}));
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_PRED2(contains, error.what(), "oak.glb");
    EXPECT_PRED2(contains, error.what(),
                 "materials bark, green; meshes crown, trunk, twig; "
                 "nodes node, top");
    EXPECT_PRED2(contains, error.remedy(), "--leaves");
  }
}

TEST(Asked, NotLeavesTakesAwayAndLetsTheNextBestWin) {
  const TreeModel tree = tree_with("Leaf", "crown", "a");
  LeafOptions options;
  options.not_globs = {"LEAF"};
  EXPECT_FALSE(taken(tree, options)[2]);
  options.globs = {"*"};
  EXPECT_EQ(taken(tree, options), (std::vector<bool>{true, true, false}));
}

TEST(Asked, PathsNameWhatHangsFromANode) {
  TreeModel tree = tree_with("Leaf", "crown", "Leaves");
  tree.nodes = {{"Tree"}, {"LOD0", 0}, {"Leaves", 1}, {"LOD1", 0}, {"Leaves", 3}};
  tree.instances[2].node = 2;
  tree.instances.push_back({2, "Leaves", kIdentity, 4});
  const auto last = [&](const char* glob) {
    const std::vector<bool> all = taken(tree, with_globs({glob}));
    return std::pair<bool, bool>(all[2], all[3]);
  };
  EXPECT_EQ(last("LOD0/Leaves"), std::pair(true, false));
  EXPECT_EQ(last("lod1/leaves"), std::pair(false, true));
  EXPECT_EQ(last("LOD1/Leaf"), std::pair(false, true));  // Leaf is a material
  EXPECT_EQ(last("LOD1/*"), std::pair(false, true));
  EXPECT_EQ(last("Tree/LOD1/Leaves"), std::pair(false, true));
  EXPECT_EQ(last("Tree/Leaves"), std::pair(true, false));  // the finer of two levels
  EXPECT_EQ(last("Bush/Leaves"), std::pair(false, false));
  EXPECT_EQ(last("Leaves/LOD1"), std::pair(false, false));
}

TEST(Asked, AColourTakesTheNearerOfTwoClassesOrWhatLiesWithin) {
  using namespace test;
  const Primitive mesh = joined(coloured(trunk(), kBrown),
                                joined(coloured(ball({0, 4, 0}, 1), {0.7f, 0.02f, 0.02f}),
                                       coloured(ball({0, 6, 0}, 1), {0.75f, 0.05f, 0.03f})));
  const TreeModel tree = model_of({{mesh, {}}});
  LeafOptions options;
  options.colour = LeafColour{{219, 39, 39}};
  const std::size_t wood = trunk().triangles.size(), one = ball({}, 1).triangles.size();
  const auto count = [&] {
    const LeafChoice choice = choose_leaves(tree, options);
    return std::ranges::count(choice.triangles[0], true);
  };
  EXPECT_EQ(count(), static_cast<std::ptrdiff_t>(2 * one));
  options.colour->tolerance = 0.01;
  EXPECT_EQ(count(), static_cast<std::ptrdiff_t>(one));
  options.colour = LeafColour{{97, 69, 48}};
  EXPECT_EQ(count(), static_cast<std::ptrdiff_t>(wood));
  options.colour = LeafColour{{0, 0, 255}, 0.01};
  EXPECT_FALSE(choose_leaves(tree, options).any());
}

TEST(Asked, LongListOfNamesIsCut) {
  TreeModel tree = test::tree_of(std::vector<Primitive>(30, card(1, 1)));
  for (int i = 0; i < 30; ++i) tree.instances[i].node_name = "node" + std::to_string(100 + i);
  try {
    find_leaves(tree, with_globs({"acorn"}));
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_PRED2(contains, error.what(), "node118");
    EXPECT_FALSE(contains(error.what(), "node119"));
    EXPECT_PRED2(contains, error.what(), "and 11 more");
  }
}

TEST(Asked, EmptyTreeSaysSo) {
  TreeModel tree;
  tree.path = "empty.glb";
  try {
    find_leaves(tree, {});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_PRED2(contains, error.what(), "empty.glb holds no triangles");
  }
}

TEST(Asked, CandidatesAreOnePerPrimitiveAndNodeName) {
  TreeModel tree = tree_with("leaf", "crown", "left", AlphaMode::blend);
  tree.instances.push_back({2, "right"});
  tree.instances.push_back({2, "left"});
  const std::vector<LeafCandidate> candidates = choose_leaves(tree, {}).candidates;
  ASSERT_EQ(candidates.size(), 4u);
  const auto left = std::ranges::find(candidates, "left", &LeafCandidate::node);
  ASSERT_NE(left, candidates.end());
  EXPECT_EQ(left->mesh, "crown");
  EXPECT_EQ(left->material, "leaf");
  EXPECT_EQ(left->word, "leaf");
  EXPECT_EQ(left->alpha_mode, AlphaMode::blend);
  EXPECT_EQ(left->instances, 2u);
  EXPECT_EQ(left->vertices, 4u);
  EXPECT_EQ(left->triangles, 2u);
  EXPECT_NEAR(left->area, 2 * 16, 1e-9);
  EXPECT_EQ(left->verdict, LeafVerdict::leaves);
  EXPECT_EQ(candidates[0].verdict, LeafVerdict::leaves);  // the likeliest first
  EXPECT_EQ(candidates[3].verdict, LeafVerdict::other);
}

TEST(Asked, OptionsOutOfRangeAreUsageErrors) {
  const TreeModel tree = test::tree_of({card(1, 1)});
  const TextureEllipse flat{{0.5, 0.5}, {0.5, 0.5}, {1, 1}};
  const LeafOptions wrong[] = {with_scale(0), with_scale(-1), with_scale(NAN), with_scale(INFINITY),
                               with_ellipse(flat)};
  for (const LeafOptions& options : wrong) {
    try {
      find_leaves(tree, options);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
    }
  }
}

}  // namespace
}  // namespace leafhull
