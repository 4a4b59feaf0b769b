// SPDX-License-Identifier: Apache-2.0
#include "pipeline/describe.h"

#include <algorithm>
#include <string>

#include "leafhull/error.h"
#include "pipeline/threshold.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

/// A coverage counts as missed by more than this, which happens if many places share one density.
constexpr double kCoverageMissed = 0.025;

void warn_of_points(const LeafSet& leaves, const Prepared& prepared, Report& report) {
  const Options& options = prepared.options;
  if (options.points == PointSource::vertices &&
      leaves.mean_radius_major > report.radius_max_model) {
    report.warnings.push_back(
        "the leaves' mean radius, " + significant(leaves.mean_radius_major, 3) +
        " model units, is above R_max, " + significant(report.radius_max_model, 3) +
        ": kernels at their vertices leave their middle empty (--points area does not)");
  }
  if (!options.coverage) return;
  const std::vector<float>& there = *prepared.there;
  const std::vector<bool>& in_solid = prepared.points->in_solid;
  // N is summed in floats: densities this near to T may end up on either side on the lattice.
  const double above = report.threshold * (1 + 1e-5);
  const auto surely = std::count_if(there.begin(), there.end(),
                                    [&](float n) { return static_cast<double>(n) > above; });
  const double low = static_cast<double>(surely) / static_cast<double>(there.size());
  if (std::max(report.covered - *options.coverage, *options.coverage - low) <= kCoverageMissed) {
    return;
  }
  const auto in_solids = std::count(in_solid.begin(), in_solid.end(), true);
  if (2 * in_solids > std::ssize(in_solid)) return;  // filled crowns leave out little
  const std::string covered = fixed(100 * report.covered, 0) + "% of ";
  report.warnings.push_back(
      "a coverage of " + significant(*options.coverage, 3) + " cannot be reached: " +
      (options.points == PointSource::area
           ? "most leaves are sheets of one density; T = " + significant(report.threshold, 3) +
                 ", well below it, takes in " + covered + "the leaf area"
           : "many leaf vertices have the density " + significant(report.threshold, 4) +
                 ", and between " + fixed(100 * low, 0) + "% and " + covered +
                 "all lie inside (--points area avoids that)"));
}

/// A shape in more pieces than this warrants a warning.
constexpr std::uint64_t kManyPieces = 50;

void warn_of_pieces(std::uint64_t pieces, Report& report) {
  if (pieces <= kManyPieces) return;
  report.warnings.push_back("the shape falls into " + std::to_string(pieces) +
                            " pieces: raise --radius-max or --coverage to join them, or "
                            "--min-component to drop the small ones");
}

}  // namespace

Report describe(const Options& resolved, const Grid& grid) {
  Report report;
  report.options = resolved;
  report.radius_max_model = grid.radius_max;
  report.resolution = grid.resolution;
  report.voxel_size = grid.voxel_size;
  return report;
}

Report describe(const Run& run, const Prepared& prepared) {
  Report report = describe(prepared.options, prepared.grid);
  const LeafSet& leaves = run.leaves;
  report.detail = run.detail;
  report.device = text_of(run.device.info());
  report.warnings = leaves.warnings;
  report.density = prepared.statistics;
  report.threshold = prepared.threshold;
  report.leaf_area = leaves.area;
  report.leaf_colour = leaves.colour;
  report.counts.leaves = leaves.leaf_count;
  report.counts.leaf_vertices = leaves.vertices.size();
  report.counts.leaf_points = prepared.points->points.size();
  report.counts.dropped_leaves = leaves.dropped_leaves;
  report.counts.split_components = leaves.split_components;
  if (prepared.there) report.covered = 1 - share_below(*prepared.there, prepared.threshold);
  warn_of_points(leaves, prepared, report);
  return report;
}

void describe_pieces(const Pieces& pieces, Report& report) {
  report.counts.components = pieces.kept;
  report.counts.dropped_components = pieces.dropped;
  warn_of_pieces(pieces.kept, report);
}

void describe_mesh(const Mesh& mesh, const Sampled& sampled, Report& report) {
  report.counts.mesh_vertices = mesh.positions.size();
  report.counts.mesh_triangles = mesh.triangles.size();
  report.counts.evaluated_voxels = sampled.field.sample_count();
  report.counts.evaluated_pairs = sampled.pairs;
}

void refuse_empty(const Prepared& prepared, std::span<const float> there, const Field& field) {
  const Options& options = prepared.options;
  const float at_leaves = std::ranges::max(there);
  const auto highest = static_cast<double>(std::max(field.highest(), at_leaves));
  const char* lower = options.threshold           ? "Lower --threshold"
                      : options.threshold_percent ? "Lower --threshold-percent"
                      : options.erosion           ? "Lower --erosion"
                                                  : "Give --threshold 50% in place of --coverage";
  throw Error(ErrorCode::empty,
              "the surface is empty: no sample reaches the threshold " +
                  significant(field.threshold(), 4) + "; the density is at most " +
                  significant(highest, 4) + " at the leaves and between",
              std::string(lower) + ", enlarge --radius-max, or use a finer --resolution.");
}

}  // namespace leafhull
