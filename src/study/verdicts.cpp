// SPDX-License-Identifier: Apache-2.0
// The paper's claims, each judged on the tables and figures of one study. Source: sections 4, 5.
#include "study/verdicts.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <optional>
#include <span>

#include "study/band_study.h"
#include "study/numbers.h"
#include "text/choice.h"

namespace leafhull {
namespace {

/// The change that "does not dramatically change" allows, and the least difference of an
/// "intermediate" shape.
constexpr double kLittle = 0.10;

struct Finding {
  Outcome outcome;
  std::string figures;
};

Finding decide(bool holds, std::string figures) {
  return {holds ? Outcome::holds : Outcome::fails, std::move(figures)};
}

Finding leave_open(std::string why) { return {Outcome::open, std::move(why)}; }

/// One of the paper's two counts.
struct Count {
  const char* name;
  std::uint64_t (*of)(const StudyRow&);
};

constexpr Count kDilated{"dilated voxels",
                         [](const StudyRow& row) { return row.metrics.dilated_voxels; }};
constexpr Count kOffSite{"off-site vertices", [](const StudyRow& row) { return row.off_site(); }};

std::string text(const StudyRow& row, const Count& count) {
  return grouped(count.of(row)) + (row.empty ? " (no surface)" : "");
}

using Rows = std::span<const StudyRow>;

/// Why `rows` have nothing to compare; empty if they do.
std::string without_surface(Rows rows) {
  if (rows.size() < 2) return "there is nothing to compare with";
  const bool all = std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.empty; });
  return all ? "none of them has a surface" : "";
}

/// Why `rows` cannot be compared by `count`; empty if they can.
std::string nothing_to_compare(Rows rows, const Count& count) {
  if (std::string why = without_surface(rows); !why.empty()) return why;
  const auto has_none = [&](const StudyRow& row) { return count.of(row) == 0; };
  if (!std::all_of(rows.begin(), rows.end(), has_none)) return {};
  return std::string("there are no ") + count.name + " in any of them";
}

// Table 1

const StudyRow& row_of(const ReadingStudy& study, Method method) {
  return study.table1[static_cast<std::size_t>(method)];
}

/// Whether `methods` are in order from the one that should have the most to the fewest.
Finding order(const ReadingStudy& study, const Count& count, std::array<Method, 3> methods) {
  if (std::string why = nothing_to_compare(study.table1, count); !why.empty()) {
    return leave_open(std::move(why));
  }
  const std::string figures = joined(methods, ", ", [&](Method method) {
    return std::string(paper_name(method)) + " " + text(row_of(study, method), count);
  });
  const auto falls = [&](Method more, Method fewer) {
    return count.of(row_of(study, more)) > count.of(row_of(study, fewer));
  };
  return decide(falls(methods[0], methods[1]) && falls(methods[1], methods[2]), figures);
}

Finding order_of_dilated(const ReadingStudy& study) {
  return order(study, kDilated, {Method::isotropic, Method::controlled, Method::uncontrolled});
}

Finding order_of_off_site(const ReadingStudy& study) {
  return order(study, kOffSite, {Method::uncontrolled, Method::controlled, Method::isotropic});
}

/// How far CTRLED lies from L&D (0) towards UNCTRLED (1); none if these two are equal.
std::optional<double> position(const ReadingStudy& study, const Count& count) {
  const auto value = [&](Method method) {
    return static_cast<double>(count.of(row_of(study, method)));
  };
  const double from = value(Method::isotropic), to = value(Method::uncontrolled);
  if (from == to) return {};
  return (value(Method::controlled) - from) / (to - from);
}

/// Whether CTRLED lies further than `margin` from both ends of that range.
Finding between(const ReadingStudy& study, double margin) {
  if (std::string why = without_surface(study.table1); !why.empty()) {
    return leave_open(std::move(why));
  }
  std::string figures;
  bool inside = true, known = true;
  for (const Count& count : {kDilated, kOffSite}) {
    const std::optional<double> at = position(study, count);
    known &= at.has_value();
    inside &= !at || (*at > margin && *at < 1 - margin);
    figures += (figures.empty() ? "" : ", ") +
               (at ? percent(*at) : "L&D and UNCTRLED are the same") + " in " + count.name;
  }
  for (const StudyRow& row : study.table1) {
    if (row.empty) figures += ", " + std::string(paper_name(row.method)) + " having no surface";
  }
  return inside && !known ? leave_open(figures) : decide(inside, figures);
}

Finding between(const ReadingStudy& study) { return between(study, 0); }

Finding clear_of_both(const ReadingStudy& study) { return between(study, kLittle); }

