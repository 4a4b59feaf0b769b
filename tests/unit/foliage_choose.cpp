// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "foliage/rest.h"
#include "foliage_models.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

using namespace test;

const Material kBare{};

/// Which triangles of a tree with one primitive are taken as leaves.
std::vector<bool> taken_triangles(const TreeModel& tree) {
  const LeafChoice choice = choose_leaves(tree, {});
  if (!choice.triangles[0].empty()) return choice.triangles[0];
  return std::vector<bool>(tree.primitives[0].triangles.size(), choice.instances[0]);
}

/// `count` values: false for the first `first`, true for the rest.
std::vector<bool> last_ones(std::size_t first, std::size_t count) {
  std::vector<bool> triangles(count);
  std::fill(triangles.begin() + static_cast<std::ptrdiff_t>(first), triangles.end(), true);
  return triangles;
}

const std::vector<bool> kSecond{false, true};

TEST(Choice, NamesDecide) {
  EXPECT_EQ(taken(model_of({{trunk(), {.name = "Rinde"}}, {crown(), {.name = "Laub"}}})), kSecond);
  EXPECT_EQ(taken(model_of({{trunk(), kBare, "Stamm"}, {crown(), kBare, "Krone"}})), kSecond);
  EXPECT_EQ(taken(model_of({{trunk(), kBare, "", "ствол"}, {crown(), kBare, "", "листва"}})),
            kSecond);
  EXPECT_EQ(taken(model_of({{crown(), {.name = "bark"}}, {trunk(), {.name = "leaves"}}})), kSecond);
}

TEST(Choice, NamesOfParentsAndImagesCount) {
  TreeModel tree = model_of({{cards({0, 4, 0}, 1), kBare}, {cards({0, 3, 0}, 1), kBare}});
  tree.nodes.push_back({"Fence"});
  tree.nodes[0].parent = 2;
  EXPECT_EQ(taken(tree), kSecond);

  tree = model_of({{cards({0, 4, 0}, 1), kBare}, {cards({0, 3, 0}, 1), kBare}});
  tree.images = {alpha_image(2, [](double, double) { return 255; }), {}};
  tree.images[0].name = "textures/rock_03.png";
  tree.materials[0].base_color_image = 0;
  EXPECT_EQ(taken(tree), kSecond);
}

TEST(Choice, ANameThatAllShareTellsNothing) {
  const TreeModel tree = model_of({{trunk(), painted("mat1", kBrown), "tree_with_leaves"},
                                   {crown(), painted("mat2", kGreen), "tree_with_leaves"}});
  EXPECT_EQ(taken(tree), kSecond);
  // By name alone the grey boards would be leaves.
  EXPECT_EQ(taken(model_of({{cards({0, 1, 0}, 1), painted("mat1", {0.2f, 0.2f, 0.2f}), "leaves"},
                            {crown(), painted("mat2", kGreen), "leaves"}})),
            kSecond);
}

TEST(Choice, HolesDecideWhereTheTrianglesUseThem) {
  // The left half of the image is opaque, the right half shows a leaf.
  const Image image = alpha_image(64, [](double u, double v) {
    return u < 0.5 ? 255 : opaque_inside(0.75, 0.5, 0.2, 0.4)(u, v);
  });
  const auto moved = [](Primitive primitive, float from) {
    for (Vec2f& uv : primitive.uvs) uv.x = from + uv.x / 2;
    return primitive;
  };
  for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
    Material material{.name = "atlas", .alpha_mode = mode, .base_color_image = 0};
    TreeModel tree = model_of({{moved(cards({0, 1, 0}, 0.3f), 0), material},
                               {moved(cards({0, 4, 0}, 1), 0.5f), material}});
    tree.images.push_back(image);
    EXPECT_EQ(taken(tree), kSecond);
  }
}

TEST(Choice, AlphaModeWithoutHolesProvesNothing) {
  Material bark = painted("a", kBrown), leaves = painted("b", kGreen);
  bark.alpha_mode = AlphaMode::blend;
  EXPECT_EQ(taken(model_of({{trunk(), bark}, {crown(), leaves}})), kSecond);
  leaves.alpha_mode = AlphaMode::mask;
  EXPECT_EQ(taken(model_of({{trunk(), bark}, {crown(), leaves}})), kSecond);
}

