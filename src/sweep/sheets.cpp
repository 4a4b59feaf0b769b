// SPDX-License-Identifier: Apache-2.0
#include "sweep/sheets.h"

#include <algorithm>
#include <cmath>

#include "sweep/sweep_plan.h"

namespace leafhull {
namespace {

constexpr std::size_t kMostColumns = 10;
constexpr std::size_t kMostPerSheet = 80;

std::size_t quotient_up(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

std::string listed(const SweptOption& option) {
  constexpr std::size_t kMost = 4;
  std::string text = std::string(option.row->name) + " ";
  if (takes_number(*option.row) && option.values.size() > kMost) {
    return text + option.values.front() + " to " + option.values.back();
  }
  for (const std::string& value : option.values) {
    text += (&value == option.values.data() ? "" : ", ") + value;
  }
  return text;
}

}  // namespace

std::vector<Sheet> sheets(const SweepPlan& plan) {
  const auto columns = static_cast<std::size_t>(sheet_columns(plan));
  const std::size_t all = plan.combinations().size();
  const std::size_t rows = quotient_up(all, columns);
  const std::size_t count = quotient_up(rows, kMostPerSheet / columns);
  const std::size_t each = quotient_up(rows, count) * columns;
  if (count == 1) return {{"contact-sheet.png", 0, all}};
  std::vector<Sheet> sheets;
  const std::size_t width = std::to_string(count).size();
  for (std::size_t i = 0; i < count; ++i) {
    std::string number = std::to_string(i + 1);
    number.insert(0, width - number.size(), '0');
    sheets.push_back({"contact-sheet-" + number + ".png", std::min(all, i * each),
                      std::min(all, (i + 1) * each)});
  }
  return sheets;
}

int sheet_columns(const SweepPlan& plan) {
  const std::size_t last = plan.swept().back().values.size();
  if (last <= kMostColumns) return static_cast<int>(last);
  const double square = std::ceil(std::sqrt(static_cast<double>(plan.combinations().size())));
  return std::min(static_cast<int>(kMostColumns), static_cast<int>(square));
}

std::string sheet_title(const SweepPlan& plan, std::string_view tree) {
  std::string title;
  for (const SweptOption& option : plan.swept()) {
    title += (title.empty() ? std::string(tree) + ": " : "; ") + listed(option);
  }
  return title;
}

}  // namespace leafhull
