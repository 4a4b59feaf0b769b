// SPDX-License-Identifier: Apache-2.0
#include "leaves/sheets.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <tuple>

#include "leaves/order.h"
#include "leaves/placement.h"

namespace leafhull {
namespace {

/// A leaf has two sides if their areas differ by less than this share.
constexpr double kSameArea = 0.01;
/// Outlines are compared in this many steps to a side of their largest face.
constexpr double kOutlineSteps = 4096;

/// The faces that represent a leaf: only its front if it has a back of the same area.
std::vector<std::size_t> faces_of_one_side(const LeafMesh& leaf, const Eigen::Vector3d& normal) {
  double front = 0, back = 0;
  for (const Eigen::Vector3d& area : leaf.areas) {
    (area.dot(normal) > 0 ? front : back) += area.norm();
  }
  const bool doubled = std::abs(front - back) <= kSameArea * front;
  std::vector<std::size_t> faces;
  faces.reserve(leaf.faces.size());
  for (std::size_t face = 0; face < leaf.faces.size(); ++face) {
    if (leaf.areas[face].isZero(0)) continue;
    if (!doubled || leaf.areas[face].dot(normal) > 0) faces.push_back(face);
  }
  return faces;
}

/// A chart's own coordinates in a leaf: where they begin and their two axes.
struct Axes {
  Eigen::Vector3d origin, across, along;
};

/// Takes two sides of the largest face as axes, so that similar leaves get similar coordinates
/// however they are turned.
Axes axes_of_faces(const LeafMesh& leaf, std::span<const std::size_t> faces) {
  constexpr double kClearlyLarger = 1 + 1e-5;
  std::size_t largest = faces.front();
  for (const std::size_t face : faces) {
    if (leaf.areas[face].norm() > kClearlyLarger * leaf.areas[largest].norm()) largest = face;
  }
  const auto [a, b, c] = leaf.triangles[largest];
  return {leaf.points[a], leaf.points[b] - leaf.points[a], leaf.points[c] - leaf.points[a]};
}

/// The coordinates of a point along both axes; its distance from their plane does not count.
Vec2d in_plane(const Axes& axes, const Eigen::Vector3d& point) {
  const Eigen::Vector3d normal = axes.across.cross(axes.along);
  const Eigen::Vector3d offset = point - axes.origin;
  const auto rounded = [&](const Eigen::Vector3d& perpendicular) {
    return std::round(offset.dot(perpendicular) / normal.squaredNorm() * kOutlineSteps) /
           kOutlineSteps;
  };
  return {rounded(axes.along.cross(normal)), rounded(normal.cross(axes.across))};
}

auto sheet_key(const LeafSheet& s) {
  return std::tuple(s.area, s.normal.x, s.normal.y, s.normal.z, s.major.x, s.major.y, s.major.z,
                    s.radius_major, s.radius_minor, s.origin.x, s.origin.y, s.origin.z, s.across.x,
                    s.across.y, s.across.z, s.along.x, s.along.y, s.along.z, s.piece);
}

}  // namespace

std::uint32_t SheetCollector::chart_of(Triangles triangles,
                                       const std::shared_ptr<AlphaMask>& mask) {
  std::vector<double> key;
  key.reserve(6 * triangles.size());
  for (const auto& triangle : triangles) {
    for (const Vec2d p : triangle) key.insert(key.end(), {p.x, p.y});
  }
  const auto number = static_cast<std::uint32_t>(sheets_->charts.size());
  const auto [entry, is_new] = charts_.try_emplace({mask.get(), std::move(key)}, number);
  if (!is_new) return entry->second;
  const auto seen = known_ ? known_->charts_.find(entry->first) : charts_.end();
  const bool is_seen = known_ && seen != known_->charts_.end();
  sheets_->charts.push_back(is_seen ? known_->sheets_->charts[seen->second]
                                    : chart(std::move(triangles), mask));
  return number;
}

LeafChart SheetCollector::chart(Triangles triangles, const std::shared_ptr<AlphaMask>& mask) const {
  LeafChart chart{std::move(triangles), mask, {}, {}};
  double sum = 0;
  for (const auto& [a, b, c] : chart.triangles) {
    const Vec2d middle{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
    const KeptPart kept = mask ? mask->kept_part({a, b, c}) : KeptPart{1, middle};
    chart.visible.push_back(kept.share);
    const double area =
        kept.share * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
    chart.centre.x += area * kept.centre.x;
    chart.centre.y += area * kept.centre.y;
    sum += area;
  }
  chart.centre = sum > 0 ? Vec2d{chart.centre.x / sum, chart.centre.y / sum} : Vec2d{};
  return chart;
}

void SheetCollector::take(const LeafMesh& leaf, const LeafEllipse& ellipse,
                          const TextureSource& texture, const Eigen::Vector3d& first, double scale,
                          bool piece) {
  const std::vector<std::size_t> faces = faces_of_one_side(leaf, ellipse.normal);
  if (faces.empty()) return;
  const bool textured = ellipse.map && texture.mask;
  const Axes axes =
      textured ? Axes{ellipse.map->origin, ellipse.map->linear.col(0), ellipse.map->linear.col(1)}
               : axes_of_faces(leaf, faces);
  Triangles triangles;
  triangles.reserve(faces.size());
  for (const std::size_t face : faces) {
    std::array<Vec2d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      if (textured) {
        const Vec2f uv = texture.uvs[leaf.faces[face].vertex[i]];
        corners[i] = {static_cast<double>(uv.x), static_cast<double>(uv.y)};
      } else {
        corners[i] = in_plane(axes, leaf.points[leaf.triangles[face][i]]);
      }
    }
    triangles.push_back(corners);
  }
  const std::uint32_t number = chart_of(std::move(triangles), textured ? texture.mask : nullptr);
  const LeafChart& chart = sheets_->charts[number];
  double area = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    area += chart.visible[i] * leaf.areas[faces[i]].norm();
  }
  if (!(area > 0)) {
    ++sheets_->invisible;
    return;
  }
  const Eigen::Vector3d& normal = ellipse.normal;
  const Eigen::Vector3d major = ellipse.major - normal * normal.dot(ellipse.major);
  sheets_->sheets.push_back({to_vec3d(first + axes.origin), to_vec3d(axes.across),
                             to_vec3d(axes.along), area, number, to_vec3f(normal),
                             to_vec3f(major.normalized()),
                             static_cast<float>(scale * ellipse.major.norm()),
                             static_cast<float>(scale * ellipse.minor.norm()), piece, solid_});
}

