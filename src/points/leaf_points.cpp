// SPDX-License-Identifier: Apache-2.0
#include "points/leaf_points.h"

#include <cmath>
#include <cstdint>
#include <tuple>

#include "leafhull/error.h"
#include "leaves/order.h"
#include "leaves/sheets.h"
#include "points/fill_solids.h"
#include "points/join.h"
#include "points/place_parts.h"
#include "points/samples.h"

namespace leafhull {
namespace {

auto point_key(const LeafPoint& p) {
  return std::tuple(p.position.x, p.position.y, p.position.z, p.area, p.normal.x, p.normal.y,
                    p.normal.z, p.major.x, p.major.y, p.major.z, p.radius_major, p.radius_minor);
}

void sort_points(std::vector<LeafPoint>& points, const Box& crown) {
  const auto code = [&](std::uint32_t i) { return morton_code(points[i].position, crown); };
  put_in_order(points, order_by_code(points.size(), code, [&](std::uint32_t a, std::uint32_t b) {
                 return point_key(points[a]) < point_key(points[b]);
               }));
}

}  // namespace

LeafPoints vertex_points(const LeafSet& leaves) {
  LeafPoints result;
  result.points.reserve(leaves.vertices.size());
  result.samples.reserve(leaves.vertices.size());
  for (const LeafVertex& v : leaves.vertices) {
    result.points.push_back({v.position, v.normal, v.major, v.radius_major, v.radius_minor, 0});
    if (leaves.crown.contains(v.position)) result.samples.push_back(v.position);
  }
  return result;
}

LeafPoints area_points(const LeafSet& leaves, double spacing, double radius_max) {
  if (!leaves.sheets) {
    throw Error(ErrorCode::usage, "these leaves have vertices but no area",
                "Take them from find_leaves, or give --points vertices.");
  }
  const LeafSet::Sheets& sheets = *leaves.sheets;
  if (sheets.sheets.empty()) {
    throw Error(ErrorCode::input,
                "no leaf has a visible area: their textures are transparent there",
                "Check the model's textures and alpha modes, or give --points vertices.");
  }
  LeafPoints result;
  const auto is_in_solid = [&](const LeafSheet& sheet) {
    return sheet.solid >= 0 &&
           is_filled(sheets.solids[static_cast<std::size_t>(sheet.solid)], radius_max);
  };
  result.points = join_in_cells(place_parts(sheets, spacing, is_in_solid), spacing);
  for (const LeafSolid& solid : sheets.solids) {
    if (!is_filled(solid, radius_max)) continue;
    const std::vector<LeafPoint> inside = fill(solid, radius_max);
    result.points.insert(result.points.end(), inside.begin(), inside.end());
  }
  sort_points(result.points, leaves.crown);
  for (const LeafPoint& point : result.points) result.area += point.area;
  const Samples samples = samples_of(sheets, leaves.crown);
  result.samples = samples.places;
  for (const std::uint32_t sheet : samples.sheet) {
    result.in_solid.push_back(is_in_solid(sheets.sheets[sheet]));
  }
  return result;
}

}  // namespace leafhull
