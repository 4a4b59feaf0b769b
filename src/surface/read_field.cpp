// SPDX-License-Identifier: Apache-2.0
#include "surface/read_field.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "leafhull/error.h"
#include "text/choice.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;
using openvdb::FloatGrid;

constexpr const char* kGrid = "density";
constexpr const char* kThreshold = "threshold";

[[noreturn]] void fail(const fs::path& file, const std::string& what, const std::string& remedy) {
  throw Error(ErrorCode::input, file.string() + ": " + what, remedy);
}

std::string number(double value) { return significant(value, 6); }

/// The name of the file's density grid.
std::string choose_grid(openvdb::io::File& file) {
  std::vector<std::string> names;
  for (auto name = file.beginName(); name != file.endName(); ++name) {
    if (file.readGridMetadata(name.gridName())->isType<FloatGrid>()) {
      names.push_back(name.gridName());
    }
  }
  if (std::find(names.begin(), names.end(), kGrid) != names.end()) return kGrid;
  if (names.size() == 1) return names.front();
  fail(file.filename(),
       names.empty() ? "holds no grid of floats"
                     : "has no grid 'density' but several: " + joined(names, ", "),
       "Give a .vdb file from leafhull extract --save-field.");
}

FloatGrid::Ptr read_grid(const fs::path& path) try {
  openvdb::initialize();
  if (!fs::is_regular_file(path)) {
    fail(path, "cannot be read: there is no such file", "Give the path of a .vdb file.");
  }
  openvdb::io::File file(path.string());
  file.open(/*delayLoad=*/false);
  return openvdb::gridPtrCast<FloatGrid>(file.readGrid(choose_grid(file)));
} catch (const std::exception& error) {
  if (dynamic_cast<const Error*>(&error)) throw;
  fail(path, std::string("cannot be read: ") + error.what(), "Give an undamaged OpenVDB file.");
}

struct GridMap {
  double voxel_size;
  Vec3d origin;
};

GridMap map_of(const FloatGrid& grid, const fs::path& file) {
  const openvdb::Mat4d m = grid.transform().baseMap()->getAffineMap()->getMat4();
  const double h = m(0, 0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double wanted = row == column ? h : 0;
      if (!(h > 0) || !(std::abs(m(row, column) - wanted) <= 1e-6 * h)) {
        fail(file, "its voxels are not cubes along the axes",
             "Resample the grid without rotation.");
      }
    }
  }
  return {h, {m(3, 0), m(3, 1), m(3, 2)}};
}

std::optional<double> stored_threshold(const FloatGrid& grid) {
  if (const auto value = grid.getMetadata<openvdb::DoubleMetadata>(kThreshold)) {
    return value->value();
  }
  if (const auto value = grid.getMetadata<openvdb::FloatMetadata>(kThreshold)) {
    return static_cast<double>(value->value());
  }
  return {};
}

double threshold_of(const FloatGrid& grid, std::optional<double> asked, const fs::path& file) {
  const std::optional<double> stored = stored_threshold(grid);
  constexpr double kAsPrinted = 1e-5;
  if (stored && asked && !(std::abs(*stored - *asked) <= kAsPrinted * *stored)) {
    throw Error(ErrorCode::usage, file.string() + " was sampled only for T = " + number(*stored),
                "Leave --threshold out, or render the tree itself.");
  }
  const double threshold = stored ? *stored : asked.value_or(0);
  if (!stored && !asked) {
    throw Error(ErrorCode::usage, file.string() + " does not say where its surface is",
                "Give the density there: --threshold T.");
  }
  if (!(threshold >= static_cast<double>(std::numeric_limits<float>::min())) ||
      !(threshold <= static_cast<double>(std::numeric_limits<float>::max()))) {
    fail(file, "its threshold " + number(threshold) + " is not a density", "Repair the file.");
  }
  return threshold;
}

Coord relative(const openvdb::Coord& c, const openvdb::Coord& anchor) {
  return {c.x() - anchor.x(), c.y() - anchor.y(), c.z() - anchor.z()};
}

/// Adds evaluated bricks, some at a time.
void add_bricks(const FloatGrid& grid, const openvdb::Coord& anchor, const fs::path& file,
                Field& field) {
  constexpr std::size_t kBatch = 1024;
  std::vector<Coord> origins;
  std::vector<float> samples;
  const auto flush = [&] {
    field.add_bricks(origins, samples);
    origins.clear(), samples.clear();
  };
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    const float* const values = leaf->buffer().data();
    if (!std::all_of(values, values + kBrickSamples, [](float n) { return std::isfinite(n); })) {
      fail(file, "not all of its densities are finite", "Repair the grid.");
    }
    origins.push_back(relative(leaf->origin(), anchor));
    samples.insert(samples.end(), values, values + kBrickSamples);
    if (origins.size() == kBatch) flush();
  }
  flush();
}

/// Adds tiles that hold a density.
void add_tiles(const FloatGrid& grid, const openvdb::Coord& anchor, Field& field) {
  auto tile = grid.tree().cbeginValueAll();
  tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
  std::vector<InsideBlock> blocks;
  for (; tile; ++tile) {
    if (!(*tile > 0)) continue;
    const openvdb::CoordBBox box = tile.getBoundingBox();
    blocks.push_back({{relative(box.min(), anchor), box.dim().x()}, static_cast<double>(*tile)});
  }
  field.add_inside(blocks);
}

}  // namespace

FieldFile read_field(const fs::path& file, std::optional<double> asked) {
  const FloatGrid::Ptr grid = read_grid(file);
  if (grid->getGridClass() == openvdb::GRID_LEVEL_SET || grid->background() != 0) {
    fail(file, "holds distances or another field, not a density that is 0 far away",
         "Give a fog volume, such as one from leafhull extract --save-field.");
  }
  const auto [voxel_size, origin] = map_of(*grid, file);
  const double threshold = threshold_of(*grid, asked, file);
  openvdb::CoordBBox box;
  if (!grid->tree().evalLeafBoundingBox(box)) {
    fail(file, "its grid is empty", "Give a file that holds a density.");
  }
  const openvdb::Coord low = box.min() & ~(kRootEdge - 1);
  FieldFile result{Field({voxel_size, {low.x(), low.y(), low.z()}}, threshold), origin};
  add_bricks(*grid, low, file, result.field);
  add_tiles(*grid, low, result.field);
  const float highest = result.field.highest();
  if (static_cast<double>(highest) < threshold && result.field.inside().empty()) {
    throw Error(ErrorCode::empty,
                "the surface is empty: no sample of " + file.string() + " reaches the threshold " +
                    number(threshold) + "; the highest is " + number(static_cast<double>(highest)),
                "Lower --threshold.");
  }
  return result;
}

}  // namespace leafhull
