// SPDX-License-Identifier: Apache-2.0
#include "points/join.h"

#include <tbb/parallel_sort.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <vector>

#include "points/ellipse_of.h"
#include "points/leaf_points.h"

namespace leafhull {
namespace {

/// A part of less area, in spacing^2, is joined to its neighbours.
constexpr double kSmall = 0.25;
/// A cell with more area, in spacing^2, is full unless it has at most kPartsOfASheet parts: a flat
/// sheet whose parts lie in the cell's corners has as many there, and joined they would show.
constexpr double kFull = 3;
constexpr std::ptrdiff_t kPartsOfASheet = 4;

struct Entry {
  std::array<std::int64_t, 3> cell;
  std::uint32_t part;
  auto operator<=>(const Entry&) const = default;
};

Eigen::Vector3d to_eigen(const Vec3f& v) { return Eigen::Vector3f(v.x, v.y, v.z).cast<double>(); }

/// The sums of some parts' area, first and second moments, and directions.
class Sum {
 public:
  /// `origin` should lie near the parts.
  explicit Sum(Vec3d origin) : origin_(origin) {}

  void add(const LeafPoint& part) {
    const Vec3d offset = part.position - origin_;
    const Eigen::Vector3d d(offset.x, offset.y, offset.z);
    const Eigen::Vector3d n = to_eigen(part.normal), u = to_eigen(part.major), v = n.cross(u);
    const double ru = part.radius_major, rv = part.radius_minor;
    area_ += part.area;
    first_ += part.area * d;
    second_ += part.area * (d * d.transpose() + ru * ru / 4 * u * u.transpose() +
                            rv * rv / 4 * v * v.transpose());
    normals_ += part.area * n * n.transpose();
    last_ = &part;
    ++count_;
  }
  void append_to(std::vector<LeafPoint>& points, double least_radius) const {
    if (count_ == 0) return;
    if (count_ == 1) return points.push_back(*last_);
    const Eigen::Vector3d mean = first_ / area_;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> directions(normals_);
    points.push_back(ellipse_of(origin_ + Vec3d(mean.x(), mean.y(), mean.z()), area_,
                                directions.eigenvectors().col(2),
                                second_ / area_ - mean * mean.transpose(), least_radius));
  }

 private:
  Vec3d origin_;
  double area_ = 0;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero(), normals_ = Eigen::Matrix3d::Zero();
  const LeafPoint* last_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace

std::vector<LeafPoint> join_in_cells(std::vector<LeafPoint> parts, double spacing) {
  std::vector<Entry> entries;
  entries.reserve(parts.size());
  const auto cell = [spacing](double v) { return std::llround(std::floor(v / spacing)); };
  for (const LeafPoint& part : parts) {
    const Vec3d p = part.position;
    entries.push_back(
        {{cell(p.x), cell(p.y), cell(p.z)}, static_cast<std::uint32_t>(entries.size())});
  }
  tbb::parallel_sort(entries);

  const double square = spacing * spacing;
  std::vector<LeafPoint> joined;
  joined.reserve(parts.size());
  for (auto begin = entries.begin(); begin != entries.end();) {
    double area = 0;
    auto end = begin;
    for (; end != entries.end() && end->cell == begin->cell; ++end) area += parts[end->part].area;
    const bool full = area > kFull * square && end - begin > kPartsOfASheet;
    const double most = full ? HUGE_VAL : kSmall * square;
    Sum sum(parts[begin->part].position);
    for (; begin != end; ++begin) {
      const LeafPoint& part = parts[begin->part];
      if (part.area < most) {
        sum.add(part);
      } else {
        joined.push_back(part);
      }
    }
    sum.append_to(joined, kLeastRadius * spacing);
  }
  return joined;
}

}  // namespace leafhull