/// The bands that pass the same test; neighbours are joined, as in "70–90% to 10–30%".
std::string passing(const BandStudy& band, const std::vector<BandRow>& rows) {
  std::string names;
  const auto passes = [&](std::size_t i) {
    return i < rows.size() && intermediate(band, rows[i].row) == Outcome::holds;
  };
  for (std::size_t first = 0, last = 0; first < rows.size(); first = last + 1) {
    last = first;
    if (!passes(first)) continue;
    while (passes(last + 1)) ++last;
    names += (names.empty() ? "" : ", ") + name(rows[first].band);
    if (last > first) names += " to " + name(rows[last].band);
  }
  return names;
}

/// For which bands claim 2b holds.
std::string where_clear(const BandStudy& band) {
  if (!band.failure.empty()) return "no other bands could be tried";
  const std::string shares = passing(band, band.by_share),
                    deviations = passing(band, band.by_deviation);
  const std::string both = !shares.empty() && !deviations.empty() ? " and " : "";
  const std::string names = shares + both + deviations;
  return "by “Where the band lies” it holds for " +
         (names.empty() ? "no band" : "the bands " + names);
}

// Figures 11, 13, 15

/// The rows of a figure and the parameter that varies in it.
struct Series {
  const char* parameter;
  double StudyRow::*value;
  std::vector<StudyRow> rows;

  double first() const { return rows.front().*value; }
  double last() const { return rows.back().*value; }
  std::string range() const {
    return std::string(parameter) + " " + significant(first(), 4) + " to " + significant(last(), 4);
  }
};

Series raising_threshold(const ReadingStudy& study) {
  return {"T", &StudyRow::threshold, study.figure11};
}

Series raising_radius(const ReadingStudy& study) {
  return {"R_max", &StudyRow::radius_max, study.figure13};
}

Series lowering_flatness(const ReadingStudy& study) {
  return {"lambda_R", &StudyRow::flatness, {study.figure15.rbegin(), study.figure15.rend()}};
}

std::string listed(const Series& series, const Count& count) {
  return series.range() + ": " +
         joined(series.rows, ", ", [&](const StudyRow& row) { return text(row, count); });
}

/// Whether `count` changes in one direction along the whole series; `against(a, b)` tells whether
/// the step from a to b goes the other way.
template <class Against>
Finding trend(const Series& series, const Count& count, Against against) {
  if (std::string why = nothing_to_compare(series.rows, count); !why.empty()) {
    return leave_open(std::move(why));
  }
  std::vector<std::uint64_t> counts;
  std::transform(series.rows.begin(), series.rows.end(), std::back_inserter(counts), count.of);
  const bool steady = std::adjacent_find(counts.begin(), counts.end(), against) == counts.end();
  return decide(steady && counts.front() != counts.back(), listed(series, count));
}

Finding rises(const Series& series, const Count& count) {
  return trend(series, count, std::greater<>());
}

Finding falls(const Series& series, const Count& count) {
  return trend(series, count, std::less<>());
}

Finding threshold_and_dilated(const ReadingStudy& study) {
  return falls(raising_threshold(study), kDilated);
}

Finding threshold_and_off_site(const ReadingStudy& study) {
  return rises(raising_threshold(study), kOffSite);
}

Finding radius_and_dilated(const ReadingStudy& study) {
  return rises(raising_radius(study), kDilated);
}

/// The gain in off-site vertices from the first row to the last.
double growth(const Series& series) {
  return static_cast<double>(kOffSite.of(series.rows.back())) -
         static_cast<double>(kOffSite.of(series.rows.front()));
}

/// That gain per percent of growth of the parameter, relative to the middle of its range.
double growth_per_percent(const Series& series) {
  const double middle = (series.first() + series.last()) / 2;
  const double percents = 100 * (series.last() - series.first()) / middle;
  return static_cast<double>(growth(series)) / percents;
}

Finding radius_and_off_site(const ReadingStudy& study) {
  const Series radius = raising_radius(study), threshold = raising_threshold(study);
  std::vector<StudyRow> both = radius.rows;
  both.insert(both.end(), threshold.rows.begin(), threshold.rows.end());
  for (std::string why : {without_surface(radius.rows), without_surface(threshold.rows),
                          nothing_to_compare(both, kOffSite)}) {
    if (!why.empty()) return leave_open(std::move(why));
  }
  return decide(growth(threshold) > 0 && growth(radius) < growth(threshold),
                radius.range() + ": " + gained(growth(radius)) + ", " + threshold.range() + ": " +
                    gained(growth(threshold)) + "; for each percent of the parameter " +
                    gained(growth_per_percent(radius)) + " and " +
                    gained(growth_per_percent(threshold)));
}

Finding flatness_and_off_site(const ReadingStudy& study) {
  return rises(lowering_flatness(study), kOffSite);
}

Finding flatness_and_dilated(const ReadingStudy& study) {
  const Series series = lowering_flatness(study);
  if (std::string why = nothing_to_compare(series.rows, kDilated); !why.empty()) {
    return leave_open(std::move(why));
  }
  const auto [fewest, most] = std::minmax_element(
      series.rows.begin(), series.rows.end(),
      [](const auto& a, const auto& b) { return kDilated.of(a) < kDilated.of(b); });
  const double apart =
      1 - static_cast<double>(kDilated.of(*fewest)) / static_cast<double>(kDilated.of(*most));
  return decide(apart <= kLittle, listed(series, kDilated) + "; " + percent(apart) + " apart");
}

