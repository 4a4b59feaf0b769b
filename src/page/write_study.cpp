// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>
#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "leafhull/error.h"
#include "leafhull/study.h"
#include "output/transaction.h"
#include "output/write_error.h"
#include "page/figures.h"
#include "page/report_data.h"
#include "study/band_study.h"
#include "study/verdicts.h"

namespace leafhull {

// Embedded at build time. The viewer is empty where leafhull is built without.
extern const std::string_view report_template, report_style, report_viewer;

namespace {

namespace fs = std::filesystem;
namespace mustache = kainjow::mustache;

/// Turns empty values into false, since the template language treats an empty text as true.
mustache::data to_mustache(const nlohmann::json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.empty()) return false;
  if (json.is_string()) {
    const auto& text = json.get_ref<const std::string&>();
    return text.empty() ? mustache::data(false) : mustache::data(text);
  }
  mustache::data data(json.is_array() ? mustache::data::type::list : mustache::data::type::object);
  for (const auto& [key, value] : json.items()) {
    if (json.is_array()) {
      data.push_back(to_mustache(value));
    } else {
      data.set(key, to_mustache(value));
    }
  }
  return data;
}

/// Writes the study as one self-contained HTML page.
void write_report(const Study& study, std::span<const TreePlots> plots, std::ostream& stream) {
  nlohmann::json data = report_data(study, plots);
  data["css"] = report_style;
  data["viewer"] = report_viewer;
  mustache::mustache page{std::string(report_template)};
  page.render(to_mustache(data), [&](const std::string& text) { stream << text; });
  if (!page.is_valid()) throw Error(ErrorCode::internal, "report.html: " + page.error_message());
}

// study.json

using OrderedJson = nlohmann::ordered_json;

OrderedJson to_json_value(const Vec3d& vector) { return {vector.x, vector.y, vector.z}; }

OrderedJson to_json_value(const StudyRow& row) {
  return {{"method", name(row.method)},
          {"threshold", row.threshold},
          {"radius_max", row.radius_max},
          {"flatness", row.flatness},
          {"empty", row.empty},
          {"dilated_voxels", row.metrics.dilated_voxels},
          {"inside_voxels", row.metrics.inside_voxels},
          {"on_voxels", row.metrics.on_voxels},
          {"off_site_exact", row.metrics.off_site_exact},
          {"off_site_sampled", row.metrics.off_site_sampled}};
}

OrderedJson to_json_value(const StudyTime& time) {
  OrderedJson json = {{"resolution", time.resolution}, {"runs", time.runs}, {"empty", time.empty}};
  json["previous"] = time.empty ? OrderedJson() : OrderedJson(time.previous);
  json["proposed"] = time.empty ? OrderedJson() : OrderedJson(time.proposed);
  json["control"] = time.empty ? OrderedJson() : OrderedJson(time.control);
  return json;
}

OrderedJson to_json_value(const Verdict& verdict) {
  return {{"number", verdict.number},   {"claim", verdict.claim},
          {"test", verdict.test},       {"outcome", name(verdict.outcome)},
          {"figures", verdict.figures}, {"paper", verdict.paper}};
}

OrderedJson to_json_value(const ReadingStudy& reading);
OrderedJson to_json_value(const TreeStudy& tree);

template <class Range>
OrderedJson list(const Range& values) {
  OrderedJson list = OrderedJson::array();
  for (const auto& value : values) list.push_back(to_json_value(value));
  return list;
}

OrderedJson to_json_value(const ReadingStudy& reading) {
  return {{"falloff", reading.reading.falloff},       {"spread", name(reading.reading.spread)},
          {"density", name(reading.reading.density)}, {"table1", list(reading.table1)},
          {"figure11", list(reading.figure11)},       {"figure13", list(reading.figure13)},
          {"figure15", list(reading.figure15)},       {"table2", list(reading.table2)},
          {"verdicts", list(reading.verdicts)}};
}

/// Rows of bands, with p1 and p2 as deviations or in percent, and claim 2b.
OrderedJson list(const BandStudy& band, const std::vector<BandRow>& rows) {
  OrderedJson list = OrderedJson::array();
  for (const BandRow& row : rows) {
    OrderedJson json = {{"band_low", row.band.low}, {"band_high", row.band.high}};
    json.update(to_json_value(row.row));
    json["claim_2b"] = name(intermediate(band, row.row));
    list.push_back(std::move(json));
  }
  return list;
}

OrderedJson to_json_value(const BandStudy& band) {
  OrderedJson json = {{"falloff", kBandReading.falloff}, {"evenness", band.evenness}};
  const bool is_fitted = band.failure.empty();
  json["failure"] = is_fitted ? OrderedJson() : OrderedJson(band.failure);
  if (!is_fitted) return json;
  json["threshold"] = band.threshold;
  json["leaf_scale"] = band.leaf_scale;
  json["ends"] = list(std::array{band.isotropic, band.uncontrolled});
  json["by_share"] = list(band, band.by_share);
  json["by_deviation"] = list(band, band.by_deviation);
  return json;
}

OrderedJson to_json_value(const TreeStudy& tree) {
  OrderedJson json = {
      {"name", tree.name}, {"leaves", tree.leaves}, {"leaf_vertices", tree.leaf_vertices}};
  json["bounds"] =
      tree.bounds.empty() ? OrderedJson() : list(std::array{tree.bounds.low, tree.bounds.high});
  json["seconds"] = tree.seconds;
  json["band"] = to_json_value(tree.band);
  json["readings"] = list(tree.readings);
  return json;
}

std::string study_json(const Study& study) {
  const OrderedJson json = {{"schema", "leafhull-study/1"}, {"version", study.version},
                            {"date", study.date},           {"command", study.command},
                            {"machine", study.machine},     {"device", study.device},
                            {"seconds", study.seconds},     {"trees", list(study.trees)}};
  // A path may hold bytes that are not UTF-8; JSON may not.
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

void check(const Study& study) {
  if (study.trees.empty()) {
    throw Error(ErrorCode::usage, "the study has no tree", "Add what study_tree gives for one.");
  }
  for (const TreeStudy& tree : study.trees) {
    if (!tree.readings.empty()) continue;
    throw Error(ErrorCode::usage, "the study of " + tree.name + " has no readings",
                "Add what study_tree gives for it.");
  }
}

}  // namespace

void write_study(const Study& study, const OutputFolder& into) {
  check(study);
  const fs::path& folder = into.path();
  const std::vector<TreePlots> plots = draw_plots(study);
  std::error_code error;
  const bool is_new = fs::create_directories(folder, error);
  if (error) throw write_error(folder, error.value());
  try {
    Transaction transaction;
    transaction.write(folder / "report.html",
                      [&](std::ostream& stream) { write_report(study, plots, stream); });
    transaction.write(folder / "study.json",
                      [&](std::ostream& stream) { stream << study_json(study); });
    transaction.commit();
  } catch (...) {
    if (is_new) fs::remove(folder, error);
    throw;
  }
}

}  // namespace leafhull
