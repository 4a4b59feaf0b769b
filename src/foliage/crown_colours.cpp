// SPDX-License-Identifier: Apache-2.0
#include "foliage/crown_colours.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "colour/colour.h"
#include "foliage/appearance.h"
#include "foliage/surface_colour.h"

namespace leafhull {
namespace {

constexpr std::size_t kLooksAtImage = 200'000;  // samples of the image per primitive
constexpr double kMostNodes = 64;               // along an axis
constexpr int kMostPlaces = 16;                 // along a triangle's side
constexpr std::size_t kMostTones = 4;
/// Colours closer than this in Oklab's plane of hues count as one tone.
constexpr double kOneTone = 0.05;
/// A tone has at least this share of the leaves.
constexpr double kLeastShare = 0.03;
constexpr int kRounds = 8;  // of Lloyd's method

/// The distance of two colours in hue and chroma; lightness does not count.
double hue_distance(Vec3d a, Vec3d b) { return std::hypot(a.y - b.y, a.z - b.z); }

struct Weighed {
  Vec3d lab;
  double area;
};

std::size_t nearest(const std::vector<Weighed>& tones, Vec3d lab) {
  const auto best = std::ranges::min_element(
      tones, {}, [&](const Weighed& tone) { return hue_distance(tone.lab, lab); });
  return static_cast<std::size_t>(best - tones.begin());
}

/// One round of Lloyd's method.
void settle(const std::vector<Weighed>& colours, std::vector<Weighed>& tones) {
  std::vector<Weighed> sums(tones.size());
  for (const Weighed& colour : colours) {
    Weighed& sum = sums[nearest(tones, colour.lab)];
    sum.lab = sum.lab + colour.lab * colour.area;
    sum.area += colour.area;
  }
  for (std::size_t i = 0; i < tones.size(); ++i) {
    tones[i].area = sums[i].area;
    if (sums[i].area > 0) tones[i].lab = sums[i].lab / sums[i].area;
  }
}

}  // namespace

CrownColours::CrownColours(const Box& crown, double mass)
    : low_(crown.low), cell_(std::max(mass, crown.longest_side() / kMostNodes)) {
  const Vec3d size = crown.size();
  // Two extra nodes on either side, for the reach of `spread` and `around`.
  const auto count = [&](double side) { return static_cast<std::size_t>(side / cell_) + 6; };
  size_ = {count(size.x), count(size.y), count(size.z)};
  nodes_.resize(size_[0] * size_[1] * size_[2]);
}

template <class Use>
void CrownColours::around(Vec3d place, Use&& use) const {
  const std::array<double, 3> p{(place.x - low_.x) / cell_ + 2, (place.y - low_.y) / cell_ + 2,
                                (place.z - low_.z) / cell_ + 2};
  std::array<std::size_t, 3> first{};
  std::array<double, 3> part{};
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_inside = p[axis] >= 0 && p[axis] < static_cast<double>(size_[axis] - 1);
    if (!is_inside) return;
    first[axis] = static_cast<std::size_t>(p[axis]);
    part[axis] = p[axis] - static_cast<double>(first[axis]);
  }
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::size_t node = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
      const std::size_t far = corner >> axis & 1;
      weight *= far ? part[axis] : 1 - part[axis];
      node = node * size_[axis] + first[axis] + far;
    }
    use(node, weight);
  }
}

void CrownColours::put(Vec3d place, Vec3f colour, double area) {
  around(place, [&](std::size_t node, double weight) {
    nodes_[node].sum = nodes_[node].sum + Vec3d(colour) * (weight * area);
    nodes_[node].area += weight * area;
  });
}

/// Puts a triangle's colour at places no farther apart than half a cell.
void CrownColours::put_triangle(const std::array<Vec3d, 3>& corners, Vec3f colour, double kept) {
  const auto& [a, b, c] = corners;
  const Vec3d u = b - a, v = c - a;
  const double area = length(cross(u, v)) / 2 * kept;
  const double side = std::max({length(u), length(v), length(c - b)});
  if (!(area > 0) || !std::isfinite(side)) return;
  const int n = std::clamp(static_cast<int>(std::ceil(2 * side / cell_)), 1, kMostPlaces);
  const double each = area / (n * n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < 2 * (n - i) - 1; ++j) {
      const double third = j % 2 == 0 ? 1 / 3.0 : 2 / 3.0;
      const int half = j / 2;
      put(a + u * ((i + third) / n) + v * ((half + third) / n), colour, each);
    }
  }
}

