// SPDX-License-Identifier: Apache-2.0
#include "foliage/kinds.h"

#include <algorithm>
#include <array>
#include <ranges>
#include <string>
#include <vector>

#include "foliage/names.h"

namespace leafhull {
namespace {

struct KindWord {
  std::string_view text;  ///< folded
  LeafKind kind;
  bool alone = false;  ///< must stand alone: short words occur in others by chance
};

using enum LeafKind;

// A word that contains another one comes before it. Sources: dictionaries.
constexpr auto kKindWords = std::to_array<KindWord>({
    {"pineapple", broad},   {"oak", broad, true},    {"oaks", broad, true},
    {"maple", broad},       {"palmat", broad},  // Acer palmatum
    {"birch", broad},       {"prickly pear", broad}, {"coconut", frond},
    {"palm", frond},  // and palme, palmera, palmeira, palmier, palma
    {"frond", frond},       {"пальм", frond},        {"椰", frond},
    {"棕榈", frond},        {"ヤシ", frond},         {"야자", frond},
    {"needle", needle},     {"conifer", needle},     {"evergreen", needle},
    {"pine", needle},       {"fir", needle, true},   {"firs", needle, true},
    {"spruce", needle},     {"larch", needle},       {"cedar", needle},
    {"cypress", needle},    {"juniper", needle},     {"hemlock", needle},
    {"sequoia", needle},    {"redwood", needle},     {"yew", needle, true},
    {"christmas", needle},  {"xmas", needle},        {"nadel", needle},
    {"fichte", needle},     {"tanne", needle},       {"kiefer", needle},
    {"larche", needle},     {"laerche", needle},     {"naalden", needle},
    {"spar", needle, true}, {"aiguille", needle},    {"sapin", needle},
    {"epicea", needle},     {"pin", needle, true},   {"aguja", needle},
    {"pino", needle, true}, {"abeto", needle},       {"agulha", needle},
    {"pinheiro", needle},   {"aghi", needle, true},  {"abete", needle},
    {"sosna", needle},      {"swierk", needle},      {"kuusi", needle},
    {"neulas", needle},     {"хво", needle},         {"сосн", needle},
    {"ель", needle, true},  {"елка", needle, true},  {"елки", needle, true},
    {"松", needle},         {"杉", needle},          {"소나무", needle},
    {"broadleaf", broad},
});

bool holds(std::string_view text, const KindWord& word) {
  for (auto at = text.find(word.text); at != text.npos; at = text.find(word.text, at + 1)) {
    const std::size_t end = at + word.text.size();
    const bool is_alone =
        (at == 0 || text[at - 1] == ' ') && (end == text.size() || text[end] == ' ');
    if (is_alone || !word.alone) return true;
  }
  return false;
}

/// What the names of nodes and of those above them tell. Each name is read once.
class NodeKinds {
 public:
  explicit NodeKinds(const TreeModel& tree)
      : tree_(tree), is_known_(tree.nodes.size()), kinds_(tree.nodes.size()) {}

  /// What the nearest name tells, from the node upwards.
  std::optional<LeafKind> above(int node) {
    std::vector<int> unknown;
    for (; node >= 0 && !is_known_[node]; node = tree_.nodes[node].parent) {
      is_known_[node] = true;
      unknown.push_back(node);
    }
    std::optional<LeafKind> kind = node < 0 ? std::nullopt : kinds_[node];
    for (const int n : unknown | std::views::reverse) {
      if (const auto own = read_kind(tree_.nodes[n].name)) kind = own;
      kinds_[n] = kind;
    }
    return kind;
  }

 private:
  const TreeModel& tree_;
  std::vector<bool> is_known_;
  std::vector<std::optional<LeafKind>> kinds_;
};

}  // namespace

std::optional<LeafKind> read_kind(std::string_view name) {
  const std::string text = folded(name);
  for (const KindWord& word : kKindWords) {
    if (holds(text, word)) return word.kind;
  }
  return std::nullopt;
}

LeafKind kind_of(const TreeModel& tree, std::span<const Instance> instances,
                 const std::vector<Candidate>& candidates) {
  const LeafKind of_file = read_kind(tree.path.stem().string()).value_or(broad);
  NodeKinds nodes(tree);
  std::array<double, 3> areas{};
  for (const Candidate& candidate : candidates) {
    if (candidate.told.verdict != LeafVerdict::leaves) continue;
    const LeafCandidate& told = candidate.told;
    const int material = tree.primitives[candidate.primitive].material;
    const int image = material < 0 ? -1 : tree.materials[material].base_color_image;
    std::optional<LeafKind> kind;
    for (const std::string& name :
         {told.material, image < 0 ? std::string() : tree.images[image].name, told.mesh,
          told.node}) {
      if (!kind) kind = read_kind(name);
    }
    if (!kind) kind = nodes.above(instances[candidate.instances.front()].node);
    areas[static_cast<std::size_t>(kind.value_or(of_file))] += candidate.visible;
  }
  return static_cast<LeafKind>(std::ranges::max_element(areas) - areas.begin());
}

}  // namespace leafhull
