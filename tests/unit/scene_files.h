// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "glb_builder.h"
#include "leafhull/error.h"
#include "leafhull/scene.h"
#include "temporary_folder.h"

namespace leafhull::test {

/// Unit squares as leaves, in a row along x with gaps as wide.
inline GlbPrimitive leaves_in_a_row(int count, int material) {
  GlbPrimitive row;
  row.material = material;
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<float>(2 * i);
    const auto first = static_cast<std::uint32_t>(row.positions.size());
    row.positions.insert(row.positions.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}});
    row.normals.insert(row.normals.end(), 4, Vec3f(0, 0, 1));
    row.indices.insert(row.indices.end(),
                       {first, first + 1, first + 2, first, first + 2, first + 3});
  }
  return row;
}

/// A folder for scenes and trees.
class SceneFolder : public TemporaryFolder {
 public:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = *this / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  std::filesystem::path write(const std::string& name, const Bytes& bytes) const {
    return write(name, std::string(bytes.begin(), bytes.end()));
  }

  std::filesystem::path tree(const std::string& name, int leaves = 8) const {
    GlbBuilder builder;
    const int material = builder.add_material("leaf", "MASK");
    builder.add_node("tree", builder.add_mesh("crown", {leaves_in_a_row(leaves, material)}));
    return write(name, builder.glb());
  }

  std::string read(const std::string& name) const {
    std::ifstream stream(*this / name, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }
};

/// Expects reading to throw Error input with this message, apart from the folder's path.
inline void expect_refused(const SceneFolder& folder, const std::filesystem::path& file,
                           const std::string& message) {
  try {
    read_scene(file, {});
    ADD_FAILURE() << "expected: " << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    std::string what = error.what();
    const std::string path = folder.path().string() + '/';
    for (std::size_t at; (at = what.find(path)) != std::string::npos;) what.erase(at, path.size());
    EXPECT_EQ(what, message);
    EXPECT_FALSE(error.remedy().empty());
  }
}

/// Where the tree puts a point of its model.
inline Vec3d moved(const PlacedTree& tree, Vec3d p) {
  const auto& l = tree.linear;
  return tree.position + Vec3d(l[0] * p.x + l[1] * p.y + l[2] * p.z,
                               l[3] * p.x + l[4] * p.y + l[5] * p.z,
                               l[6] * p.x + l[7] * p.y + l[8] * p.z);
}

inline void expect_near(Vec3d a, Vec3d b) {
  EXPECT_LT(length(a - b), 1e-6) << a.x << ' ' << a.y << ' ' << a.z;
}

}  // namespace leafhull::test
