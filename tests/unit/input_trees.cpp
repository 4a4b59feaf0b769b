// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "leafhull/tree.h"

namespace leafhull::test {
namespace {

struct Counted {
  const char* file;
  std::size_t leaf_vertices, leaf_triangles;
};

const Primitive& leaves_of(const TreeModel& tree) {
  for (const Primitive& primitive : tree.primitives)
    if (primitive.mesh_name == "leaves") return primitive;
  throw std::runtime_error("no mesh called leaves");
}

TEST(Trees, TheExampleHasMaskedCards) {
  const TreeModel tree = read_tree(std::filesystem::path(LEAFHULL_EXAMPLES) / "ash.glb");
  const Primitive& leaves = leaves_of(tree);
  EXPECT_EQ(leaves.positions.size(), 21760u);
  EXPECT_EQ(leaves.uvs.size(), 21760u);
  EXPECT_EQ(leaves.normals.size(), 21760u);
  const Material& material = tree.materials[std::size_t(leaves.material)];
  EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
  const Image& image = tree.images.at(std::size_t(material.base_color_image));
  EXPECT_EQ(image.rgba.size(), std::size_t(image.width) * std::size_t(image.height) * 4);
  EXPECT_FALSE(image.empty());
  EXPECT_TRUE(tree.warnings.empty());
}

TEST(Trees, SharedTreesAreReadWhole) {
  const std::filesystem::path folder = LEAFHULL_SHARED_TREES;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "SKIPPED: no shared trees at " << folder;
  for (const auto& [file, vertices, triangles] :
       {Counted{"ash.glb", 21760, 10880}, Counted{"aspen-52648.glb", 52648, 26324},
        Counted{"birch.glb", 75668, 37836}, Counted{"bush.glb", 9984, 4992},
        Counted{"callistemon.glb", 38346, 19176}}) {
    SCOPED_TRACE(file);
    const TreeModel tree = read_tree(folder / file);
    EXPECT_EQ(tree.primitives.size(), 2u);
    EXPECT_EQ(tree.instances.size(), 2u);
    EXPECT_EQ(leaves_of(tree).positions.size(), vertices);
    EXPECT_EQ(leaves_of(tree).triangles.size(), triangles);
  }
}

}  // namespace
}  // namespace leafhull::test