/// Mixes a quarter of either neighbour into each node, along each axis.
void CrownColours::spread() {
  std::size_t step = 1;
  for (const std::size_t size : size_) {
    std::vector<Heap> spread(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const std::size_t at = i / step % size;
      const auto add = [&](std::size_t from, double weight) {
        spread[i].sum = spread[i].sum + nodes_[from].sum * weight;
        spread[i].area += nodes_[from].area * weight;
      };
      add(i, 0.5);
      if (at > 0) add(i - step, 0.25);
      if (at + 1 < size) add(i + step, 0.25);
    }
    nodes_ = std::move(spread);
    step *= size;
  }
}

void CrownColours::tell_tones() {
  std::vector<Weighed> colours;
  Vec3d mean;
  double area = 0;
  for (const Heap& node : nodes_) {
    if (!(node.area > 0)) continue;
    colours.push_back({oklab_of(Vec3f(node.sum / node.area)), node.area});
    mean = mean + node.sum;
    area += node.area;
  }
  if (!(area > 0)) return;
  mean_ = Vec3f(mean / area);
  std::vector<Weighed> tones{{oklab_of(mean_), area}};
  while (tones.size() < kMostTones) {
    const auto strangeness = [&](const Weighed& colour) {
      const double distance = hue_distance(colour.lab, tones[nearest(tones, colour.lab)].lab);
      return distance < kOneTone ? 0 : distance * distance * colour.area;
    };
    const auto strangest = std::ranges::max_element(colours, {}, strangeness);
    if (!(strangeness(*strangest) > 0)) break;
    std::vector<Weighed> more = tones;
    more.push_back(*strangest);
    for (int i = 0; i < kRounds; ++i) settle(colours, more);
    if (std::ranges::any_of(more, [&](const Weighed& t) { return t.area < kLeastShare * area; })) {
      break;
    }
    tones = std::move(more);
  }
  std::ranges::stable_sort(tones,
                           [](const Weighed& a, const Weighed& b) { return a.area > b.area; });
  for (const Weighed& tone : tones) tones_.push_back(shown_oklab(tone.lab));
}

std::optional<CrownColours> CrownColours::of(const TreeModel& tree, const LeafSet& leaves,
                                             double mass) {
  const LeafChoice& choice = *leaves.choice;
  if (!leaves.colour || choice.is_tinted || !(leaves.crown.longest_side() > 0)) return std::nullopt;
  CrownColours colours(leaves.crown, mass);
  std::map<std::uint32_t, std::vector<Shown>> known;  // by primitive
  for (std::size_t i = 0; i < tree.instances.size(); ++i) {
    if (!choice.instances[i]) continue;
    const Instance& instance = tree.instances[i];
    const Primitive& primitive = tree.primitives[instance.primitive];
    const std::vector<bool>& is_leaf = choice.triangles[instance.primitive];
    const auto [shown, is_new] = known.try_emplace(instance.primitive);
    const SurfaceColour colour(tree, primitive, kLooksAtImage);
    if (!colour.is_known()) continue;
    for (std::size_t t = 0; t < primitive.triangles.size(); ++t) {
      if (is_new) {
        shown->second.push_back(colour.varies() || t == 0 ? colour.of(t) : shown->second.front());
      }
      if (!is_leaf.empty() && !is_leaf[t]) continue;
      std::array<Vec3d, 3> corners;
      for (int k = 0; k < 3; ++k) {
        const Vec3f p = primitive.positions[primitive.triangles[t][k]];
        corners[k] = transformed(instance.to_world, Vec3d(p));
      }
      colours.put_triangle(corners, shown->second[t].colour, shown->second[t].kept);
    }
  }
  colours.spread();
  colours.tell_tones();
  if (colours.tones_.size() < 2) return std::nullopt;
  return colours;
}

Vec3f CrownColours::at(Vec3d place) const {
  Heap here;
  around(place, [&](std::size_t node, double weight) {
    here.sum = here.sum + nodes_[node].sum * weight;
    here.area += nodes_[node].area * weight;
  });
  return here.area > 0 ? Vec3f(here.sum / here.area) : mean_;
}

}  // namespace leafhull
