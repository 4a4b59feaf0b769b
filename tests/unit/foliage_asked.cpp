// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "leafhull/error.h"
#include "leaves_models.h"

namespace leafhull {
namespace {

using test::card;
using test::with_ellipse;
using test::with_globs;
using test::with_scale;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A tree of trunk, twig and crown, with the crown's names given.
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

/// Whether each row of the summary is taken.
std::vector<bool> taken(const TreeModel& tree, const LeafOptions& options = {}) {
  std::vector<bool> taken;
  for (const PrimitiveSummary& row : summarize(tree, options)) taken.push_back(row.leaves);
  return taken;
}

const std::vector<bool> kCrownOnly{false, false, true};

TEST(LeafSelection, UsualNamesDecideWhateverTheirCase) {
  EXPECT_EQ(taken(tree_with("Oak_Leaf", "crown", "a")), kCrownOnly);
  EXPECT_EQ(taken(tree_with("green", "LEAVES.001", "a")), kCrownOnly);
  EXPECT_EQ(taken(tree_with("green", "crown", "my foliage")), kCrownOnly);
  EXPECT_EQ(taken(tree_with("green", "Needles", "a")), kCrownOnly);
  EXPECT_EQ(taken(tree_with("green", "crown", "a")), std::vector<bool>(3, false));
}

TEST(LeafSelection, AlphaModeDecides) {
  EXPECT_EQ(taken(tree_with("green", "crown", "a", AlphaMode::mask)), kCrownOnly);
  EXPECT_EQ(taken(tree_with("green", "crown", "a", AlphaMode::blend)), kCrownOnly);
}

TEST(LeafSelection, GlobsReplaceTheDefaultRule) {
  const TreeModel tree = tree_with("Leaf", "crown", "a", AlphaMode::mask);
  EXPECT_EQ(taken(tree, with_globs({"TW?G"})), (std::vector<bool>{false, true, false}));
  EXPECT_EQ(taken(tree, with_globs({"t[vw]ig", "cr*"})), (std::vector<bool>{false, true, true}));
  EXPECT_EQ(taken(tree, with_globs({"row"})), std::vector<bool>(3, false));
}

TEST(LeafSelection, FindLeavesTakesWhatIsSelected) {
  const TreeModel tree = tree_with("leaf", "crown", "a");
  EXPECT_DOUBLE_EQ(find_leaves(tree, {}).bounds.size().x, 4);
  EXPECT_DOUBLE_EQ(find_leaves(tree, with_globs({"twig"})).bounds.size().x, 2);
}

TEST(LeafSelection, GlobThatMatchesNothingIsNamed) {
  const LeafSet leaves =
      find_leaves(tree_with("leaf", "crown", "a"), with_globs({"crown", "acorn*"}));
  ASSERT_EQ(leaves.warnings.size(), 1u);
  EXPECT_PRED2(contains, leaves.warnings[0], "acorn*");
}

TEST(LeafSelection, ControlCharactersOfNamesAreNotPrinted) {
  try {
    find_leaves(tree_with("a\x1b[31mb\nc", "crown", "top"), {});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_PRED2(contains, error.what(), "a?[31mb?c");
  }
}

TEST(LeafSelection, NoLeavesNamesWhatThereIs) {
  const TreeModel tree = tree_with("green", "crown", "top");
  try {
    find_leaves(tree, {});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_PRED2(contains, error.what(), "oak.glb");
    EXPECT_PRED2(contains, error.what(),
                 "materials bark, green; meshes crown, trunk, twig; "
                 "nodes node, top");
    EXPECT_PRED2(contains, error.remedy(), "--leaves");
  }
  EXPECT_THROW(find_leaves(tree, with_globs({"acorn"})), Error);
}

TEST(LeafSelection, LongListOfNamesIsCut) {
  TreeModel tree = test::tree_of(std::vector<Primitive>(30, card(1, 1)));
  tree.materials[0].name = "bark";
  for (int i = 0; i < 30; ++i) tree.instances[i].node_name = "node" + std::to_string(100 + i);
  try {
    find_leaves(tree, {});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_PRED2(contains, error.what(), "node118");
    EXPECT_FALSE(contains(error.what(), "node119"));
    EXPECT_PRED2(contains, error.what(), "and 11 more");
  }
}

TEST(LeafSelection, EmptyTreeSaysSo) {
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

TEST(LeafSelection, SummaryHasOneRowPerPrimitiveAndNodeName) {
  TreeModel tree = tree_with("leaf", "crown", "left", AlphaMode::blend);
  tree.instances.push_back({2, "right"});
  tree.instances.push_back({2, "left"});
  const std::vector<PrimitiveSummary> rows = summarize(tree, {});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].mesh, "trunk");
  EXPECT_EQ(rows[0].material, "bark");
  EXPECT_EQ(rows[0].alpha_mode, AlphaMode::opaque);
  EXPECT_FALSE(rows[0].leaves);
  EXPECT_EQ(rows[2].node, "left");
  EXPECT_EQ(rows[2].instances, 2u);
  EXPECT_EQ(rows[2].alpha_mode, AlphaMode::blend);
  EXPECT_EQ(rows[2].vertices, 4u);
  EXPECT_EQ(rows[2].triangles, 2u);
  EXPECT_TRUE(rows[2].leaves);
  EXPECT_EQ(rows[3].node, "right");
  EXPECT_EQ(rows[3].instances, 1u);
}

TEST(LeafSelection, OptionsOutOfRangeAreUsageErrors) {
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
