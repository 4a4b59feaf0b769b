// SPDX-License-Identifier: Apache-2.0
#include "page/report_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "page/figures.h"
#include "page/pictures_data.h"
#include "page/typeset.h"
#include "study/band_study.h"
#include "study/numbers.h"
#include "study/study_plan.h"
#include "study/verdicts.h"
#include "text/choice.h"

namespace leafhull {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kIsotropic = static_cast<std::size_t>(Method::isotropic);

std::string duration_text(double seconds) {
  if (seconds < 100) return fixed(seconds, 1) + " s";
  return fixed(seconds / 60, 1) + " min";
}

// Claims

/// An outcome and its wording.
Json mark(Outcome outcome) { return {{"outcome", name(outcome)}, {"word", in_words(outcome)}}; }

std::string tally(const ReadingStudy& reading) {
  const auto holds = std::ranges::count(reading.verdicts, Outcome::holds, &Verdict::outcome);
  return std::to_string(holds) + " of " + std::to_string(reading.verdicts.size()) + " hold";
}

Json verdict_data(const Verdict& verdict) {
  Json data = mark(verdict.outcome);
  data["number"] = verdict.number;
  data["claim"] = typeset(verdict.claim);
  data["test"] = typeset(verdict.test);
  data["figures"] = typeset(verdict.figures);
  data["paper"] = typeset(verdict.paper);
  return data;
}

Json cell(const TreeStudy& tree, std::size_t claim) {
  Json data = mark(tree.readings.front().verdicts.at(claim).outcome);
  const auto holds = std::ranges::count_if(tree.readings, [&](const ReadingStudy& reading) {
    return reading.verdicts.at(claim).outcome == Outcome::holds;
  });
  data["tree"] = tree.name;
  data["held"] = std::to_string(holds);
  data["of"] = std::to_string(tree.readings.size());
  return data;
}

/// The summary: each claim with its outcome on every tree in the first reading, and in how many
/// readings it holds there.
Json claims_data(const Study& study) {
  Json claims = Json::array();
  const std::vector<Verdict>& first = study.trees.front().readings.front().verdicts;
  for (std::size_t i = 0; i < first.size(); ++i) {
    Json cells = Json::array();
    for (const TreeStudy& tree : study.trees) cells.push_back(cell(tree, i));
    claims.push_back({{"number", first[i].number},
                      {"claim", typeset(first[i].claim)},
                      {"cells", std::move(cells)}});
  }
  return claims;
}

/// The verdicts of one tree, reading by reading.
Json readings_data(const TreeStudy& tree) {
  Json readings = Json::array();
  for (const ReadingStudy& reading : tree.readings) {
    Json verdicts = Json::array();
    for (const Verdict& verdict : reading.verdicts) verdicts.push_back(verdict_data(verdict));
    readings.push_back({{"reading", reading_name(reading.reading)},
                        {"own", readings.empty()},
                        {"tally", tally(reading)},
                        {"verdicts", std::move(verdicts)}});
  }
  return readings;
}

// Table 1

using Count = std::uint64_t (*)(const StudyRow&);

std::uint64_t dilated(const StudyRow& row) { return row.metrics.dilated_voxels; }
std::uint64_t off_site(const StudyRow& row) { return row.off_site(); }

constexpr const char* kNoSurface = "no surface";
constexpr const char* kNone = "–";

template <class Text>
Json cells(const std::array<StudyRow, 3>& rows, Text text) {
  Json cells = Json::array();
  for (const StudyRow& row : rows) cells.push_back(row.empty ? std::string(kNoSurface) : text(row));
  return cells;
}

Json counts_row(const std::string& label, const std::array<StudyRow, 3>& rows, Count count) {
  return {{"label", label},
          {"cells", cells(rows, [&](const StudyRow& row) { return grouped(count(row)); })}};
}

Json ratios_row(const std::string& label, const std::array<StudyRow, 3>& rows, Count count) {
  const StudyRow& isotropic = rows[kIsotropic];
  const auto ratio = [&](const StudyRow& row) -> std::string {
    if (isotropic.empty || count(isotropic) == 0) return kNone;
    return fixed(static_cast<double>(count(row)) / static_cast<double>(count(isotropic)), 2);
  };
  return {{"label", label + ", L&D = 1"}, {"cells", cells(rows, ratio)}, {"derived", true}};
}

Json shares_row(const std::string& label, const std::array<StudyRow, 3>& rows,
                std::uint64_t leaf_vertices) {
  const auto share = [&](const StudyRow& row) {
    return percent(static_cast<double>(off_site(row)) / static_cast<double>(leaf_vertices));
  };
  return {{"label", label + ", of its leaf vertices"},
          {"cells", cells(rows, share)},
          {"derived", true}};
}

Json table1(const TreeStudy& tree, const ReadingStudy& own) {
  const auto& ours = own.table1;
  const auto& theirs = paper_results().table1;
  const std::string paper = "the paper";
  return {{{"metric", "Dilated voxels"},
           {"rows",
            {counts_row(tree.name, ours, dilated), counts_row(paper, theirs, dilated),
             ratios_row(tree.name, ours, dilated), ratios_row(paper, theirs, dilated)}}},
          {{"metric", "Off-site vertices"},
           {"rows",
            {counts_row(tree.name, ours, off_site), counts_row(paper, theirs, off_site),
             shares_row(tree.name, ours, tree.leaf_vertices),
             shares_row(paper, theirs, kPaperLeafVertices), ratios_row(tree.name, ours, off_site),
             ratios_row(paper, theirs, off_site)}}}};
}

// Table 2

std::string added_text(const StudyTime& time) {
  const double added = time.proposed / time.previous - 1;
  return std::string(added < 0 ? "" : "+") + fixed(100 * added, 0) + "%";
}

void append_seconds(Json& cells, const StudyTime* time) {
  if (time == nullptr || time->empty) {
    for (int i = 0; i < 3; ++i) cells.push_back(kNone);
    return;
  }
  cells.push_back(fixed(time->previous, 3));
  cells.push_back(fixed(time->proposed, 3));
  cells.push_back(added_text(*time));
}

const StudyTime* at_resolution(const std::vector<StudyTime>& times, int resolution) {
  const auto found = std::ranges::find(times, resolution, &StudyTime::resolution);
  return found == times.end() ? nullptr : &*found;
}

Json table2(const ReadingStudy& own) {
  Json rows = Json::array();
  for (const StudyTime& time : own.table2) {
    Json cells = Json::array();
    append_seconds(cells, &time);
    append_seconds(cells, at_resolution(paper_results().table2, time.resolution));
    rows.push_back({{"resolution", std::to_string(time.resolution)}, {"cells", std::move(cells)}});
  }
  return rows;
}

// Figures

Json figure_rows(const ParameterFigures& figures, const ReadingStudy& own) {
  Json rows = Json::array();
  for (const StudyRow& row : own.*figures.rows) {
    const auto text = [&](Count count) {
      return row.empty ? std::string(kNoSurface) : grouped(count(row));
    };
    rows.push_back({{"value", significant(row.*figures.value, 4)},
                    {"dilated", text(dilated)},
                    {"off_site", text(off_site)}});
  }
  return rows;
}

Json curve_data(const ParameterFigures& figures, const std::string& svg, const std::string& tree) {
  return plot_data(svg, "Curves of the dilated voxels and off-site vertices of " + tree +
                            " over the " + std::string(figures.axis) + "; the numbers are below.");
}

Json parameters(const TreeStudy& tree, const TreePlots* plots) {
  Json list = Json::array();
  for (std::size_t i = 0; i < kParameterFigures.size(); ++i) {
    const ParameterFigures& figures = kParameterFigures[i];
    Json parameter = {{"symbol", typeset(std::string(figures.symbol))},
                      {"meaning", figures.meaning},
                      {"curves", std::to_string(figures.curves)},
                      {"pictures", std::to_string(figures.pictures)},
                      {"rows", figure_rows(figures, tree.readings.front())},
                      {"sheet", sheet_data(tree.*figures.sheet, tree.name)},
                      {"plots", false}};
    if (plots != nullptr) {
      parameter["plots"] = {{"first", curve_data(figures, plots->first[i], tree.name)},
                            {"all", curve_data(figures, plots->all[i], tree.name)}};
    }
    list.push_back(std::move(parameter));
  }
  return list;
}

// Where the band lies

/// The two ratios of a shape that can be compared between trees.
Json ratios_cells(const StudyRow& row, const StudyRow& isotropic, std::uint64_t leaf_vertices) {
  const double dilated = share_dilated(row, isotropic);
  return {fixed(100 * share_lost(row, leaf_vertices), 1) + "%",
          std::isfinite(dilated) ? fixed(dilated, 2) : kNone};
}

/// A row of the band table: one of the ends of `band` or a shape between them.
Json band_row(const std::string& label, const StudyRow& row, const BandStudy& band,
              std::uint64_t leaf_vertices) {
  const bool is_end = row.method != Method::controlled;
  return {{"label", label},
          {"cells", ratios_cells(row, band.isotropic, leaf_vertices)},
          {"mark", is_end ? Json(false) : mark(intermediate(band, row))}};
}

Json band_row(const StudyRow& row, const BandStudy& band, std::uint64_t leaf_vertices) {
  return band_row(std::string(paper_name(row.method)), row, band, leaf_vertices);
}

Json band_groups(const BandStudy& band, std::uint64_t leaf_vertices) {
  Json shares = Json::array({band_row(band.isotropic, band, leaf_vertices)});
  Json deviations = Json::array();
  for (const BandRow& row : band.by_share) {
    shares.push_back(band_row(name(row.band), row.row, band, leaf_vertices));
  }
  shares.push_back(band_row(band.uncontrolled, band, leaf_vertices));
  for (const BandRow& row : band.by_deviation) {
    deviations.push_back(band_row(name(row.band), row.row, band, leaf_vertices));
  }
  const auto& [isotropic, uncontrolled, controlled] = paper_results().table1;
  BandStudy paper;
  paper.isotropic = isotropic;
  paper.uncontrolled = uncontrolled;
  const Json theirs = {band_row(isotropic, paper, kPaperLeafVertices),
                       band_row(controlled, paper, kPaperLeafVertices),
                       band_row(uncontrolled, paper, kPaperLeafVertices)};
  return {{{"group", "CTRLED, its band by shares of the leaf vertices"}, {"rows", shares}},
          {{"group", "CTRLED, its band by deviations from the mean"}, {"rows", deviations}},
          {{"group", "The paper"}, {"rows", theirs}}};
}

Json band_data(const TreeStudy& tree, const TreePlots* plots) {
  const BandStudy& band = tree.band;
  Json data = {{"evenness", fixed(band.evenness, 2)}, {"failure", band.failure}, {"fit", false}};
  if (!band.failure.empty()) return data;
  const auto lost = [&](const StudyRow& row) {
    return fixed(100 * share_lost(row, tree.leaf_vertices), 2) + "%";
  };
  data["fit"] = {{"threshold", significant(band.threshold, 4)},
                 {"leaf_scale", significant(band.leaf_scale, 4)},
                 {"isotropic_lost", lost(band.isotropic)},
                 {"uncontrolled_lost", lost(band.uncontrolled)},
                 {"groups", band_groups(band, tree.leaf_vertices)},
                 {"plot", false}};
  if (plots != nullptr) {
    data["fit"]["plot"] = plot_data(
        plots->band, "The dilated voxels of " + tree.name +
                         " over its off-site vertices as the band moves; the numbers are below.");
  }
  return data;
}

Json tree_data(const TreeStudy& tree, std::size_t index, const TreePlots* plots) {
  const ReadingStudy& own = tree.readings.front();
  const Json shapes = shapes_data(tree);
  const bool turns =
      std::ranges::any_of(shapes, [](const Json& shape) { return shape["mesh"].is_object(); });
  const int runs = own.table2.empty() ? 0 : own.table2.front().runs;
  return {{"id", "tree-" + std::to_string(index + 1)},
          {"name", tree.name},
          {"leaves", grouped(tree.leaves)},
          {"leaf_vertices", grouped(tree.leaf_vertices)},
          {"duration", duration_text(tree.seconds)},
          {"shapes", shapes},
          {"turns", turns},
          {"table1", table1(tree, own)},
          {"parameters", parameters(tree, plots)},
          {"band", band_data(tree, plots)},
          {"runs", runs > 0 ? std::to_string(runs) : ""},
          {"table2", table2(own)},
          {"readings", readings_data(tree)}};
}

}  // namespace

