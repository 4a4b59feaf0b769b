// SPDX-License-Identifier: Apache-2.0
#include "foliage/asked.h"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "colour/colour.h"
#include "foliage/surface_colour.h"

namespace leafhull {
namespace {

constexpr std::size_t kLooks = 400'000;

bool fits(const std::string& glob, const std::string& name) {
  return fnmatch(glob.c_str(), name.c_str(), FNM_CASEFOLD | FNM_NOESCAPE) == 0;
}

/// Names of an instance, and the nodes that it hangs from.
class Names {
 public:
  Names(const TreeModel& tree, const Instance& instance) : tree_(tree), instance_(instance) {
    const Primitive& primitive = tree.primitives[instance.primitive];
    if (primitive.material >= 0) names_[0] = &tree.materials[primitive.material].name;
    names_[1] = &primitive.mesh_name;
    names_[2] = &instance.node_name;
  }

  bool match(const std::string& glob) const {
    const auto names_it = [&](const std::string& last, const std::string* name) {
      return fits(last, name ? *name : std::string());
    };
    for (const std::string* name : names_) {
      if (names_it(glob, name)) return true;
    }
    const auto slash = glob.rfind('/');
    if (slash == glob.npos) return false;
    const std::string last = glob.substr(slash + 1), above = glob.substr(0, slash);
    const int node = instance_.node;
    if ((names_it(last, names_[0]) || names_it(last, names_[1])) && hangs_from(node, above)) {
      return true;
    }
    return node >= 0 && names_it(last, names_[2]) && hangs_from(tree_.nodes[node].parent, above);
  }

 private:
  /// Whether `node` or an ancestor fits the last part of a path, and its ancestors the rest.
  bool hangs_from(int node, const std::string& path) const {
    const auto slash = path.rfind('/');
    const std::string last = slash == path.npos ? path : path.substr(slash + 1);
    std::size_t steps = 0;
    for (; node >= 0 && steps <= tree_.nodes.size(); node = tree_.nodes[node].parent, ++steps) {
      if (!fits(last, tree_.nodes[node].name)) continue;
      // The lowest node that fits leaves the most ancestors for the rest.
      return slash == path.npos || hangs_from(tree_.nodes[node].parent, path.substr(0, slash));
    }
    return false;
  }

  const TreeModel& tree_;
  const Instance& instance_;
  std::array<const std::string*, 3> names_{};  ///< material, mesh, node
};

/// The threshold that best parts distances, weighted by area, into two classes: the variance
/// between these is largest.
/// Source: Otsu, "A threshold selection method from gray-level histograms", 1979.
double parting(std::vector<std::pair<double, double>> distances) {
  std::ranges::sort(distances);
  double weight = 0, sum = 0;
  for (const auto& [distance, area] : distances) {
    weight += area;
    sum += area * distance;
  }
  double below = 0, sum_below = 0, best = 0, where = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < distances.size(); ++i) {
    below += distances[i].second;
    sum_below += distances[i].second * distances[i].first;
    const double above = weight - below;
    const bool parts = below > 0 && above > 0;
    if (!parts) continue;
    const double apart = sum_below / below - (sum - sum_below) / above;
    const double variance = below * above * apart * apart;
    if (variance > best) {
      best = variance;
      where = (distances[i].first + distances[i + 1].first) / 2;
    }
  }
  return where;
}

double area_of(const Primitive& primitive, std::size_t triangle) {
  const auto [a, b, c] = primitive.triangles[triangle];
  const Vec3d p(primitive.positions[a]), q(primitive.positions[b]), r(primitive.positions[c]);
  return length(cross(q - p, r - p)) / 2;
}

}  // namespace

