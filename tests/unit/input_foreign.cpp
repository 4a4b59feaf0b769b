// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "input/foreign.h"
#include "leafhull/error.h"
#include "leafhull/tree.h"
#include "temporary_folder.h"

namespace leafhull::test {
namespace {

std::string remedy_of(const std::string& name, const std::string& content = "what") {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(content.data());
  const auto format = foreign_format({bytes, content.size()}, name);
  return format ? format->remedy : "";
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Foreign, FormatsAreConvertedByOneCommand) {
  EXPECT_EQ(remedy_of("art/oak.blend"),
            "Convert it: blender -b 'art/oak.blend' --python-expr \"import bpy; "
            "bpy.ops.export_scene.gltf(filepath='oak.glb')\"");
  EXPECT_TRUE(holds(remedy_of("oak.usdz"), "bpy.ops.wm.usd_import(filepath='oak.usdz')"));
  EXPECT_TRUE(holds(remedy_of("oak.DAE"), "bpy.ops.wm.collada_import(filepath='oak.DAE')"));
  EXPECT_TRUE(holds(remedy_of("oak.abc"), "bpy.ops.wm.alembic_import"));
  EXPECT_TRUE(holds(remedy_of("oak.spm"), "SpeedTree's Modeler as FBX"));
  EXPECT_TRUE(holds(remedy_of("oak.zip"), "Unpack"));
}

TEST(Foreign, FormatsAreToldByTheirBytesToo) {
  EXPECT_TRUE(holds(remedy_of("oak", "BLENDER-v300"), "blender -b 'oak'"));
  EXPECT_TRUE(holds(remedy_of("oak.bin", "PXR-USDC"), "usd_import"));
  EXPECT_EQ(remedy_of("oak.txt"), "");
  EXPECT_EQ(remedy_of("oak", ""), "");
}

TEST(Foreign, NamesDoNotBreakTheCommand) {
  for (const char* name :
       {"o'ak.blend", "o\"ak.blend", "$(oak).blend", "`oak`.blend", "o\\ak.blend"}) {
    EXPECT_TRUE(holds(remedy_of(name), "blender -b 'FILE'")) << name;
  }
}

TEST(Foreign, FilesAreRefusedWithTheNextStep) {
  const TemporaryFolder folder;
  std::ofstream(folder / "oak.blend") << "BLENDER-v300";
  try {
    read_tree(folder / "oak.blend");
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_TRUE(holds(error.what(), "oak.blend: is a Blender file, which is not read"));
    EXPECT_TRUE(holds(error.remedy(), "blender -b"));
  }
}

}  // namespace
}  // namespace leafhull::test