TEST(Choice, HolesInAnOpaqueMaterialAreCutOut) {
  TreeModel tree = model_of({{trunk(), painted("wood", kBrown)},
                             {cards({0, 4, 0}, 1), {.name = "Acacia01", .base_color_image = 0}}});
  tree.images.push_back(alpha_image(64, opaque_inside(0.5, 0.5, 0.1, 0.4)));
  const LeafChoice choice = choose_leaves(tree, {});
  EXPECT_EQ(choice.instances, kSecond);
  EXPECT_EQ(choice.cut_out, kSecond);
  ASSERT_EQ(choice.warnings.size(), 1u);
  EXPECT_PRED2(contains, choice.warnings[0], "'Acacia01' says it is opaque");
  const LeafSet leaves = find_leaves(tree, {});
  EXPECT_NEAR(leaves.vertices[0].radius_major / leaves.vertices[0].radius_minor, 4, 0.2);
}

TEST(Choice, ColoursDecideBetweenNamesThatSayNothing) {
  EXPECT_EQ(
      taken(model_of({{trunk(), painted("mat1", kBrown)}, {crown(), painted("mat2", kGreen)}})),
      kSecond);
  // An autumn tree with a birch's bark.
  EXPECT_EQ(taken(model_of({{trunk(), painted("mat1", {0.6f, 0.6f, 0.55f})},
                            {crown(), painted("mat2", {0.7f, 0.35f, 0.02f})}})),
            kSecond);
}

TEST(Choice, ShapeDecidesWhereNothingElseDoes) {
  EXPECT_EQ(taken(model_of({{trunk(), kBare}, {crown(), kBare}})), kSecond);
  EXPECT_EQ(taken(model_of({{trunk(), kBare}, {cards({0, 4, 0}, 1), kBare}})), kSecond);
}

TEST(Choice, OnePaletteForTheWholeTreeIsToldByColour) {
  Primitive tree_mesh = joined(swatch(trunk(), {0.25f, 0.5f}), swatch(crown(), {0.75f, 0.5f}));
  const std::size_t wood = trunk().triangles.size(), count = tree_mesh.triangles.size();
  TreeModel tree = model_of({{tree_mesh, {.name = "colormap", .base_color_image = 0}}});
  tree.images.push_back({2, 1, {120, 80, 50, 255, 80, 150, 60, 255}});
  EXPECT_EQ(taken_triangles(tree), last_ones(wood, count));
  const LeafChoice choice = choose_leaves(tree, {});
  EXPECT_EQ(choice.candidates[0].colour, "#50963c");
  EXPECT_TRUE(choice.candidates[0].is_part);
  EXPECT_PRED2(contains, choice.told, "leaves: colormap #50963c (colour");
  EXPECT_PRED2(contains, choice.told, "passed over: colormap #785032");
  EXPECT_GT(find_leaves(tree, {}).bounds.low.y, 2);
}

TEST(Choice, GroundOfTheCrownsColourIsNoCrown) {
  Primitive mesh = joined(joined(trunk(), crown()), ground(4));
  mesh.colors.assign(mesh.positions.size(), kGreen);
  std::fill_n(mesh.colors.begin(), trunk().positions.size(), kBrown);
  const TreeModel tree = model_of({{mesh, kBare}});
  std::vector<bool> expected = last_ones(trunk().triangles.size(), mesh.triangles.size());
  expected[expected.size() - 1] = expected[expected.size() - 2] = false;
  EXPECT_EQ(taken_triangles(tree), expected);
}

TEST(Choice, VertexColoursTellOnePieceByTriangle) {
  // A trunk that runs into its crown in one piece.
  Primitive mesh = ball({0, 4, 0}, 1.5f);
  mesh.colors.clear();
  for (const Vec3f p : mesh.positions) mesh.colors.push_back(p.y < 3 ? kBrown : kGreen);
  const TreeModel tree = model_of({{mesh, kBare}});
  const std::vector<bool> leaves = taken_triangles(tree);
  for (std::size_t t = 0; t < leaves.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const float low = std::min({mesh.positions[a].y, mesh.positions[b].y, mesh.positions[c].y});
    const float high = std::max({mesh.positions[a].y, mesh.positions[b].y, mesh.positions[c].y});
    if (low > 3) {
      EXPECT_TRUE(leaves[t]);
    }
    if (high < 3) {
      EXPECT_FALSE(leaves[t]);
    }
  }
}

