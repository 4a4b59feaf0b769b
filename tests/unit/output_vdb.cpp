// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <openvdb/io/File.h>

#include "leafhull/output.h"
#include "output/vdb.h"
#include "output/writers.h"
#include "output_sample.h"
#include "surface/density_grid.h"

namespace leafhull::test {
namespace {

TEST(Vdb, IsOpenedAgainByOpenVdb) {
  const TemporaryFolder folder;
  const Shape shape = sample_shape();
  write_outputs(
      plan_outputs({.shapes = {folder / "shape.vdb"}, .field = folder / "field.vdb"}, "tree.glb"),
      shape, {});
  EXPECT_EQ(read_file(folder / "shape.vdb"), read_file(folder / "field.vdb"));

  openvdb::initialize();
  openvdb::io::File file(folder / "field.vdb");
  file.open();
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("density"));
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->metaValue<double>("threshold"), 1.7);
  EXPECT_EQ(grid->transform().voxelSize(), openvdb::Vec3d(0.25));
  EXPECT_EQ(grid->background(), 0);
  EXPECT_EQ(grid->activeVoxelCount(), 3u);
  EXPECT_EQ(grid->tree().getValue({0, 0, 0}), 0.5f);
  EXPECT_EQ(grid->tree().getValue({1, 0, -9}), 1.25f);
  EXPECT_EQ(grid->tree().getValue({100, 20, 3}), 3.0f);
}

std::string bytes_of(const openvdb::FloatGrid::ConstPtr& grid) {
  return written([&](std::ostream& stream) { write_vdb(grid, stream); });
}

TEST(Vdb, HasTheSameBytesForTheSameGridOnly) {
  const Shape shape = sample_shape();
  const openvdb::FloatGrid::Ptr grid = density_grid(*shape.field);
  const std::string first = bytes_of(grid);
  EXPECT_EQ(bytes_of(density_grid(*shape.field)), first);
  EXPECT_EQ(first[20], 1) << "no grid offsets: readers cannot load lazily";

  const auto uuid = [](const std::string& bytes) { return bytes.substr(21, 36); };
  grid->tree().setValue({0, 0, 0}, 0.75f);
  const std::string other = bytes_of(grid);
  EXPECT_NE(uuid(other), uuid(first));
  for (const std::string& bytes : {first, other}) {
    EXPECT_EQ(uuid(bytes).find_first_not_of("0123456789abcdef-"), std::string::npos);
    EXPECT_EQ(uuid(bytes)[14], '8');
    EXPECT_NE(std::string("89ab").find(uuid(bytes)[19]), std::string::npos);
  }
}

}  // namespace
}  // namespace leafhull::test
