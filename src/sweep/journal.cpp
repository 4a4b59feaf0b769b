// SPDX-License-Identifier: Apache-2.0
#include "sweep/journal.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "sweep/sweep_plan.h"

namespace leafhull {

Journal::Journal(const std::filesystem::path& file) : lines_(file, "another sweep") {
  if (lines_.empty()) return;
  const std::vector<std::string>& lines = lines_.lines();
  header_ = unsealed(lines.empty() ? "" : lines.front()).value_or(Json::object());
  if (header_.value("schema", Json()) != kJournalSchema) {
    throw Error(ErrorCode::usage, file.string() + " is not the journal of a sweep",
                "Name another folder, or move that file away.");
  }
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::optional<Json> row = unsealed(lines[i]);
    if (row && row->contains("row"))
      rows_.insert_or_assign(row->at("row").get<std::size_t>(), std::move(*row));
  }
}

void Journal::begin(const Json& header) {
  lines_.clear();
  rows_.clear();
  header_ = Json();
  lines_.append(header);
  header_ = header;
}

void Journal::append(Json row) {
  lines_.append(row);
  rows_.insert_or_assign(row["row"].get<std::size_t>(), std::move(row));
}

}  // namespace leafhull
