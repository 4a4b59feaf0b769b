// SPDX-License-Identifier: Apache-2.0
#include "output_sample.h"

#include "density/field.h"
#include "surface/density_grid.h"

namespace leafhull {

// Replaces the function of the surface room: three samples on a lattice of 0.25.
openvdb::FloatGrid::Ptr density_grid(const Field& field) {
  openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0.0f);
  grid->setName("density");
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
  grid->insertMeta("threshold", openvdb::DoubleMetadata(field.threshold()));
  grid->tree().setValue({0, 0, 0}, 0.5f);
  grid->tree().setValue({1, 0, -9}, 1.25f);
  grid->tree().setValue({100, 20, 3}, 3.0f);
  return grid;
}

namespace test {

Shape sample_shape() {
  Shape shape;
  shape.mesh = sphere(6);
  shape.kernels = {{{1, 2, 3}, {0, 0, 1}, {1, 0, 0}, 0.75f, 0.5f, 0.25f},
                   {{-1, 0, 4}, {0, 1, 0}, {0, 0, 1}, 1.5f, 1.0f, 0.8f}};
  shape.isotropic_density = {2.5f, 0.125f};
  shape.field = std::make_shared<Field>(Lattice{}, 1.7);

  Report& report = shape.report;
  report.options = resolve({});
  report.threshold = 1.7;
  report.radius_max_model = 0.3;
  report.resolution = 128;
  report.voxel_size = 0.1;
  report.device = "a device";
  report.leaf_area = 17.5;
  report.covered = 0.875;
  report.counts = {.leaves = 1,
                   .leaf_vertices = 2,
                   .leaf_points = 16,
                   .dropped_leaves = 3,
                   .split_components = 4,
                   .evaluated_voxels = 5'000'000'000,
                   .evaluated_pairs = 6,
                   .mesh_vertices = 7,
                   .mesh_triangles = 8,
                   .components = 9,
                   .dropped_components = 10};
  report.density = {.mean = 0.1, .variance = 0.25, .p1 = 0.3, .p2 = 0.4};
  report.metrics = {.dilated_voxels = 11,
                    .inside_voxels = 12,
                    .on_voxels = 13,
                    .off_site_exact = 14,
                    .off_site_sampled = 15,
                    .erosion = 0.0625,
                    .dilation = 0.625};
  report.seconds = {{"hash", 0.5}, {"snap vertices", 0.25}, {"hash", 1.5}, {"total", 2.25}};
  report.peak_memory_bytes = 1 << 20;
  report.warnings = {"one thing"};
  return shape;
}

}  // namespace test
}  // namespace leafhull
