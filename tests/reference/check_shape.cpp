// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "checks.h"
#include "mesh.h"

namespace recount {
namespace {

constexpr double kVertexTolerance = 0.02;  // voxels, 99th percentile
constexpr double kNormalTolerance = 1;     // degrees, 99th percentile

std::vector<Kernel> used_kernels(const Ply& ply) {
  const auto centres = ply.points("x", "y", "z"), radii = ply.points("ru", "rv", "rn");
  const auto u = ply.points("ux", "uy", "uz"), v = ply.points("vx", "vy", "vz"),
             n = ply.points("nx", "ny", "nz");
  const auto& weights = ply.property("weight");
  std::vector<Kernel> kernels;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    kernels.push_back(make_kernel(centres[i], {u[i], v[i], n[i]}, radii[i], weights[i]));
  }
  return kernels;
}

/// Checks that T is the quantile of N over the leaf vertices that `--coverage` asks for.
void check_coverage(const Extraction& extraction, const Count& below, Table& table) {
  const auto& coverage = extraction.parameter("coverage");
  if (coverage.is_null()) return;
  const double n = double(extraction.kernels.vertex_count);
  table.compare("coverage", coverage, 1 - double(below.exact) / n, (n - double(below.high) - 1) / n,
                (n - double(below.low) + 1) / n);
}

VoxelCounts check_metrics(const Extraction& extraction, const std::vector<Kernel>& kernels,
                          Table& table) {
  const double threshold = extraction.number("threshold");
  const int falloff = extraction.parameter("falloff");
  const auto centres = extraction.kernels.points("x", "y", "z");
  const Lattice lattice = sum_on_lattice(kernels, falloff, extraction.number("voxel_size"));
  const VoxelCounts voxels = count_voxels(lattice, centres, threshold);
  std::vector<double> exact, sampled;
  for (const Density& density : sum_at(centres, kernels, falloff)) exact.push_back(density.value);
  for (const Point& c : centres) sampled.push_back(lattice.trilinear(c));
  const auto& metrics = extraction.report.at("metrics");
  table.compare("inside voxels", metrics.at("inside_voxels"), voxels.inside);
  table.compare("on voxels", metrics.at("on_voxels"), voxels.on);
  if (!extraction.by_area()) {  // otherwise they count samples, which are not in the kernels
    const Count off_site = count_below(exact, threshold);
    check_coverage(extraction, off_site, table);
    table.compare("dilated voxels", metrics.at("dilated_voxels"), voxels.dilated);
    table.compare("off-site vertices, exact", metrics.at("off_site_exact"), off_site);
    table.compare("off-site vertices, sampled", metrics.at("off_site_sampled"),
                  count_below(sampled, threshold));
  }
  table.compare("evaluated voxels", extraction.report.at("counts").at("evaluated_voxels"),
                double(voxels.samples_beside_surface), double(voxels.samples_beside_surface),
                HUGE_VAL);
  return voxels;
}

/// The mesh only crosses `on` voxels, so its volume lies between that of the inside voxels and that
/// of the inside and on voxels, except for components dropped as too small.
void check_volume(const Extraction& extraction, const VoxelCounts& voxels, double volume,
                  Table& table) {
  if (extraction.number("adaptivity") > 0) return;
  const double h = extraction.number("voxel_size");
  const double dropped = extraction.report.at("counts").value("dropped_components", 0.0) *
                         extraction.number("min_component");
  table.require("mesh volume, voxels", volume / (h * h * h),
                double(voxels.inside.low) / (1 + dropped),
                double(voxels.inside.high + voxels.on.high) * (1 + dropped));
}

void check_normals(const Ply& mesh, const MeshFacts& facts, Table& table) {
  double worst_length = 0;
  for (const auto& [x, y, z] : mesh.points("nx", "ny", "nz")) {
    worst_length = std::max(worst_length, std::abs(std::sqrt(x * x + y * y + z * z) - 1));
  }
  table.require("normal length error, largest", worst_length, 0, 1e-5);
  table.require("normal angle, degrees, 99%", percentile(facts.normal_angles, 0.99), 0,
                kNormalTolerance);
  table.require("normal angle, degrees, largest", percentile(facts.normal_angles, 1), 0, HUGE_VAL);
}

void check_mesh(const Extraction& extraction, const std::vector<Kernel>& kernels,
                const VoxelCounts& voxels, Table& table) {
  const Ply& mesh = *extraction.mesh;
  const double h = extraction.number("voxel_size");
  const auto densities =
      sum_at(mesh.points("x", "y", "z"), kernels, extraction.parameter("falloff"));
  const MeshFacts facts =
      examine(mesh, densities, extraction.number("threshold"), kVertexTolerance * h, h * h * h);
  const auto& counts = extraction.report.at("counts");
  const auto compare = [&](const char* quantity, const char* key, std::size_t recount) {
    table.compare(quantity, counts.at(key), double(recount), double(recount), double(recount));
  };
  compare("mesh vertices", "mesh_vertices", mesh.vertex_count);
  compare("mesh triangles", "mesh_triangles", mesh.triangles.size());
  compare("components", "components", facts.components);
  table.require("edges not used once each way", double(facts.unmatched_edges), 0, 0);
  table.require("vertices of no triangle", double(facts.unused_vertices), 0, 0);
  table.require("components facing inward", double(facts.inward_components), 0, 0);
  check_volume(extraction, voxels, facts.volume, table);
  const bool snapped = extraction.parameter("snap");
  table.require("vertex distance, voxels, 99%", percentile(facts.distances, 0.99) / h, 0,
                snapped ? kVertexTolerance : HUGE_VAL);
  table.require("vertex distance, voxels, largest", percentile(facts.distances, 1) / h, 0,
                HUGE_VAL);
  check_normals(mesh, facts, table);
}

}  // namespace

void check_shape(const Extraction& extraction, Table& table) {
  const std::vector<Kernel> kernels = used_kernels(extraction.kernels);
  const VoxelCounts voxels = check_metrics(extraction, kernels, table);
  if (extraction.mesh) check_mesh(extraction, kernels, voxels, table);
}

}  // namespace recount
