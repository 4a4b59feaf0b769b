// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "colour/colour.h"
#include "foliage/asked.h"
#include "foliage/candidates.h"
#include "foliage/kinds.h"
#include "foliage/levels.h"
#include "foliage/words.h"
#include "leafhull/error.h"
#include "leafhull/leaves.h"

namespace leafhull {
namespace {

/// Candidates whose evidence adds up to this are leaves.
constexpr double kLeaves = 1;
/// If there are none, the best candidate is taken if its evidence adds up to this.
constexpr double kPerhaps = -0.5;
/// There is no warning of doubt if all chosen candidates have at least kSure and no rejected one
/// has more than kSurelyNot.
constexpr double kSure = 1.8, kSurelyNot = 0.4;
/// Fruit and the like have less than this share of the area, and neither a name nor a plain colour.
constexpr double kMinorShare = 0.08;

/// The middle of a standing tree is above kStanding, that of undergrowth below kLow, as shares of
/// the height of everything.
constexpr double kStanding = 0.35, kLow = 0.2;
constexpr std::size_t kOptions = 3;  // options to suggest if no leaves are found

bool is_chosen(const Candidate& candidate) { return candidate.told.verdict == LeafVerdict::leaves; }

/// Rejects grass and the like, by name or because it lies at the feet of trees.
void pass_over_undergrowth(std::vector<Candidate>& list) {
  const auto is_tree = [](const Candidate& candidate) {
    return is_chosen(candidate) && candidate.growth != Growth::undergrowth;
  };
  if (std::ranges::none_of(list, is_tree)) return;
  const bool stands = std::ranges::any_of(
      list, [&](const Candidate& c) { return is_tree(c) && c.height > kStanding; });
  for (Candidate& candidate : list) {
    const bool is_low = stands && candidate.growth == Growth::unknown && candidate.height < kLow;
    if (is_chosen(candidate) && (candidate.growth == Growth::undergrowth || is_low)) {
      candidate.told.verdict = LeafVerdict::undergrowth;
    }
  }
}

void pass_over_fruit(std::vector<Candidate>& list) {
  double area = 0;
  for (const Candidate& candidate : list) area += is_chosen(candidate) ? candidate.told.area : 0;
  for (Candidate& candidate : list) {
    const LeafEvidence& evidence = candidate.told.evidence;
    const bool is_plain = evidence.name >= 1 || evidence.alpha >= 1 || evidence.colour >= 1.5;
    if (is_chosen(candidate) && !is_plain && candidate.told.area < kMinorShare * area) {
      candidate.told.verdict = LeafVerdict::minor;
    }
  }
}

/// Judges candidates by their evidence. Returns true if the result is a guess.
bool judge(std::vector<Candidate>& list) {
  bool any = false;
  for (Candidate& candidate : list) {
    if (candidate.told.verdict == LeafVerdict::not_asked_for) continue;
    const bool is_leaves = candidate.told.evidence.total() >= kLeaves;
    candidate.told.verdict = is_leaves ? LeafVerdict::leaves : LeafVerdict::other;
    any = any || is_leaves;
  }
  if (!any) {
    const auto value = [](const Candidate& candidate) {
      return candidate.told.verdict == LeafVerdict::other ? candidate.told.evidence.total()
                                                          : -HUGE_VAL;
    };
    const auto best = std::ranges::max_element(list, {}, value);
    if (best == list.end() || value(*best) < kPerhaps || list.size() < 2) return false;
    best->told.verdict = LeafVerdict::leaves;
    return true;
  }
  pass_over_undergrowth(list);
  pass_over_fruit(list);
  return false;
}

/// The rejected candidate that comes nearest to being leaves, or null.
const Candidate* second_reading(const std::vector<Candidate>& list) {
  double area = 0;
  for (const Candidate& candidate : list) area += candidate.told.area;
  const Candidate* second = nullptr;
  for (const Candidate& candidate : list) {
    if (candidate.told.verdict != LeafVerdict::other || candidate.told.area < 0.03 * area) continue;
    if (!second || candidate.told.evidence.total() > second->told.evidence.total()) {
      second = &candidate;
    }
  }
  return second;
}

/// The least evidence of any sizeable chosen candidate.
double least_sure(const std::vector<Candidate>& list) {
  double area = 0;
  for (const Candidate& candidate : list) area += is_chosen(candidate) ? candidate.told.area : 0;
  double least = HUGE_VAL;
  for (const Candidate& candidate : list) {
    if (!is_chosen(candidate) || candidate.told.area < 0.1 * area) continue;
    least = std::min(least, candidate.told.evidence.total());
  }
  return least;
}

void warn_of_doubt(const std::vector<Candidate>& list, bool is_guess, LeafChoice& choice) {
  if (!choice.any()) return;
  const Candidate* second = second_reading(list);
  const bool is_close = second && second->told.evidence.total() > kSurelyNot;
  if (!is_guess && !is_close && least_sure(list) >= kSure) return;
  std::string warning = "the choice of leaves is a guess: " + taken_words(list);
  if (second) {
    warning += "; " + label(second->told) + " could be too: " + option_for(second->told);
  } else {
    warning += "; if they are not, name them with --leaves";
  }
  choice.warnings.push_back(std::move(warning));
}

void mark(const TreeModel& tree, const Candidates& candidates, LeafChoice& choice) {
  choice.triangles.resize(tree.primitives.size());
  std::vector<bool> partly(tree.primitives.size());
  for (const Candidate& candidate : candidates.list) {
    const auto& part_of = candidates.part_of[candidate.primitive];
    if (!is_chosen(candidate)) {
      partly[candidate.primitive] = partly[candidate.primitive] || !part_of.empty();
      continue;
    }
    for (const std::uint32_t i : candidate.instances) choice.instances[i] = true;
    if (part_of.empty()) continue;
    std::vector<bool>& triangles = choice.triangles[candidate.primitive];
    triangles.resize(part_of.size());
    for (std::size_t t = 0; t < part_of.size(); ++t) {
      if (part_of[t] == candidate.part) triangles[t] = true;
    }
  }
  for (std::size_t i = 0; i < partly.size(); ++i) {
    if (!partly[i]) choice.triangles[i].clear();
  }
}

/// Cuts out opaque materials whose image has holes where leaves use it.
void use_alpha(const TreeModel& tree, const Candidates& candidates, LeafChoice& choice) {
  choice.cut_out.resize(tree.materials.size());
  for (const Candidate& candidate : candidates.list) {
    const int material = tree.primitives[candidate.primitive].material;
    if (!is_chosen(candidate) || material < 0 || choice.cut_out[material] ||
        candidate.told.alpha_mode != AlphaMode::opaque || candidate.told.evidence.alpha <= 0) {
      continue;
    }
    choice.cut_out[material] = true;
    choice.warnings.push_back("material '" + printable_name(candidate.told.material) +
                              "' says it is opaque, but its texture has holes: they are cut out");
  }
}

std::optional<Vec3f> mean_colour(const std::vector<Candidate>& list) {
  Vec3d sum;
  double area = 0;
  for (const Candidate& candidate : list) {
    if (!is_chosen(candidate) || !candidate.colour) continue;
    sum = sum + Vec3d(*candidate.colour) * candidate.visible;
    area += candidate.visible;
  }
  if (!(area > 0)) return std::nullopt;
  return Vec3f(sum / area);
}

}  // namespace

bool LeafChoice::any() const { return std::ranges::find(instances, true) != instances.end(); }

LeafChoice choose_leaves(const TreeModel& tree, std::span<const Instance> instances,
                         const LeafOptions& options) {
  LeafChoice choice;
  choice.instances.resize(instances.size());
  const Asked asked(tree, instances, options);
  const Levels levels = find_levels(tree, instances, asked.candidates());
  choice.left_out = levels.coarser;
  Candidates candidates = find_candidates(tree, instances, levels, asked.candidates());
  bool is_guess = false;
  if (options.globs.empty() && !options.colour) {
    for (Candidate& candidate : candidates.list) {
      if (!asked.candidates()[candidate.instances.front()]) {
        candidate.told.verdict = LeafVerdict::not_asked_for;
      }
    }
    is_guess = judge(candidates.list);
    mark(tree, candidates, choice);
  } else {
    asked.choose(levels, candidates, choice);
  }
  use_alpha(tree, candidates, choice);
  choice.colour = options.tint ? linear_of_srgb(*options.tint) : mean_colour(candidates.list);
  choice.kind = kind_of(tree, instances, candidates.list);
  choice.is_tinted = options.tint.has_value();
  choice.told = told_words(candidates.list, levels);
  if (options.globs.empty() && !options.colour) warn_of_doubt(candidates.list, is_guess, choice);
  asked.warn_of_unused(choice.warnings);
  choice.welded = std::make_shared<const WeldedPrimitives>(std::move(candidates.welded));

  std::ranges::stable_sort(candidates.list, [](const Candidate& a, const Candidate& b) {
    if (is_chosen(a) != is_chosen(b)) return is_chosen(a);
    return a.told.evidence.total() > b.told.evidence.total();
  });
  for (Candidate& candidate : candidates.list) {
    std::string option = option_for(candidate.told);
    const bool is_known = std::ranges::find(choice.options, option) != choice.options.end();
    if (choice.options.size() < kOptions && !is_known) choice.options.push_back(std::move(option));
    choice.candidates.push_back(std::move(candidate.told));
  }
  return choice;
}

}  // namespace leafhull