TEST(Choice, OneColourForTheWholeTreeIsToldByShape) {
  const Primitive mesh = joined(trunk(), crown());
  const TreeModel tree = model_of({{mesh, {.name = "DefaultMaterial"}}});
  EXPECT_EQ(taken_triangles(tree), last_ones(trunk().triangles.size(), mesh.triangles.size()));
}

TEST(Choice, WhatIsCalledLeavesIsNotCut) {
  const Primitive mesh = joined(cards({0, 4, 0}, 1), trunk());
  const LeafChoice choice = choose_leaves(model_of({{mesh, {.name = "Leaves"}}}), {});
  EXPECT_TRUE(choice.triangles[0].empty());
  EXPECT_TRUE(choice.instances[0]);
}

TEST(Choice, GrassIsPassedOverWhereThereIsATree) {
  TreeModel tree = model_of({{crown(), {.name = "Leaf"}},
                             {cards({0, 0.1f, 0}, 0.1f), {.name = "Grass"}},
                             {ground(9), painted("mat", kGreen)}});
  EXPECT_EQ(taken(tree), (std::vector<bool>{true, false, false}));
  EXPECT_PRED2(contains, choose_leaves(tree, {}).told, "Grass (undergrowth)");
  tree.instances.erase(tree.instances.begin());
  EXPECT_EQ(taken(tree), (std::vector<bool>{true, false}));
  // Without names, the undergrowth shows by its place.
  tree = model_of({{trunk(), painted("a", kBrown)},
                   {crown(), painted("b", kGreen)},
                   {cards({0, 0.1f, 0}, 0.1f), painted("c", kGreen)}});
  EXPECT_EQ(taken(tree), (std::vector<bool>{false, true, false}));
}

TEST(Choice, FruitIsPassedOver) {
  Primitive fruit = ball({1, 4, 1}, 0.15f);
  for (int i = 0; i < 6; ++i) {
    fruit = joined(fruit, ball({-1, 3.5f + 0.2f * static_cast<float>(i), 1}, 0.15f));
  }
  EXPECT_EQ(taken(model_of(
                {{crown(), painted("a", kGreen)}, {fruit, painted("b", {0.7f, 0.02f, 0.02f})}})),
            (std::vector<bool>{true, false}));
}

TEST(Choice, OfLevelsOfDetailTheFinestIsTaken) {
  const auto thing = [](const char* mesh, const char* node) {
    return Thing{cards({0, 4, 0}, 1), {.name = "Leaf"}, mesh, node};
  };
  const std::vector<bool> first{true, false, false};
  const auto of = [&](std::array<const char*, 3> meshes, std::array<const char*, 3> nodes) {
    return model_of(
        {thing(meshes[0], nodes[0]), thing(meshes[1], nodes[1]), thing(meshes[2], nodes[2])});
  };
  EXPECT_EQ(taken(of({"", "", ""}, {"Oak_LOD0", "Oak_LOD1", "Oak_LOD2"})), first);
  EXPECT_EQ(taken(of({"oak_lod1", "oak_lod2", "oak_lod3"}, {"a", "b", "c"})), first);
  EXPECT_EQ(taken(of({"", "", ""}, {"oak", "oak_lod1", "oak_lod2"})), first);
  EXPECT_EQ(taken(of({"", "", ""}, {"OakLOD0", "PineLOD0", "LodgePole"})),
            std::vector<bool>(3, true));
  EXPECT_PRED2(contains,
               choose_leaves(of({"", "", ""}, {"Oak_LOD0", "Oak_LOD1", "Oak_LOD2"}), {}).told,
               "of several levels of detail: Oak_LOD0");

  TreeModel tree = of({"", "", ""}, {"crown", "crown", "crown"});  // below LOD0, LOD1, LOD2
  for (int level = 0; level < 3; ++level) {
    tree.nodes[level].parent = static_cast<int>(tree.nodes.size());
    tree.nodes.push_back({"LOD" + std::to_string(level)});
  }
  EXPECT_EQ(taken(tree), first);

  tree = of({"", "", ""}, {"oak", "far", "farther"});
  tree.nodes[1].level = 1;  // as MSFT_lod lists them
  tree.nodes[2].level = 2;
  EXPECT_EQ(taken(tree), first);
}

