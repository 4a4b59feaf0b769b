// SPDX-License-Identifier: Apache-2.0
// leafhull itself, warm: its kernels are compiled before the first run.
#include "bench/contender.h"
#include "bench/leafhull_case.h"
#include "bench/threads.h"
#include "density/control.h"
#include "leafhull/device.h"
#include "leafhull/shape.h"
#include "leafhull/version.h"
#include "pipeline/evaluate.h"
#include "pipeline/grid.h"
#include "points/leaf_points.h"

namespace leafhull::bench {
namespace {

double seconds_of_stage(const Report& report, std::string_view stage) {
  for (const StageTime& s : report.seconds) {
    if (s.stage == stage) return s.seconds;
  }
  throw std::logic_error("the report has no stage '" + std::string(stage) + "'");
}

/// Steps 1 to 6 of Figure 8: every stage before the surface.
double seconds_before_polygonise(const Report& report) {
  double seconds = 0;
  for (const StageTime& s : report.seconds) {
    if (s.stage == "polygonise") break;
    seconds += s.seconds;
  }
  return seconds;
}

/// Hash, bounds and field of the isotropic method at a known threshold: what a peer that knows no
/// coverage does.
double seconds_of_isotropic_field(const LeafSet& leaves, const Report& report, Device& device) {
  return seconds_of([&] {
    const Lattice lattice = grid_of(leaves, report.options).lattice;
    const std::vector<Kernel> kernels = isotropic_kernels(
        vertex_points(leaves).points, report.radius_max_model, report.options.falloff);
    const auto hash =
        std::make_shared<const SpatialHash>(kernels, hash_cells(leaves, report.radius_max_model));
    DensityFunction density(device, kernels, hash, lattice, report.options.falloff);
    density.sample_band({report.threshold}, 1, false, DensityFunction::Lists::forget,
                        [](double) {});
  });
}

Json run(const LeafSet& leaves, const Options& options, Device& device) {
  Shape shape;
  const double total =
      seconds_of([&] { shape = extract(leaves, options, device, {}, Detail::shape); });
  const Report& report = shape.report;
  Json stages;
  for (const StageTime& s : report.seconds) stages[s.stage] = s.seconds;
  return {{"field", options.method == Method::isotropic
                        ? seconds_of_isotropic_field(leaves, report, device)
                        : seconds_before_polygonise(report)},
          {"mesh", seconds_of_stage(report, "polygonise")},
          {"total", total},
          {"vertices", report.counts.mesh_vertices},
          {"faces", report.counts.mesh_triangles},
          {"stages", stages},
          {"threshold", report.threshold},
          {"evaluated_voxels", report.counts.evaluated_voxels},
          {"evaluated_pairs", report.counts.evaluated_pairs}};
}

Contender prepare(const Case& c, Method method, Mesher mesher, int threads) {
  const auto leaves = std::make_shared<const LeafSet>(load_leaves(c.tree));
  std::shared_ptr<Device> device;
  Contender contender{
      .name = "leafhull " + std::string(name(method)), .version = kVersion, .threads = threads};
  DeviceOptions device_options;
  device_options.threads = threads;
  contender.setup["open device"] =
      seconds_of([&] { device = std::make_shared<Device>(device_options); });
  Options options = options_of(c, method);
  options.mesher = mesher;
  contender.run = [=, limit = limit_threads(threads)] { return run(*leaves, options, *device); };
  contender.setup["first run, kernels compiled"] = seconds_of(contender.run);
  return contender;
}

}  // namespace
}  // namespace leafhull::bench

int main(int argc, char** argv) {
  CLI::App app("leafhull, warm.");
  auto method = leafhull::Method::controlled;
  leafhull::bench::add_method(app, method);
  std::string mesher = "bricks";
  app.add_option("--mesher", mesher)->check(CLI::IsMember({"vdb", "bricks"}));
  return leafhull::bench::serve(app, argc, argv, [&](const auto& c, int threads) {
    return leafhull::bench::prepare(
        c, method, mesher == "vdb" ? leafhull::Mesher::vdb : leafhull::Mesher::bricks, threads);
  });
}
