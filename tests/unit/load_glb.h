// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <string>

namespace leafhull::test {

/// Reads a GLB; expects tinygltf to report no error and no warning.
inline tinygltf::Model load_glb(const std::string& bytes) {
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(
      &model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
      static_cast<unsigned>(bytes.size())))
      << error;
  EXPECT_EQ(error + warning, "");
  return model;
}

}  // namespace leafhull::test
