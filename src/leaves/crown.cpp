// SPDX-License-Identifier: Apache-2.0
#include "leaves/crown.h"

#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "leaves/union_find.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

/// At most one leaf in this many may be a stray; the core leaves out as many at each end.
constexpr std::size_t kFew = 10;
/// How far a leaf may be from the rest of the crown, as a share of the core's longest side.
constexpr double kReach = 0.5;
/// Cells along that distance.
constexpr int kCells = 2;
/// Cells farther from the core are clamped to this: they are far from the crown in any case.
constexpr double kLastCell = 1 << 19;

std::vector<Box> leaf_boxes(const LeafSet& leaves) {
  std::vector<Box> boxes(leaves.leaf_count);
  for (const LeafVertex& vertex : leaves.vertices) boxes[vertex.leaf].include(vertex.position);
  return boxes;
}

Box core_of(std::span<const Box> boxes) {
  const std::size_t left_out = boxes.size() / kFew;
  const auto at_rank = [&](std::size_t rank, double Vec3d::*axis, Vec3d Box::*end) {
    std::vector<double> values(boxes.size());
    std::ranges::transform(boxes, values.begin(), [&](const Box& box) { return (box.*end).*axis; });
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::ranges::nth_element(values, nth);
    return *nth;
  };
  Box core;
  static constexpr std::array kAxes{&Vec3d::x, &Vec3d::y, &Vec3d::z};
  tbb::parallel_for_each(kAxes, [&](double Vec3d::*axis) {
    core.low.*axis = at_rank(left_out, axis, &Box::low);
    core.high.*axis = at_rank(boxes.size() - 1 - left_out, axis, &Box::high);
  });
  return core;
}

/// gap() is how far `inner` lies from `outer`, overhang() how far it sticks out of it: the largest
/// distance along an axis.
double gap(const Box& outer, const Box& inner) {
  const auto along = [&](double Vec3d::*axis) {
    return std::max(outer.low.*axis - inner.high.*axis, inner.low.*axis - outer.high.*axis);
  };
  return std::max({along(&Vec3d::x), along(&Vec3d::y), along(&Vec3d::z), 0.0});
}
double overhang(const Box& outer, const Box& inner) {
  return std::max(gap(outer, {inner.low, inner.low}), gap(outer, {inner.high, inner.high}));
}

/// The core and the cells around it that hold leaf vertices, joined where leaves join them.
class Groups {
 public:
  static constexpr std::uint32_t kCore = 0;

  Groups(const Box& core, double reach) : core_(core), cell_(reach / kCells) {}

  std::uint32_t at(Vec3d vertex) {
    if (gap(core_, {vertex, vertex}) == 0) return kCore;
    const auto along = [&](double v, double low) {
      return static_cast<std::int64_t>(
          std::clamp(std::floor((v - low) / cell_), -kLastCell, kLastCell));
    };
    const Cell cell{along(vertex.x, core_.low.x), along(vertex.y, core_.low.y),
                    along(vertex.z, core_.low.z)};
    const auto [found, is_new] =
        cells_.try_emplace(key(cell), static_cast<std::uint32_t>(sets_.size()));
    if (is_new) sets_.add(), places_.push_back(cell);
    return found->second;
  }

  void join(std::uint32_t a, std::uint32_t b) { sets_.unite(a, b); }

  void join_neighbours() {
    for (std::uint32_t a = 1; a < sets_.size(); ++a) {
      const auto [x, y, z] = places_[a];
      for (int i = -kCells; i <= kCells; ++i) {
        for (int j = -kCells; j <= kCells; ++j) {
          for (int k = -kCells; k <= kCells; ++k) {
            const auto b = cells_.find(key({x + i, y + j, z + k}));
            if (b != cells_.end()) join(a, b->second);
          }
        }
      }
    }
  }

  bool joined(std::uint32_t a, std::uint32_t b) { return sets_.find(a) == sets_.find(b); }

 private:
  struct Cell {
    std::int64_t x = 0, y = 0, z = 0;
  };

  static std::uint64_t key(Cell cell) {
    const auto bits = [](std::int64_t v) { return static_cast<std::uint64_t>(v) & 0x1fffff; };
    return bits(cell.x) | bits(cell.y) << 21 | bits(cell.z) << 42;
  }

  Box core_;
  double cell_;
  std::unordered_map<std::uint64_t, std::uint32_t> cells_;
  UnionFind sets_{1};  ///< starts with only the core
  std::vector<Cell> places_{Cell{}};
};

/// Whether each leaf is joined to the core.
std::vector<bool> joined_to(const Box& core, double reach, const LeafSet& leaves,
                            std::span<const Box> boxes) {
  constexpr std::uint32_t kNone = 0xffffffff;
  Groups groups(core, reach);
  std::vector<std::uint32_t> group(boxes.size());
  std::ranges::transform(boxes, group.begin(), [&](const Box& box) {
    return gap(core, box) <= reach ? Groups::kCore : kNone;
  });
  for (const LeafVertex& vertex : leaves.vertices) {
    const std::uint32_t here = groups.at(vertex.position);
    std::uint32_t& leaf = group[vertex.leaf];
    if (leaf == kNone) leaf = here;
    groups.join(here, leaf);
  }
  groups.join_neighbours();
  std::vector<bool> joined(boxes.size());
  for (std::size_t i = 0; i < joined.size(); ++i) {
    joined[i] = groups.joined(group[i], Groups::kCore);
  }
  return joined;
}

}  // namespace

Crown find_crown(const LeafSet& leaves) {
  const Crown all{.box = leaves.bounds};
  if (leaves.leaf_count < kFew) return all;
  const std::vector<Box> boxes = leaf_boxes(leaves);
  const Box core = core_of(boxes);
  const double reach = kReach * core.longest_side();
  if (overhang(core, leaves.bounds) <= reach) return all;

  const std::vector<bool> joined = joined_to(core, reach, leaves, boxes);
  Crown crown;
  crown.strays = static_cast<std::size_t>(std::ranges::count(joined, false));
  if (crown.strays == 0 || crown.strays > boxes.size() / kFew) return all;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!joined[i]) continue;
    crown.box.include(boxes[i].low);
    crown.box.include(boxes[i].high);
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!joined[i]) crown.farthest = std::max(crown.farthest, gap(crown.box, boxes[i]));
  }
  return crown;
}

std::string stray_warning(const Crown& crown) {
  const std::string distance = significant(crown.farthest / crown.box.longest_side(), 2);
  if (crown.strays == 1) {
    return "1 leaf lies far from the crown, " + distance +
           " times the crown's longest side away; it does not count towards its size";
  }
  return std::to_string(crown.strays) + " leaves lie far from the crown, up to " + distance +
         " times the crown's longest side away; they do not count towards its size";
}

}  // namespace leafhull
