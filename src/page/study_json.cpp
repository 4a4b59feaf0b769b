// SPDX-License-Identifier: Apache-2.0
#include "page/study_json.h"

#include <nlohmann/json.hpp>

#include "study/band.h"
#include "study/verdicts.h"

namespace leafhull {
namespace {

using Json = nlohmann::ordered_json;

Json to_json_value(const Vec3d& vector) { return {vector.x, vector.y, vector.z}; }

Json to_json_value(const StudyRow& row) {
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

Json to_json_value(const StudyTime& time) {
  Json json = {{"resolution", time.resolution}, {"runs", time.runs}, {"empty", time.empty}};
  json["previous"] = time.empty ? Json() : Json(time.previous);
  json["proposed"] = time.empty ? Json() : Json(time.proposed);
  json["control"] = time.empty ? Json() : Json(time.control);
  return json;
}

Json to_json_value(const Verdict& verdict) {
  return {{"number", verdict.number},   {"claim", verdict.claim},
          {"test", verdict.test},       {"outcome", name(verdict.outcome)},
          {"figures", verdict.figures}, {"paper", verdict.paper}};
}

Json to_json_value(const ReadingStudy& reading);
Json to_json_value(const TreeStudy& tree);

template <class Range>
Json list(const Range& values) {
  Json list = Json::array();
  for (const auto& value : values) list.push_back(to_json_value(value));
  return list;
}

Json to_json_value(const ReadingStudy& reading) {
  return {{"falloff", reading.reading.falloff},       {"spread", name(reading.reading.spread)},
          {"density", name(reading.reading.density)}, {"table1", list(reading.table1)},
          {"figure11", list(reading.figure11)},       {"figure13", list(reading.figure13)},
          {"figure15", list(reading.figure15)},       {"table2", list(reading.table2)},
          {"verdicts", list(reading.verdicts)}};
}

/// Rows of bands, with p1 and p2 as deviations or in percent, and claim 2b.
Json list(const BandStudy& band, const std::vector<BandRow>& rows) {
  Json list = Json::array();
  for (const BandRow& row : rows) {
    Json json = {{"band_low", row.band.low}, {"band_high", row.band.high}};
    json.update(to_json_value(row.row));
    json["claim_2b"] = name(intermediate(band, row.row));
    list.push_back(std::move(json));
  }
  return list;
}

Json to_json_value(const BandStudy& band) {
  Json json = {{"falloff", kBandReading.falloff}, {"evenness", band.evenness}};
  const bool is_fitted = band.failure.empty();
  json["failure"] = is_fitted ? Json() : Json(band.failure);
  if (!is_fitted) return json;
  json["threshold"] = band.threshold;
  json["leaf_scale"] = band.leaf_scale;
  json["ends"] = list(std::array{band.isotropic, band.uncontrolled});
  json["by_share"] = list(band, band.by_share);
  json["by_deviation"] = list(band, band.by_deviation);
  return json;
}

Json to_json_value(const TreeStudy& tree) {
  Json json = {{"name", tree.name}, {"leaves", tree.leaves}, {"leaf_vertices", tree.leaf_vertices}};
  json["bounds"] =
      tree.bounds.empty() ? Json() : list(std::array{tree.bounds.low, tree.bounds.high});
  json["seconds"] = tree.seconds;
  json["band"] = to_json_value(tree.band);
  json["readings"] = list(tree.readings);
  return json;
}

}  // namespace

std::string study_json(const Study& study) {
  const Json json = {{"schema", "leafhull-study/1"}, {"version", study.version},
                     {"date", study.date},           {"command", study.command},
                     {"machine", study.machine},     {"device", study.device},
                     {"seconds", study.seconds},     {"trees", list(study.trees)}};
  // A path may hold bytes that are no UTF-8; JSON may not.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace leafhull