void SheetCollector::begin_solid(std::span<const EigenTriangle> closed,
                                 const Eigen::Vector3d& first) {
  LeafSolid solid;
  double sixfold = 0;
  for (const auto& [a, b, c] : closed) {
    solid.triangles.push_back({to_vec3d(first + a), to_vec3d(first + b), to_vec3d(first + c)});
    solid.surface += (b - a).cross(c - a).norm() / 2;
    sixfold += a.dot(b.cross(c));
  }
  solid.volume = std::abs(sixfold) / 6;
  solid_ = static_cast<std::int32_t>(sheets_->solids.size());
  sheets_->solids.push_back(std::move(solid));
}

void SheetCollector::append(SheetCollector&& next) {
  LeafSet::Sheets& other = *next.sheets_;
  std::vector<Charts::iterator> known(other.charts.size());
  for (auto chart = next.charts_.begin(); chart != next.charts_.end(); ++chart) {
    known[chart->second] = chart;
  }
  std::vector<std::uint32_t> number(other.charts.size());  // its new number, by its old one
  for (std::size_t i = 0; i < number.size(); ++i) {
    auto node = next.charts_.extract(known[i]);
    node.mapped() = static_cast<std::uint32_t>(sheets_->charts.size());
    const auto placed = charts_.insert(std::move(node));
    if (placed.inserted) sheets_->charts.push_back(std::move(other.charts[i]));
    number[i] = placed.position->second;
  }
  const auto solids = static_cast<std::int32_t>(sheets_->solids.size());
  for (LeafSheet& sheet : other.sheets) {
    sheet.chart = number[sheet.chart];
    if (sheet.solid >= 0) sheet.solid += solids;
  }
  sheets_->sheets.insert(sheets_->sheets.end(), other.sheets.begin(), other.sheets.end());
  std::ranges::move(other.solids, std::back_inserter(sheets_->solids));
  sheets_->invisible += other.invisible;
}

/// Gives the solids their areas and an order that depends on the geometry alone, and removes those
/// without area.
void SheetCollector::sort_solids() {
  std::vector<LeafSolid>& solids = sheets_->solids;
  // Sheets are sorted, so the first sheet of each solid gives its place.
  std::vector<std::int32_t> place(solids.size(), -1);
  std::vector<LeafSolid> sorted;
  for (LeafSheet& sheet : sheets_->sheets) {
    if (sheet.solid < 0) continue;
    std::int32_t& at = place[static_cast<std::size_t>(sheet.solid)];
    if (at < 0) {
      at = static_cast<std::int32_t>(sorted.size());
      sorted.push_back(std::move(solids[static_cast<std::size_t>(sheet.solid)]));
    }
    sheet.solid = at;
    sorted[static_cast<std::size_t>(at)].area += sheet.area;
  }
  solids = std::move(sorted);
}

std::shared_ptr<const LeafSet::Sheets> SheetCollector::finish(const Box& crown) {
  std::vector<LeafSheet>& sheets = sheets_->sheets;
  const auto code = [&](std::uint32_t i) {
    return morton_code(sheets[i].at(sheets_->charts[sheets[i].chart].centre), crown);
  };
  put_in_order(sheets, order_by_code(sheets.size(), code, [&](std::uint32_t a, std::uint32_t b) {
                 return sheet_key(sheets[a]) < sheet_key(sheets[b]);
               }));
  for (const LeafSheet& sheet : sheets) sheets_->area += sheet.area;
  sort_solids();
  charts_.clear();
  return std::move(sheets_);
}

}  // namespace leafhull
