// SPDX-License-Identifier: Apache-2.0
#include "output/report.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "colour/colour.h"
#include "leafhull/output.h"
#include "leafhull/version.h"

namespace leafhull {
namespace {

using Json = nlohmann::ordered_json;

/// The options; those that an extraction derives have the values that it used.
Json parameters(const Report& report) {
  Json parameters = options_object(report.options);
  parameters["threshold"] = report.threshold;
  parameters["threshold_percent"] = to_json_value(report.options.threshold_percent);
  parameters["coverage"] = to_json_value(report.options.coverage);
  parameters["radius_max_model"] = report.radius_max_model;
  parameters["resolution"] = report.resolution;
  parameters["voxel_size"] = report.voxel_size;
  return parameters;
}

Json counts(const Report& report) {
  const Counts& counts = report.counts;
  return {{"leaves", counts.leaves},
          {"leaf_vertices", counts.leaf_vertices},
          {"leaf_points", counts.leaf_points},
          {"leaf_area", report.leaf_area},
          {"leaf_colour", report.leaf_colour ? Json(hex_of(*report.leaf_colour)) : Json()},
          {"dropped_leaves", counts.dropped_leaves},
          {"split_components", counts.split_components},
          {"evaluated_voxels", counts.evaluated_voxels},
          {"evaluated_pairs", counts.evaluated_pairs},
          {"mesh_vertices", counts.mesh_vertices},
          {"mesh_triangles", counts.mesh_triangles},
          {"components", counts.components},
          {"dropped_components", counts.dropped_components}};
}

Json density(const DensityStatistics& density) {
  return {{"mean", density.mean},
          {"variance", density.variance},
          {"deviation", std::sqrt(density.variance)},
          {"p1", density.p1},
          {"p2", density.p2}};
}

Json metrics(const Report& report) {
  const Metrics& metrics = report.metrics;
  return {{"dilated_voxels", metrics.dilated_voxels},
          {"inside_voxels", metrics.inside_voxels},
          {"on_voxels", metrics.on_voxels},
          {"off_site_exact", metrics.off_site_exact},
          {"off_site_sampled", metrics.off_site_sampled},
          {"covered", report.covered},
          {"erosion", metrics.erosion},
          {"dilation", metrics.dilation}};
}

}  // namespace

Json to_json_value(const TextureEllipse& ellipse) {
  return {ellipse.centre.x, ellipse.centre.y, ellipse.a.x, ellipse.a.y, ellipse.b.x, ellipse.b.y};
}

Json to_json_value(const Srgb& colour) { return hex_of(colour); }

Json to_json_value(const LeafColour& colour) {
  const std::string text = hex_of(colour.srgb);
  return colour.tolerance > 0 ? Json{text, colour.tolerance} : Json(text);
}

std::string to_key(std::string_view name) {
  std::string key(name);
  std::ranges::replace_if(
      key, [](char character) { return character == '-' || character == ' '; }, '_');
  return key;
}

Json options_object(const Options& options) { return rows_object(option_table(), options); }

Json seconds_object(const std::vector<StageTime>& times) {
  Json seconds = Json::object();
  for (const StageTime& time : times) {
    const std::string key = to_key(time.stage);
    seconds[key] = seconds.value(key, 0.0) + time.seconds;
  }
  return seconds;
}

void add_stage(std::vector<StageTime>& times, const std::string& stage, double seconds) {
  if (times.empty()) times.push_back({"total", 0});
  times.back().seconds += seconds;
  times.insert(times.end() - 1, {stage, seconds});
}

Json report_object(const Report& report, const RunDescription& run) {
  return {{"schema", "leafhull-report/1"},
          {"version", kVersion},
          {"input", run.input},
          {"command", run.command},
          {"parameters", parameters(report)},
          {"device", report.device},
          {"counts", counts(report)},
          {"density", density(report.density)},
          {"metrics", metrics(report)},
          {"seconds", seconds_object(report.seconds)},
          {"peak_memory_bytes", report.peak_memory_bytes},
          {"warnings", report.warnings}};
}

std::string report_json(const Report& report, const RunDescription& run) {
  // A path may hold bytes that are not UTF-8; JSON may not.
  return report_object(report, run).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace leafhull
