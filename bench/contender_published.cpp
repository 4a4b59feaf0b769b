// SPDX-License-Identifier: Apache-2.0
// The paper's program on today's machine: plain C++, one thread.
#include "bench/contender.h"
#include "bench/published.h"

namespace leafhull::bench {
namespace {

std::vector<published::Leaf> read_leaves(const Case& c) {
  const std::vector<Vec3d> points = read_points(c);
  const std::vector<double> frames = read_doubles(c.frames, 8 * c.count);
  std::vector<published::Leaf> leaves;
  leaves.reserve(c.count);
  for (std::size_t j = 0; j < c.count; ++j) {
    const double* f = &frames[8 * j];
    leaves.push_back({points[j], {f[0], f[1], f[2]}, {f[3], f[4], f[5]}, f[6], f[7]});
  }
  return leaves;
}

Json run(std::span<const published::Leaf> leaves, const published::Parameters& parameters,
         double threshold) {
  published::Grid grid;
  published::TriangleMesh mesh;
  const double field = seconds_of([&] { grid = published::density_field(leaves, parameters); });
  const double polygons = seconds_of([&] { mesh = published::marching_cubes(grid, threshold); });
  return {{"field", field},
          {"mesh", polygons},
          {"total", field + polygons},
          {"vertices", mesh.positions.size()},
          {"faces", mesh.triangles.size()},
          {"threshold", threshold},
          {"cell_vertices", grid.values.size()}};
}

Contender prepare(const Case& c, published::Parameters parameters) {
  const auto leaves = std::make_shared<const std::vector<published::Leaf>>(read_leaves(c));
  parameters.radius_max = c.radius;
  parameters.voxel = c.voxel;
  parameters.flatness = c.flatness;
  Contender contender{.name = std::string("published ") +
                              (parameters.controlled ? "controlled" : "isotropic") +
                              (parameters.literal ? " literal" : ""),
                      .version = "Shiraishi et al. 2011, Figure 8; compiler " __VERSION__};
  // The paper gives T and has no coverage: the threshold is found once, beside the runs.
  double threshold = c.threshold.value_or(0);
  if (!c.threshold) {
    contender.setup["threshold for the coverage"] = seconds_of([&] {
      published::Parameters gathered = parameters;
      gathered.literal = false;
      threshold = published::threshold_for_coverage(published::density_field(*leaves, gathered),
                                                    *leaves, *c.coverage);
    });
  }
  contender.run = [=] { return run(*leaves, parameters, threshold); };
  return contender;
}

}  // namespace
}  // namespace leafhull::bench

int main(int argc, char** argv) {
  CLI::App app("The algorithm as published; --threads changes nothing, it knows one.");
  leafhull::bench::published::Parameters parameters;
  std::string method = "controlled";
  app.add_option("--method", method)->check(CLI::IsMember({"isotropic", "controlled"}));
  app.add_flag("--literal", parameters.literal,
               "every cell vertex sums over all leaf vertices, as Eq. (2) says it");
  return leafhull::bench::serve(app, argc, argv, [&](const auto& c, int) {
    parameters.controlled = method == "controlled";
    return leafhull::bench::prepare(c, parameters);
  });
}
