// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

#include "leafhull/options.h"
#include "leafhull/output.h"

namespace leafhull {

// Options as reports have them; a type of its own has to_json_value() beside what reports it.

nlohmann::ordered_json to_json_value(const TextureEllipse& ellipse);
nlohmann::ordered_json to_json_value(const Srgb& colour);
nlohmann::ordered_json to_json_value(const LeafColour& colour);

template <class Value>
nlohmann::ordered_json to_json_value(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return name(value);
  } else if constexpr (std::is_same_v<Value, ByteCount>) {
    return value.bytes;
  } else if constexpr (std::is_same_v<Value, std::filesystem::path>) {
    return value.string();
  } else {
    return value;
  }
}

template <class Value>
nlohmann::ordered_json to_json_value(const std::optional<Value>& value) {
  return value ? to_json_value(*value) : nlohmann::ordered_json();
}

/// The name of an option or a stage, with underscores.
std::string to_key(std::string_view name);

/// Every option of the rows by its key; a size in memory is `NAME_bytes`.
template <class Struct, class... Members>
nlohmann::ordered_json rows_object(std::span<const RowOf<Struct, Members...>> rows,
                                   const Struct& options) {
  nlohmann::ordered_json object;
  for (const auto& row : rows) {
    std::visit(
        [&](auto part) {
          constexpr bool kIsSize =
              std::is_same_v<std::remove_cvref_t<decltype(options.*part)>, ByteCount>;
          object[to_key(row.name) + (kIsSize ? "_bytes" : "")] = to_json_value(options.*part);
        },
        row.member);
  }
  return object;
}

/// Every option of an extraction.
nlohmann::ordered_json options_object(const Options& options);

/// Seconds by stage; runs of the same stage are summed.
nlohmann::ordered_json seconds_object(const std::vector<StageTime>& times);

/// Adds a stage before the total, and to it. `times` ends with the total or is empty.
void add_stage(std::vector<StageTime>& times, const std::string& stage, double seconds);

/// The report as `report_json` prints it.
nlohmann::ordered_json report_object(const Report& report, const RunDescription& run);

}  // namespace leafhull
