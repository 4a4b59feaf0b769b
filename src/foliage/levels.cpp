// SPDX-License-Identifier: Apache-2.0
#include "foliage/levels.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "foliage/names.h"

namespace leafhull {
namespace {

constexpr int kBillboard = 1000;

/// What a name says about levels of detail: the thing and its level.
struct LevelName {
  std::string stem;  ///< before the word, folded
  int level = 0;
};

std::optional<LevelName> level_in(std::string_view name) {
  const std::string text = folded(name);
  const auto stem = [&](std::size_t end) {
    std::string before = text.substr(0, end);
    while (!before.empty() && before.back() == ' ') before.pop_back();
    return before;
  };
  for (const std::string_view word : {"billboard", "imposter", "impostor"}) {
    if (const auto at = text.find(word); at != text.npos) {
      const std::optional<LevelName> numbered = level_in(stem(at));
      return LevelName{numbered ? numbered->stem : stem(at), kBillboard};
    }
  }
  for (auto at = text.find("lod"); at != text.npos; at = text.find("lod", at + 1)) {
    if (at > 0 && text[at - 1] != ' ') continue;
    std::size_t digit = at + 3;
    while (digit < text.size() && text[digit] == ' ') ++digit;
    int level = 0;
    const char* end = text.data() + text.size();
    if (std::from_chars(text.data() + digit, end, level).ec != std::errc()) continue;
    return LevelName{stem(at), level};
  }
  return std::nullopt;
}

/// Levels of the same thing have one stem; levels without a stem belong together if they share a
/// parent node.
using Family = std::pair<int, std::string>;

/// The family of nodes that a finer node lists with MSFT_lod.
const Family kListed{-2, "MSFT_lod"};

struct Place {
  Family family;
  int level = 0;
  std::string_view name;  ///< the name that gave the level
};

/// Finds the nearest name at or above an instance that gives a level, reading each node once.
class PlaceFinder {
 public:
  explicit PlaceFinder(const TreeModel& tree) : tree_(tree), known_(tree.nodes.size()) {}

  std::optional<Place> of(const Instance& instance) {
    std::optional<Place> place;
    if (instance.node < 0 && !instance.node_name.empty()) {
      place = told(instance.node_name, -1, 0);
    } else {
      place = of_node(instance.node);
    }
    if (place) return place;
    return told(tree_.primitives[instance.primitive].mesh_name, -1, 0);
  }

 private:
  static std::optional<Place> told(std::string_view name, int parent, int level) {
    const std::optional<LevelName> found = level_in(name);
    if (level > 0) return Place{kListed, level, name};
    if (!found) return std::nullopt;
    return Place{{found->stem.empty() ? parent : -1, found->stem}, found->level, name};
  }

  std::optional<Place> of_node(int node) {
    std::vector<int> path;
    std::optional<Place> place;
    for (; node >= 0 && static_cast<std::size_t>(node) < known_.size();
         node = tree_.nodes[node].parent) {
      if (known_[node].is_known) {
        place = known_[node].place;
        break;
      }
      path.push_back(node);
      if (path.size() > known_.size()) break;  // a cycle, which has no place in a scene
    }
    std::ranges::reverse(path);
    for (const int at : path) {
      const TreeNode& here = tree_.nodes[at];
      if (const auto own = told(here.name, here.parent, here.level)) place = own;
      known_[at] = {true, place};
    }
    return place;
  }

  struct Known {
    bool is_known = false;
    std::optional<Place> place;
  };
  const TreeModel& tree_;
  std::vector<Known> known_;
};

/// Whether things named billboards are such: few triangles beside a tree of many. Cards of leaves
/// are called billboards too.
bool has_billboard_of_others(const TreeModel& tree, std::span<const Instance> instances,
                             const std::vector<std::optional<Place>>& places,
                             const std::vector<bool>& looked_at) {
  std::size_t billboards = 0, others = 0;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (!looked_at[i]) continue;
    const bool is_billboard = places[i] && places[i]->level == kBillboard;
    (is_billboard ? billboards : others) +=
        tree.primitives[instances[i].primitive].triangles.size();
  }
  return billboards > 0 && others > 16 * billboards;
}

}  // namespace

Levels find_levels(const TreeModel& tree, std::span<const Instance> instances,
                   const std::vector<bool>& looked_at) {
  PlaceFinder finder(tree);
  std::vector<std::optional<Place>> places;
  places.reserve(instances.size());
  std::map<Family, std::set<int>> levels;
  std::map<Family, std::string_view> finest;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    places.push_back(looked_at[i] ? finder.of(instances[i]) : std::nullopt);
    if (!places.back()) continue;
    const Place& place = *places.back();
    if (place.family == kListed) {
      levels[kListed].insert(0);
      finest[kListed] = kListed.second;
    }
    const std::set<int>& known = levels[place.family];
    const bool is_finest = known.empty() || place.level < *known.begin();
    if (is_finest) finest[place.family] = place.name;
    levels[place.family].insert(place.level);
  }
  // Oak beside Oak_LOD1: the thing named by the plain stem is the finest.
  std::map<std::string, Family> plain;
  for (const auto& [family, found] : levels) {
    if (family.first < 0 && !family.second.empty() && *found.begin() > 0) {
      plain.emplace(family.second, family);
    }
  }
  if (!plain.empty()) {
    for (std::size_t i = 0; i < instances.size(); ++i) {
      if (places[i] || !looked_at[i]) continue;
      for (const std::string* name :
           {&instances[i].node_name, &tree.primitives[instances[i].primitive].mesh_name}) {
        const auto family = plain.find(folded(*name));
        if (family == plain.end()) continue;
        places[i] = Place{family->second, 0, *name};
        levels[family->second].insert(0);
        finest[family->second] = *name;
        break;
      }
    }
  }
  const bool stands_for_others = has_billboard_of_others(tree, instances, places, looked_at);
  Levels result;
  result.coarser.resize(instances.size());
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (!places[i]) continue;
    const bool is_billboard = places[i]->level == kBillboard && stands_for_others;
    if (!is_billboard && places[i]->level == *levels[places[i]->family].begin()) continue;
    result.coarser[i] = true;
    ++result.passed_over;
  }
  for (const auto& [family, found] : levels) {
    if (found.size() > 1) result.kept.emplace_back(finest[family]);
  }
  return result;
}

}  // namespace leafhull