TEST(Choice, ABillboardStandsForATree) {
  const Thing tree{cards({0, 4, 0}, 1), {.name = "Leaf"}, "", "Oak"};
  const Thing board{card(3, 6), {.name = "Leaf"}, "", "Oak_Billboard"};
  EXPECT_EQ(taken(model_of({tree, board})), (std::vector<bool>{true, false}));
  EXPECT_EQ(taken(model_of({board})), std::vector<bool>{true});
  const Thing cards_of_leaves{cards({0, 4, 0}, 1), {.name = "Leaf"}, "", "leaf_billboards"};
  EXPECT_EQ(taken(model_of({{trunk(), painted("wood", kBrown)}, cards_of_leaves})), kSecond);
}

TEST(Choice, ADoubtfulOneSaysSoAndNamesTheSecond) {
  // Both are as grey as stone, and one is a little likelier.
  const TreeModel tree = model_of(
      {{trunk(), painted("a", {0.2f, 0.2f, 0.2f})}, {crown(), painted("b", {0.2f, 0.2f, 0.2f})}});
  const LeafChoice choice = choose_leaves(tree, {});
  EXPECT_EQ(choice.instances, kSecond);
  ASSERT_EQ(choice.warnings.size(), 1u);
  EXPECT_PRED2(contains, choice.warnings[0], "is a guess: b");
  EXPECT_PRED2(contains, choice.warnings[0], "--leaves 'a'");
}

TEST(Choice, SureOnesWarnOfNothing) {
  const TreeModel tree =
      model_of({{trunk(), painted("Wood", kBrown)}, {crown(), painted("Green", kGreen)}});
  EXPECT_TRUE(choose_leaves(tree, {}).warnings.empty());
}

TEST(Choice, ADeadTreeHasNone) {
  const TreeModel tree = model_of({{trunk(), painted("Bark", kBrown), "DeadTree"}});
  const LeafChoice choice = choose_leaves(tree, {});
  EXPECT_FALSE(choice.any());
  EXPECT_EQ(choice.options, std::vector<std::string>{"--leaves 'Bark'"});
  try {
    find_leaves(tree, {});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_PRED2(contains, error.what(), "no leaves in oak.glb");
    EXPECT_PRED2(contains, error.what(), "materials Bark; meshes DeadTree");
    EXPECT_PRED2(contains, error.remedy(), "--leaves 'Bark'");
  }
}

TEST(Choice, DoesNotDependOnTheOrderOfThings) {
  const std::vector<Thing> things{{trunk(), painted("a", kBrown)},
                                  {crown(), painted("b", kGreen)},
                                  {ground(5), painted("c", kGreen)},
                                  {cards({0, 4, 0}, 2), painted("d", kGreen)}};
  std::vector<int> order{0, 1, 2, 3};
  do {
    std::vector<Thing> turned;
    for (const int i : order) turned.push_back(things[static_cast<std::size_t>(i)]);
    const LeafChoice choice = choose_leaves(model_of(turned), {});
    for (std::size_t i = 0; i < order.size(); ++i) {
      EXPECT_EQ(choice.instances[i], order[i] == 1 || order[i] == 3);
    }
  } while (std::ranges::next_permutation(order).found);
}

TEST(Rest, IsWhatIsNoLeafOfTheFinestLevel) {
  const Primitive mesh = joined(trunk(), crown());
  TreeModel tree = model_of({{mesh, {.name = "DefaultMaterial"}, "", "Oak_LOD0"},
                             {mesh, {.name = "DefaultMaterial"}, "", "Oak_LOD1"},
                             {ground(5), {.name = "ground"}, "", "Ground"}});
  const LeafChoice choice = choose_leaves(tree, {});
  const TreePart rest = rest_of(std::make_shared<const TreeModel>(tree), choice);
  ASSERT_EQ(rest.instances.size(), 2u);
  const Primitive& wood = rest.model->primitives[rest.instances[0].primitive];
  EXPECT_EQ(wood.triangles.size(), trunk().triangles.size());
  EXPECT_EQ(rest.instances[1].node_name, "Ground");
}

}  // namespace
}  // namespace leafhull