Asked::Asked(const TreeModel& tree, std::span<const Instance> instances, const LeafOptions& options)
    : tree_(tree), options_(options), candidates_(instances.size(), true) {
  std::vector<bool> used(options.globs.size() + options.not_globs.size());
  if (used.empty()) return;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Names names(tree, instances[i]);
    bool named = options.globs.empty(), excluded = false;
    for (std::size_t g = 0; g < options.globs.size(); ++g) {
      if (!names.match(options.globs[g])) continue;
      named = used[g] = true;
    }
    for (std::size_t g = 0; g < options.not_globs.size(); ++g) {
      if (!names.match(options.not_globs[g])) continue;
      excluded = used[options.globs.size() + g] = true;
    }
    candidates_[i] = named && !excluded;
  }
  for (std::size_t g = 0; g < used.size(); ++g) {
    if (used[g]) continue;
    const bool is_leaves = g < options.globs.size();
    unused_.push_back((is_leaves ? "--leaves " : "--not-leaves ") +
                      (is_leaves ? options.globs[g] : options.not_globs[g - options.globs.size()]));
  }
}

void Asked::choose(const Levels& levels, Candidates& candidates, LeafChoice& choice) const {
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    choice.instances[i] = candidates_[i] && !levels.coarser[i];
  }
  choice.triangles.resize(tree_.primitives.size());
  if (options_.colour) choose_by_colour(candidates, choice);
  for (Candidate& candidate : candidates.list) {
    bool any = choice.instances[candidate.instances.front()];
    const auto& triangles = choice.triangles[candidate.primitive];
    if (any && !triangles.empty()) {
      const auto& part_of = candidates.part_of[candidate.primitive];
      std::size_t taken = 0;
      for (std::size_t t = 0; t < triangles.size(); ++t) {
        const bool is_here = part_of.empty() || part_of[t] == candidate.part;
        if (is_here && triangles[t]) ++taken;
      }
      any = 2 * taken > candidate.told.triangles;
    }
    candidate.told.verdict = any ? LeafVerdict::leaves : LeafVerdict::not_asked_for;
  }
}

void Asked::choose_by_colour(const Candidates& candidates, LeafChoice& choice) const {
  const Vec3d wanted = oklab_of(linear_of_srgb(options_.colour->srgb));
  std::map<std::uint32_t, std::vector<double>> distances;
  std::vector<std::pair<double, double>> weighted;
  for (const Candidate& candidate : candidates.list) {
    if (!choice.instances[candidate.instances.front()] || distances.contains(candidate.primitive)) {
      continue;
    }
    const Primitive& primitive = tree_.primitives[candidate.primitive];
    const SurfaceColour colour(tree_, primitive, kLooks);
    std::vector<double>& of = distances[candidate.primitive];
    for (std::size_t t = 0; t < primitive.triangles.size(); ++t) {
      of.push_back(length(oklab_of(colour.of(t).colour) - wanted));
      weighted.emplace_back(of.back(), area_of(primitive, t));
    }
  }
  const double tolerance =
      options_.colour->tolerance > 0 ? options_.colour->tolerance : parting(std::move(weighted));
  for (const auto& [primitive, of] : distances) {
    std::vector<bool>& triangles = choice.triangles[primitive];
    for (const double distance : of) triangles.push_back(distance <= tolerance);
  }
  std::vector<bool> is_empty(tree_.primitives.size());
  for (const auto& [primitive, of] : distances) {
    const auto& triangles = choice.triangles[primitive];
    is_empty[primitive] = std::ranges::find(triangles, true) == triangles.end();
  }
  for (const Candidate& candidate : candidates.list) {
    if (!is_empty[candidate.primitive]) continue;
    for (const std::uint32_t i : candidate.instances) choice.instances[i] = false;
  }
  for (auto& triangles : choice.triangles) {
    if (std::ranges::find(triangles, false) == triangles.end()) triangles.clear();
  }
}

void Asked::warn_of_unused(std::vector<std::string>& warnings) const {
  for (const std::string& option : unused_) {
    warnings.push_back(option + " matches no material, mesh, node or path");
  }
}

}  // namespace leafhull
