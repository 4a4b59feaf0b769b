// SPDX-License-Identifier: Apache-2.0
#include "foliage/words.h"

#include <algorithm>
#include <array>
#include <utility>

namespace leafhull {
namespace {

constexpr std::size_t kMostLabels = 5;
/// Evidence below this is not mentioned.
constexpr double kWorthAWord = 0.4;

std::string first_name(const LeafCandidate& candidate) {
  for (const std::string* name : {&candidate.material, &candidate.mesh, &candidate.node}) {
    if (!name->empty()) return printable_name(*name);
  }
  return {};
}

/// "colour, shape", the strongest evidence first.
std::string reasons(const LeafCandidate& candidate) {
  const LeafEvidence& e = candidate.evidence;
  std::array<std::pair<double, std::string_view>, 5> parts{{{e.name, "name"},
                                                            {e.alpha, "holes"},
                                                            {e.colour, "colour"},
                                                            {e.shape, "shape"},
                                                            {e.place, "place"}}};
  std::ranges::stable_sort(parts, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (const auto& [value, word] : parts) {
    if (value < kWorthAWord) continue;
    text.append(text.empty() ? "" : ", ").append(word);
  }
  return text;
}

/// A list of distinct labels; those past a limit are only counted.
class List {
 public:
  /// @param why is shown for the largest thing of a label.
  void add(const std::string& label, double area, const std::string& why = {}) {
    auto known = std::ranges::find(entries_, label, &Entry::label);
    if (known == entries_.end()) known = entries_.insert(known, {label, why, 0, area});
    known->area += area;
    if (area > known->largest) {
      known->largest = area;
      known->why = why;
    }
  }

  /// The largest first.
  std::string text() {
    std::ranges::stable_sort(entries_,
                             [](const Entry& a, const Entry& b) { return a.area > b.area; });
    std::string text;
    for (std::size_t i = 0; i < std::min(entries_.size(), kMostLabels); ++i) {
      const auto& [label, why, area, largest] = entries_[i];
      text.append(i == 0 ? "" : ", ").append(label);
      if (!why.empty()) text += " (" + why + ")";
    }
    if (entries_.size() > kMostLabels) {
      text += " and " + std::to_string(entries_.size() - kMostLabels) + " more";
    }
    return text;
  }

  bool empty() const { return entries_.empty(); }

 private:
  struct Entry {
    std::string label, why;
    double area = 0, largest = 0;
  };
  std::vector<Entry> entries_;
};

/// A glob that matches `name`; special characters in it become ?, which matches any.
std::string glob_of(std::string glob) {
  std::ranges::replace_if(
      glob, [](char c) { return std::string_view("*?[]\\'").find(c) != std::string_view::npos; },
      '?');
  return glob;
}

}  // namespace

std::string printable_name(std::string_view name) {
  std::string text(name);
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
  return text;
}

std::string label(const LeafCandidate& candidate) {
  std::string name = first_name(candidate);
  if (!name.empty() && !candidate.is_part) return name;
  if (!candidate.colour.empty()) return (name.empty() ? "what is " : name + ' ') + candidate.colour;
  return name.empty() ? "what has no name" : "a part of " + name;
}

std::string option_for(const LeafCandidate& candidate) {
  if (candidate.is_part && !candidate.colour.empty()) {
    return "--leaves-colour '" + candidate.colour + "'";
  }
  const std::string name = first_name(candidate);
  return "--leaves '" + (name.empty() ? "*" : glob_of(name)) + "'";
}

std::string taken_words(const std::vector<Candidate>& list) {
  List taken;
  for (const Candidate& candidate : list) {
    if (candidate.told.verdict != LeafVerdict::leaves) continue;
    taken.add(label(candidate.told), candidate.told.area, reasons(candidate.told));
  }
  return taken.text();
}

std::string told_words(const std::vector<Candidate>& list, const Levels& levels) {
  std::string text = "leaves: " + taken_words(list);
  List others;
  for (const Candidate& candidate : list) {
    if (candidate.told.verdict == LeafVerdict::leaves) continue;
    const bool is_low = candidate.told.verdict == LeafVerdict::undergrowth;
    others.add(label(candidate.told), candidate.told.area, is_low ? "undergrowth" : "");
  }
  if (!others.empty()) text += "; passed over: " + others.text();
  if (levels.passed_over > 0) {
    List kept;
    for (const std::string& name : levels.kept) kept.add(printable_name(name), 0);
    text += "; of several levels of detail: " + kept.text();
  }
  return text;
}

}  // namespace leafhull