// Table 2

Finding cost_of_control(const ReadingStudy& study) {
  bool longer = true;
  std::string ratios, shares;
  for (const StudyTime& time : study.table2) {
    if (time.empty) continue;
    const std::string before = ratios.empty() ? "" : ", ";
    const double ratio = time.proposed / time.previous;
    longer &= ratio > 1;
    ratios += before + fixed(ratio, 2) + " at " + std::to_string(time.resolution);
    if (time.control > 0) shares += before + percent(time.control / time.proposed);
  }
  if (ratios.empty()) return leave_open("there is no surface at any resolution");
  if (!shares.empty()) shares = "; steps 2 to 5 are " + shares + " of CTRLED";
  return decide(longer, ratios + " voxels" + shares);
}

struct Claim {
  const char *number, *claim, *test;
  Finding (*judge)(const ReadingStudy&);
};

constexpr Claim kClaims[] = {
    {"1a", "L&D has the most dilated voxels, CTRLED fewer, UNCTRLED the fewest.",
     "Table 1: L&D > CTRLED > UNCTRLED; without a surface there are none.", order_of_dilated},
    {"1b", "UNCTRLED has the most off-site vertices, CTRLED fewer, L&D the fewest.",
     "Table 1: UNCTRLED > CTRLED > L&D; without a surface they are all.", order_of_off_site},
    {"2a", "CTRLED lies between L&D and UNCTRLED.",
     "Table 1: from L&D (0%) to UNCTRLED (100%) CTRLED lies above 0% and below 100%, in dilated "
     "voxels and in off-site vertices.",
     between},
    {"2b", "CTRLED is clear of both, an intermediate shape.",
     "Table 1: on the same way it lies above 10% and below 90%. The paper speaks of intermediate "
     "shapes; the 10% is ours, as in 5b. The bands of section “Where the band lies” that pass the "
     "same test are named beside it and do not decide.",
     clear_of_both},
    {"3a", "Raising T gives fewer dilated voxels.",
     "Figure 11: they never rise from one T to the next, and the last are fewer than the first.",
     threshold_and_dilated},
    {"3b", "Raising T gives more off-site vertices.",
     "Figure 11: they never fall from one T to the next, and the last are more than the first.",
     threshold_and_off_site},
    {"4a", "Raising R_max gives more dilated voxels.",
     "Figure 13: they never fall from one R_max to the next, and the last are more than the first.",
     radius_and_dilated},
    {"4b", "Raising R_max adds fewer off-site vertices than raising T does.",
     "Figures 11 and 13, each over the paper's range: from first to last they grow less in R_max "
     "than in T; a fall is less than any growth. The ranges are not of one width, hence the growth "
     "for each percent beside it, which does not decide.",
     radius_and_off_site},
    {"5a", "Lowering lambda_R gives more off-site vertices.",
     "Figure 15: they never fall from one lambda_R to the next lower one, and the last are more "
     "than the first.",
     flatness_and_off_site},
    {"5b", "Lowering lambda_R changes the dilated voxels little.",
     "Figure 15: the fewest and the most are at most 10% of the most apart. The paper says \"does "
     "not dramatically change\"; the 10% is ours.",
     flatness_and_dilated},
    {"6", "Control takes more time than L&D alone.",
     "Table 2: the time of CTRLED (steps 1 to 7 of Figure 8) over that of L&D (steps 1, 6 and 7) "
     "is above 1 at every resolution that has both surfaces.",
     cost_of_control},
};

}  // namespace

std::string_view name(Outcome outcome) {
  constexpr std::string_view kNames[] = {"holds", "fails", "open"};
  return kNames[static_cast<std::size_t>(outcome)];
}

std::string_view in_words(Outcome outcome) {
  constexpr std::string_view kWords[] = {"holds", "does not hold", "cannot be told"};
  return kWords[static_cast<std::size_t>(outcome)];
}

Outcome intermediate(const BandStudy& band, const StudyRow& controlled) {
  ReadingStudy study;
  study.table1 = {band.isotropic, band.uncontrolled, controlled};
  return clear_of_both(study).outcome;
}

std::vector<Verdict> verdicts(const ReadingStudy& study, const BandStudy* band) {
  std::vector<Verdict> verdicts;
  for (const Claim& claim : kClaims) {
    Finding here = claim.judge(study), paper = claim.judge(paper_results());
    if (band != nullptr && claim.judge == clear_of_both) here.figures += "; " + where_clear(*band);
    const bool printed = paper.outcome != Outcome::open;
    verdicts.push_back({claim.number, claim.claim, claim.test, here.outcome,
                        std::move(here.figures), printed ? std::move(paper.figures) : ""});
  }
  return verdicts;
}

}  // namespace leafhull
