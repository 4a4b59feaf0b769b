// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "foliage/kinds.h"
#include "foliage_models.h"

namespace leafhull {
namespace {

using namespace test;

TEST(Kinds, AreReadFromNames) {
  for (const char* name : {"Pine_5", "scots-pine", "fir tree", "NorwaySpruce", "Christmas_Tree",
                           "Fichte", "Tannennadeln", "сосна", "ель", "松树", "PineNeedles"}) {
    EXPECT_EQ(read_kind(name), LeafKind::needle) << name;
  }
  for (const char* name : {"palm_tree_2", "Palmera", "Frond.001", "CoconutTree", "пальма"}) {
    EXPECT_EQ(read_kind(name), LeafKind::frond) << name;
  }
  for (const char* name :
       {"oak", "BirchTree", "pineapple", "acer_palmatum", "pin_oak", "evergreen oak"}) {
    EXPECT_EQ(read_kind(name), LeafKind::broad) << name;
  }
  for (const char* name :
       {"leaves", "fire", "first", "spinner", "firm", "model", "мелкие", "Cam.001", ""}) {
    EXPECT_EQ(read_kind(name), std::nullopt) << name;
  }
}

LeafKind kind(const TreeModel& tree) { return choose_leaves(tree, {}).kind; }

TEST(Kinds, AreThoseOfMostOfTheLeaves) {
  const Material leaves{.name = "leaves"};
  TreeModel tree = model_of({{trunk(), {.name = "pine bark"}}, {crown(), leaves}});
  EXPECT_EQ(kind(tree), LeafKind::broad) << "the bark's name does not count";
  tree.path = "models/pine.glb";
  EXPECT_EQ(kind(tree), LeafKind::needle);
  tree.nodes.push_back({"Palm_03"});
  tree.nodes[1].parent = 2;
  EXPECT_EQ(kind(tree), LeafKind::frond) << "a node's name says more than the file's";
  tree = model_of(
      {{cards({0, 4, 0}, 1, 100), leaves, "palm"}, {cards({0, 4, 0}, 2, 300), leaves, "larch"}});
  EXPECT_EQ(kind(tree), LeafKind::needle);
}

}  // namespace
}  // namespace leafhull
