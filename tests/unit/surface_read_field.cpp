// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "density/field_grid.h"
#include "leafhull/error.h"
#include "surface/brick_mesher.h"
#include "surface/density_grid.h"
#include "surface/polygonise.h"
#include "surface/read_field.h"
#include "surface_test_fields.h"
#include "temporary_folder.h"

namespace leafhull {
namespace {

constexpr double kThreshold = 2;

/// A ball of radius 10; N falls by one per voxel.
double ball_of_10(Vec3d p) {
  const Vec3d centre{12, 12, 12};
  return std::max(0.0, kThreshold + 10 - length(p - centre));
}

class FieldFiles : public testing::Test {
 protected:
  std::filesystem::path write(const openvdb::GridCPtrVec& grids) {
    openvdb::initialize();
    openvdb::io::File(file_.string()).write(grids);
    return file_;
  }

  void expect_error(ErrorCode code, const std::string& part, std::optional<double> threshold = {}) {
    try {
      read_field(file_, threshold);
      ADD_FAILURE() << "no error with " << part;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(error.code(), code) << message;
      EXPECT_NE(message.find(part), std::string::npos) << message << " lacks " << part;
      EXPECT_NE(message.find(file_.string()), std::string::npos) << message;
      EXPECT_FALSE(error.remedy().empty());
    }
  }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "field.vdb";
};

/// A field with a lattice far from zero, bricks and a block proven inside.
Field sample() {
  Field field({0.25, {-64, 3200, 32}}, kThreshold);
  for (int x = 0; x < 24; x += kBrickEdge) {
    for (int y = 0; y < 24; y += kBrickEdge) {
      for (int z = 0; z < 24; z += kBrickEdge) {
        if (x == 8 && y == 8 && z == 8) continue;
        add_brick(field, ball_of_10, {x, y, z});
      }
    }
  }
  field.add_inside(std::vector<InsideBlock>{{{{8, 8, 8}, kBrickEdge}, kThreshold}});
  return field;
}

TEST_F(FieldFiles, GiveTheSameSurfaceAgain) {
  const Field field = sample();
  write({density_grid(field)});
  for (const std::optional<double> threshold : {std::optional<double>(), {kThreshold}}) {
    const FieldFile read = read_field(file_, threshold);
    EXPECT_EQ(read.origin, Vec3d());
    EXPECT_EQ(read.field.threshold(), kThreshold);
    EXPECT_EQ(read.field.lattice().voxel_size, 0.25);
    EXPECT_EQ(read.field.lattice().anchor, field.lattice().anchor);
    EXPECT_EQ(read.field.sample_count(), field.sample_count());
    EXPECT_EQ(read.field.inside().size(), 1u);
    const Polygons before = polygonise(field, 0), after = polygonise(read.field, 0);
    EXPECT_GT(before.faces.size(), 100u);
    EXPECT_EQ(after.points, before.points);
    EXPECT_EQ(after.faces, before.faces);
    EXPECT_EQ(mesh_bricks(read.field).points.size(), before.points.size());
  }
}

openvdb::FloatGrid::Ptr foreign() {
  auto grid = openvdb::FloatGrid::create(0.0f);
  grid->setName("smoke");
  const openvdb::CoordBBox box({-2, -2, -2}, {20, 20, 20});
  for (auto at = box.begin(); at; ++at) {
    const openvdb::Coord c = *at;
    grid->tree().setValue(
        c, static_cast<float>(ball_of_10({double(c.x()), double(c.y()), double(c.z())})));
  }
  return grid;
}

TEST_F(FieldFiles, OfOtherProgramsNeedAThreshold) {
  auto grid = foreign();
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  grid->transform().postTranslate({0.1, 2, -7});
  write({grid});
  expect_error(ErrorCode::usage, "where its surface is");
  const FieldFile read = read_field(file_, 1.5);
  EXPECT_NEAR(length(read.origin - Vec3d(0.1, 2, -7)), 0, 1e-12);
  EXPECT_EQ(read.field.lattice().voxel_size, 0.5);
  Box box;
  for (const Vec3f p : polygonise(read.field, 0).points) {
    box.include(read.field.lattice().world(Vec3d(p)));
  }
  // The ball has a radius of 10.5 voxels and is cut off where the grid ends.
  EXPECT_NEAR(box.low.x, 0.5 * 1.5, 0.1);
  EXPECT_NEAR(box.high.x, 0.5 * 20, 0.5);
}

TEST_F(FieldFiles, KeepTheDensityOfTiles) {
  auto grid = foreign();
  grid->tree().fill(openvdb::CoordBBox({128, 0, 0}, {255, 127, 127}), 3.5f, true);
  grid->tree().fill(openvdb::CoordBBox({256, 0, 0}, {263, 7, 7}), 0.5f, true);
  write({grid});
  const FieldFile read = read_field(file_, kThreshold);
  const auto value = [&](openvdb::Coord c) {
    const Vec3d local = read.field.lattice().local({double(c.x()), double(c.y()), double(c.z())});
    const Coord at = cell_of(local + Vec3d(0.5, 0.5, 0.5));
    return negated_grid(read.field).tree().getValue({at.x, at.y, at.z});
  };
  EXPECT_EQ(value({200, 60, 60}), -3.5f);
  EXPECT_EQ(value({255, 127, 127}), -3.5f);
  EXPECT_EQ(value({260, 5, 5}), -0.5f);
  EXPECT_EQ(value({300, 5, 5}), 0.0f);
  EXPECT_EQ(read.field.inside().size(), 1u) << "half a density is not inside";
}

TEST_F(FieldFiles, PreferTheGridCalledDensity) {
  auto other = foreign();
  auto density = density_grid(sample());
  write({other, density});
  EXPECT_EQ(read_field(file_, {}).field.lattice().voxel_size, 0.25);
  auto third = foreign();
  third->setName("fire");
  write({other, third});
  expect_error(ErrorCode::input, "smoke", 1);
}

TEST_F(FieldFiles, RefuseWhatIsNoDensity) {
  expect_error(ErrorCode::input, "no such file");
  std::ofstream(file_) << "not a grid at all";
  expect_error(ErrorCode::input, "cannot be read");

  write({density_grid(sample())});
  expect_error(ErrorCode::usage, "T = 2", 1.5);
  std::filesystem::resize_file(file_, std::filesystem::file_size(file_) / 2);
  expect_error(ErrorCode::input, "cannot be read");

  write({openvdb::Vec3SGrid::create()});
  expect_error(ErrorCode::input, "no grid of floats", 1);
  write({openvdb::FloatGrid::create(0)});
  expect_error(ErrorCode::input, "empty", 1);
  auto level_set = foreign();
  level_set->setGridClass(openvdb::GRID_LEVEL_SET);
  write({level_set});
  expect_error(ErrorCode::input, "distances", 1);
  auto skewed = foreign();
  skewed->transform().preRotate(0.3, openvdb::math::Y_AXIS);
  write({skewed});
  expect_error(ErrorCode::input, "cubes", 1);
  auto endless = foreign();
  endless->tree().setValue({3, 3, 3}, std::numeric_limits<float>::infinity());
  write({endless});
  expect_error(ErrorCode::input, "finite", 1);
  write({foreign()});
  expect_error(ErrorCode::empty, "reaches the threshold 50", 50);
  expect_error(ErrorCode::input, "not a density", -1);
}

}  // namespace
}  // namespace leafhull
