// SPDX-License-Identifier: Apache-2.0
#include "sweep/tables.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "output/report.h"
#include "sweep/sweep_plan.h"

namespace leafhull {
namespace {

/// A column of the table: its head, and a combination's entry.
struct Column {
  std::string head;
  std::function<Json(std::size_t combination, const Json& row)> entry;
};

/// A cell of the table, quoted as RFC 4180 says where it has to be.
std::string cell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  auto text = value.get<std::string>();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// The keys that any row has in `part`, in the order of their first appearance.
std::vector<std::string> keys(const std::map<std::size_t, Json>& rows, const char* part) {
  std::vector<std::string> keys;
  for (const auto& [combination, row] : rows) {
    for (const auto& [key, value] : row[part].items()) {
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  }
  return keys;
}

std::vector<Column> columns(const SweepPlan& plan, const std::map<std::size_t, Json>& rows) {
  std::vector<Column> columns;
  std::vector<std::string> taken = {"leaves", "ellipse", "threshold"};
  for (std::size_t i = 0; i < plan.swept().size(); ++i) {
    taken.push_back(to_key(plan.swept()[i].row->name));
    columns.push_back({taken.back(), [&plan, i](std::size_t combination, const Json&) {
                         return Json(values_of(plan, combination)[i]);
                       }});
  }
  const auto add = [&](const std::string& head, const char* part, const std::string& key) {
    columns.push_back(
        {head, [part, key](std::size_t, const Json& row) { return row[part].value(key, Json()); }});
  };
  const auto add_all = [&](const char* part, const std::string& prefix = {}) {
    for (const std::string& key : keys(rows, part)) add(prefix + key, part, key);
  };
  add("T", "parameters", "threshold");
  add_all("metrics");
  add_all("counts");
  add_all("density", "density_");
  for (const std::string& key : keys(rows, "parameters")) {
    if (std::ranges::find(taken, key) == taken.end()) add(key, "parameters", key);
  }
  add_all("seconds", "seconds_");
  for (const char* key : {"empty", "failure", "picture"}) {
    columns.push_back(
        {key, [key](std::size_t, const Json& row) { return row.value(key, Json()); }});
  }
  return columns;
}

}  // namespace

Json row_of(std::size_t combination, const std::string& picture, const SeriesEntry& entry) {
  Json whole = report_object(entry.report, {});
  Json row = {{"row", combination}, {"picture", picture}, {"empty", entry.empty()}};
  row["failure"] = entry.failure.empty() ? Json() : Json(entry.failure);
  for (const char* part : {"parameters", "metrics", "counts", "density", "seconds"}) {
    row[part] = std::move(whole[part]);
  }
  // An evaluation serves several combinations, and other ones where the sweep was cut off.
  row["counts"].erase("evaluated_voxels");
  row["counts"].erase("evaluated_pairs");
  if (!entry.failure.empty()) {
    row["parameters"]["threshold"] = nullptr;
    for (const char* part : {"metrics", "counts", "density"}) {
      for (Json& value : row[part]) value = nullptr;
    }
  }
  return row;
}

std::string failure_of(const Json& row) {
  const auto failure = row.find("failure");
  return failure != row.end() && failure->is_string() ? failure->get<std::string>() : "";
}

std::string csv(const SweepPlan& plan, const std::map<std::size_t, Json>& rows) {
  const std::vector<Column> table = columns(plan, rows);
  std::string text;
  for (const Column& column : table) text += (text.empty() ? "" : ",") + column.head;
  for (const auto& [combination, row] : rows) {
    text += "\n";
    for (const Column& column : table) {
      if (&column != table.data()) text += ",";
      text += cell(column.entry(combination, row));
    }
  }
  return text + "\n";
}

std::string sweep_json(const Json& identity, const std::map<std::size_t, Json>& rows,
                       const RunDescription& run) {
  Json json = {{"schema", "leafhull-sweep/1"},
               {"version", identity["version"]},
               {"input", run.input},
               {"command", run.command},
               {"device", identity["device"]},
               {"swept", identity["swept"]},
               {"options", identity["options"]},
               {"rows", Json::array()}};
  for (const auto& [combination, row] : rows) {
    json["rows"].push_back(row);
    json["rows"].back().erase("row");
  }
  return dumped(json, 2) + "\n";
}

}  // namespace leafhull
