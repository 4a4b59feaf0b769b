// SPDX-License-Identifier: Apache-2.0
#include "sweep/journal.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "sweep/sweep_plan.h"

namespace leafhull {
namespace {

/// Every journal of a sweep has this in its first line, even one damaged or of another version.
constexpr std::string_view kAnySchema = "leafhull-sweep-journal/";

bool is_row(const Json& line) {
  return line.contains("row") && line["row"].is_number_unsigned() && line.contains("picture") &&
         line["picture"].is_string();
}

}  // namespace

Journal::Journal(const std::filesystem::path& file) : lines_(file, "another sweep") {
  if (lines_.empty()) return;
  const std::vector<std::string>& lines = lines_.lines();
  const std::string first = lines.empty() ? "" : lines.front();
  header_ = unsealed(first).value_or(Json::object());
  is_readable_ = header_.value("schema", Json()) == kJournalSchema;
  if (!is_readable_ && first.find(kAnySchema) == std::string::npos) {
    throw Error(ErrorCode::usage, file.string() + " is not the journal of a sweep",
                "Name another folder, or move that file away.");
  }
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::optional<Json> row = unsealed(lines[i]);
    if (!row || !is_row(*row)) continue;
    const auto combination = row->at("row").get<std::size_t>();
    rows_.insert_or_assign(combination, std::move(*row));
  }
}

void Journal::begin(const Json& header) {
  lines_.clear();
  rows_.clear();
  header_ = Json();
  lines_.append(header);
  header_ = header;
  is_readable_ = true;
}

void Journal::append(Json row) {
  lines_.append(row);
  rows_.insert_or_assign(row["row"].get<std::size_t>(), std::move(row));
}

}  // namespace leafhull
