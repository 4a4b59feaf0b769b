// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "foliage/names.h"

namespace leafhull {
namespace {

Growth growth_of(std::string_view name) { return read_name(name).growth; }
double weight_of(std::string_view name) { return read_name(name).weight; }

TEST(Names, AreFoldedToPlainWords) {
  EXPECT_EQ(folded("Oak_Leaf.001"), "oak leaf 001");
  EXPECT_EQ(folded("treeLODLeaves2"), "tree lodleaves 2");
  EXPECT_EQ(folded("  __Bark  "), "bark ");
  EXPECT_EQ(folded("BLÄTTER Écorce ŁÓDŹ"), "blatter ecorce lodz");
  EXPECT_EQ(folded("Bla\xCC\x88tter"), "blatter");  // a, then a combining diaeresis
  EXPECT_EQ(folded("ЛИСТ Ёлка"), "лист елка");
  EXPECT_EQ(folded("Φύλλα"), "φυλλα");
  EXPECT_EQ(folded("樹冠"), "樹冠");
  EXPECT_EQ(folded(""), "");
}

TEST(Names, KeepBytesThatAreNotUtf8) {
  EXPECT_EQ(growth_of("leaf\xFF\xC3"), Growth::leaves);
  EXPECT_EQ(growth_of("\xE6\x9E leaf"), Growth::leaves);
}

TEST(Names, TellLeavesInManyLanguages) {
  for (const char* name :
       {"Oak_Leaf",   "LEAVES.001",    "my foliage", "Needles", "Crown",        "Treetop_1",
        "tree_top",   "CherryBlossom", "Blätter",    "Laub",    "Tannennadeln", "Baumkrone",
        "feuilles",   "Hoja_Mat",      "follaje",    "Folhas",  "foglie",       "liście",
        "yaprak",     "Листья",        "Хвоя",       "крона",   "φύλλα",        "叶子",
        "葉",         "樹冠",          "はっぱ",     "나뭇잎",  "leafsGreen",   "Folliage",
        "Foilage.006"}) {
    EXPECT_EQ(growth_of(name), Growth::leaves) << name;
    EXPECT_GE(weight_of(name), 0.5) << name;
  }
}

TEST(Names, TellWhatIsNoLeaf) {
  for (const char* name :
       {"bark", "TreeTrunk", "wood", "Branch_2", "Rinde", "Stamm", "Holz", "écorce", "tronc",
        "corteza", "tronco", "Corteccia", "кора", "ствол", "树皮", "幹", "枝"}) {
    EXPECT_EQ(growth_of(name), Growth::wood) << name;
    EXPECT_LE(weight_of(name), -0.5) << name;
  }
  for (const char* name : {"Ground", "rock_03", "Water", "flowerpot", "pot", "Fence", "cobweb",
                           "Boden", "石", "вода", "UCX_Tree_00", "coconut"}) {
    EXPECT_EQ(growth_of(name), Growth::other) << name;
    EXPECT_LT(weight_of(name), 0) << name;
  }
}

TEST(Names, SayNothingWhereTheyDoNot) {
  for (const char* name :
       {"", "Material.001", "mat1", "Oak", "tree", "Cylinder", "Nadelbaum", "Laubbaum", "Redwood",
        "apple tree", "Spotlight", "Rooted", "Plastic", "Lovely", "Depot", "compost", "Contrast"}) {
    EXPECT_EQ(weight_of(name), 0) << name << ": " << read_name(name).word;
  }
}

TEST(Names, TheLastWordDecides) {
  EXPECT_EQ(growth_of("BranchLeaves"), Growth::leaves);
  EXPECT_EQ(growth_of("Leaf_Stem"), Growth::wood);
  EXPECT_EQ(growth_of("Rinde_Leaf"), Growth::leaves);
  EXPECT_EQ(growth_of("Leafless_trunk"), Growth::wood);
  // Contradicting words weigh less.
  EXPECT_LT(weight_of("BranchLeaves"), weight_of("Leaves"));
}

TEST(Names, ColoursHint) {
  EXPECT_EQ(growth_of("DarkGreen"), Growth::leaves);
  EXPECT_EQ(growth_of("Brown"), Growth::wood);
  EXPECT_EQ(weight_of("Green"), 0.5);
  EXPECT_EQ(growth_of("green_bark"), Growth::wood);
  EXPECT_EQ(growth_of("bark_green"), Growth::wood);
}

TEST(Names, GrassIsUndergrowth) {
  EXPECT_EQ(growth_of("Grass_01"), Growth::undergrowth);
  EXPECT_EQ(growth_of("трава"), Growth::undergrowth);
}

}  // namespace
}  // namespace leafhull
