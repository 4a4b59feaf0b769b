// SPDX-License-Identifier: Apache-2.0
// bench_case TREE -o FOLDER: writes FOLDER/case.json and the leaf vertices that it names.
#include <cstdio>

#include "bench/contender.h"
#include "bench/leafhull_case.h"
#include "leafhull/error.h"
#include "pipeline/grid.h"

namespace leafhull::bench {
namespace {

struct Arguments {
  std::string tree;
  std::filesystem::path folder;
  std::string style = "painterly";
  std::optional<int> resolution;
  std::optional<double> radius, voxel;  // model units
};

Arguments parse(CLI::App& app, int argc, char** argv) {
  Arguments a;
  app.add_option("TREE", a.tree, "a tree file, or synthetic:COUNT")->required();
  app.add_option("-o", a.folder, "the folder to write to; made where it is not there")->required();
  app.add_option("--style", a.style, "painterly, or r1.5: R 1.5 crown units and T 1.5")
      ->check(CLI::IsMember({"painterly", "r1.5"}));
  auto* resolution = app.add_option("--resolution", a.resolution, "voxels along the longest side");
  auto* radius = app.add_option("--radius", a.radius, "R in model units in place of the style's");
  auto* voxel = app.add_option("--voxel", a.voxel, "the voxel size in model units");
  resolution->excludes(voxel);
  radius->needs(voxel);
  app.parse(argc, argv);
  return a;
}

Options options_of(const Arguments& a) {
  Options options;
  options.style = a.style == "painterly" ? Style::painterly : Style::paper_previous;
  options.points = PointSource::vertices;  // as its peers take them
  options.resolution = a.resolution;
  options.voxel_size = a.voxel;
  if (a.radius) {
    options.radius_max = a.radius;
    options.radius_unit = RadiusUnit::model;
  }
  return resolve(options);
}

/// points: x y z of every leaf vertex; frames: its normal, major axis, R_u and R_v.
void write_leaves(const LeafSet& leaves, const Case& c) {
  std::vector<double> points, frames;
  points.reserve(3 * leaves.vertices.size());
  frames.reserve(8 * leaves.vertices.size());
  for (const LeafVertex& v : leaves.vertices) {
    points.insert(points.end(), {v.position.x, v.position.y, v.position.z});
    for (const Vec3d axis : {Vec3d(v.normal), Vec3d(v.major)}) {
      frames.insert(frames.end(), {axis.x, axis.y, axis.z});
    }
    frames.insert(frames.end(), {v.radius_major, v.radius_minor});
  }
  write_doubles(points, c.points);
  write_doubles(frames, c.frames);
}

std::string name_of(const Arguments& a, int resolution) {
  std::string tree =
      a.tree.starts_with("synthetic:") ? a.tree : std::filesystem::path(a.tree).stem().string();
  std::replace(tree.begin(), tree.end(), ':', '-');
  return tree + "-" + std::to_string(resolution) + "-" + a.style;
}

void write(const Arguments& a) {
  const LeafSet leaves = load_leaves(a.tree);
  const Options options = options_of(a);
  const Grid grid = grid_of(leaves, options);
  std::filesystem::create_directories(a.folder);
  const std::filesystem::path folder = std::filesystem::canonical(a.folder);
  const bool synthetic = a.tree.starts_with("synthetic:");
  const Case c{.name = name_of(a, grid.resolution),
               .tree = synthetic ? a.tree : std::filesystem::canonical(a.tree).string(),
               .points = folder / "points.f64",
               .frames = folder / "frames.f64",
               .count = leaves.vertices.size(),
               .style = a.style,
               .radius = grid.radius_max,
               .voxel = grid.voxel_size,
               .resolution = grid.resolution,
               .threshold = options.threshold,
               .coverage = options.coverage,
               .flatness = *options.flatness,
               .min_component = *options.min_component};
  write_leaves(leaves, c);
  write_case(c, folder / "case.json");
}

}  // namespace
}  // namespace leafhull::bench

int main(int argc, char** argv) {
  CLI::App app("Writes a case of the bench and its leaf vertices.");
  try {
    leafhull::bench::write(leafhull::bench::parse(app, argc, argv));
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_case: %s\n", error.what());
    return 1;
  }
}
