// SPDX-License-Identifier: Apache-2.0
#include "sweep/journal.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "sweep/plan.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

Json parsed(std::string_view line) { return Json::parse(line, nullptr, false); }

/// The input's name need not be UTF-8.
std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool is_row(const Json& line) {
  return line.is_object() && line.contains("row") && line["row"].is_number_unsigned() &&
         line.contains("picture") && line["picture"].is_string();
}

bool is_header(const Json& line) {
  return line.is_object() && line.contains("schema") && line["schema"] == kJournalSchema;
}

}  // namespace

Journal::Journal(const fs::path& file) : lines_(file, "another sweep") {
  const std::vector<std::string>& lines = lines_.lines();
  if (!lines.empty()) header_ = parsed(lines.front());
  if (!lines_.empty() && !is_header(header_)) {
    throw Error(ErrorCode::usage, file.string() + " is not the journal of a sweep",
                "Name another folder, or move that file away.");
  }
  for (std::size_t i = 1; i < lines.size(); ++i) {
    Json line = parsed(lines[i]);
    if (is_row(line)) rows_.insert_or_assign(line["row"].get<std::size_t>(), std::move(line));
  }
}

void Journal::begin(const Json& header) {
  lines_.clear();
  rows_.clear();
  header_ = Json();
  lines_.append(line_of(header));
  header_ = header;
}

void Journal::append(Json row) {
  lines_.append(line_of(row));
  rows_.insert_or_assign(row["row"].get<std::size_t>(), std::move(row));
}

}  // namespace leafhull