nlohmann::json report_data(const Study& study, std::span<const TreePlots> plots) {
  Json trees = Json::array();
  for (std::size_t i = 0; i < study.trees.size(); ++i) {
    trees.push_back(tree_data(study.trees[i], i, plots.empty() ? nullptr : &plots[i]));
  }
  const std::vector<ReadingStudy>& first = study.trees.front().readings;
  return {{"version", study.version},
          {"date", study.date},
          {"machine", study.machine},
          {"device", study.device},
          {"duration", duration_text(study.seconds)},
          {"command", study.command},
          {"names", joined(study.trees, ", ", &TreeStudy::name)},
          {"tree_count",
           study.trees.size() == 1 ? "one tree" : std::to_string(study.trees.size()) + " trees"},
          {"own_reading", reading_name(first.front().reading)},
          {"reading_count", std::to_string(first.size())},
          {"resolution", std::to_string(kResolution)},
          {"methods",
           {paper_name(Method::isotropic), paper_name(Method::uncontrolled),
            paper_name(Method::controlled)}},
          {"paper_leaf_vertices", grouped(kPaperLeafVertices)},
          {"band_falloff", std::to_string(kBandReading.falloff)},
          {"claims", claims_data(study)},
          {"trees", std::move(trees)}};
}

}  // namespace leafhull
