// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "leafhull/api.h"
#include "leafhull/device.h"
#include "leafhull/leaves.h"
#include "leafhull/options.h"
#include "leafhull/progress.h"
#include "leafhull/vec.h"

namespace leafhull {

/// A density function D_j: its centre, two of its axes, its radii after control and its weight; the
/// third axis is normal x major. Source: Eqs. (3), (4), (8); the weight is ours, SPEC: 2.
struct Kernel {
  Vec3d centre;                                     ///< c_j, model units
  Vec3f normal, major;                              ///< n_j, u_j, unit, orthogonal
  float radius_major, radius_minor, radius_normal;  ///< R_u, R_v, R_n, model units, > 0
  float weight = 1;                                 ///< w_j, > 0
};

/// A closed triangle mesh, counter-clockwise seen from outside. A vertex is at origin +
/// positions[i]; the origin is zero unless the tree lies so far out that floats would lose the
/// shape.
struct Mesh {
  Vec3d origin;
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;  ///< -grad N / |grad N|
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::optional<Vec3f> colour;  ///< its material's, linear; none: leafhull's green
};

struct DensityStatistics {  ///< N_iso over the leaf points, weighted by area
  double mean = 0, variance = 0, p1 = 0, p2 = 0;
};

/// Voxels are lattice cells. SPEC: 6; Source: section 4, Figure 9.
struct Metrics {
  std::uint64_t dilated_voxels = 0;    ///< inside or on, and without a leaf vertex
  std::uint64_t inside_voxels = 0;     ///< all corners at T or above
  std::uint64_t on_voxels = 0;         ///< some corners at T or above
  std::uint64_t off_site_exact = 0;    ///< places on the leaves where N, summed there, is below T
  std::uint64_t off_site_sampled = 0;  ///< likewise, N interpolated from the lattice
  double erosion = 0;   ///< the share of the places on the leaves that the shape leaves outside
  double dilation = 0;  ///< dilated voxels over the shape's voxels, always counted at 64 along it
};

/// Places on the leaves are their vertices or, with PointSource::area, samples of equal area.
struct Counts {
  std::uint64_t leaves = 0, leaf_vertices = 0, leaf_points = 0, dropped_leaves = 0,
                split_components = 0;
  std::uint64_t evaluated_voxels = 0, evaluated_pairs = 0;
  std::uint64_t mesh_vertices = 0, mesh_triangles = 0, components = 0, dropped_components = 0;
};

struct StageTime {
  std::string stage;
  double seconds = 0;
};

/// How much an extraction computes.
enum class Detail {
  shape,   ///< the mesh, the field and the kernels; of N at the leaves only what these depend on
  report,  ///< and what only a report tells: the density at the leaves and the metrics
};

/// What an extraction did, for people and for `--report`.
struct Report {
  Detail detail = Detail::report;
  Options options;              ///< resolved
  double threshold = 0;         ///< T
  double radius_max_model = 0;  ///< R_max, model units
  int resolution = 0;           ///< voxels along the longest side
  double voxel_size = 0;        ///< h, model units
  std::string device;
  Counts counts;
  DensityStatistics density;
  double leaf_area = 0;              ///< visible area, model units squared
  std::optional<Vec3f> leaf_colour;  ///< linear, mean; none: unknown
  double covered = 0;  ///< the share of places on the leaves where N, summed there, is T or above
  Metrics metrics;
  std::vector<StageTime> seconds;       ///< in order, the total last
  std::uint64_t peak_memory_bytes = 0;  ///< of the process; set by the caller
  std::vector<std::string> warnings;
};

struct Shape {
  class Field;  ///< the sampled density, for leafhull's own stages

  Mesh mesh;
  std::vector<Kernel> kernels;           ///< one per leaf point
  std::vector<float> isotropic_density;  ///< N_iso(c_j), one per kernel
  std::shared_ptr<const Field> field;
  Report report;
};

/// The abstract shape of a tree's leaves: the stages of Figure 8, one after the other. SPEC: 2
/// to 6. With Detail::shape the report's `density`, `covered` and `metrics` may be zero, and
/// `isotropic_density` may be empty; write_outputs then refuses a report and kernels.
/// @throws Error usage: options, or a resolution that does not fit in memory; input: no leaves, or
///         a crown without extent; device: a kernel that does not build (with its log) or run;
///         empty: no sample reaches the threshold.
LEAFHULL_API Shape extract(const LeafSet& leaves, const Options& options, Device& device,
                           const Progress& progress = {}, Detail detail = Detail::report);

}  // namespace leafhull
