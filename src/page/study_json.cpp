// SPDX-License-Identifier: Apache-2.0
#include "page/study_json.h"

#include <nlohmann/json.hpp>

#include "study/band_study.h"
#include "study/verdicts.h"

namespace leafhull {
namespace {

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

}  // namespace

std::string study_json(const Study& study) {
  const OrderedJson json = {{"schema", "leafhull-study/1"}, {"version", study.version},
                            {"date", study.date},           {"command", study.command},
                            {"machine", study.machine},     {"device", study.device},
                            {"seconds", study.seconds},     {"trees", list(study.trees)}};
  // A path may hold bytes that are not UTF-8; JSON may not.
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace leafhull
