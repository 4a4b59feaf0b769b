// SPDX-License-Identifier: Apache-2.0
#include "table.h"

#include <algorithm>
#include <cstdio>

namespace recount {

bool Table::Row::agrees() const {
  const double value = report.value_or(recount);
  return low <= value && value <= high;
}

void Table::compare(const std::string& quantity, double report, double recount, double low,
                    double high) {
  rows_.push_back({quantity, report, recount, low, high});
}

void Table::compare(const std::string& quantity, double report, const Count& recount) {
  compare(quantity, report, double(recount.exact), double(recount.low), double(recount.high));
}

void Table::compare_near(const std::string& quantity, double report, double recount,
                         double tolerance) {
  compare(quantity, report, recount, recount - tolerance, recount + tolerance);
}

void Table::require(const std::string& quantity, double recount, double low, double high) {
  rows_.push_back({quantity, {}, recount, low, high});
}

void Table::print() const {
  std::printf("%-34s %14s %14s %11s  %s\n", "quantity", "report", "recount", "difference",
              "allowed");
  for (const Row& row : rows_) {
    std::printf("%-34s ", row.quantity.c_str());
    if (row.report) {
      std::printf("%14.9g %14.9g %11.3g", *row.report, row.recount, *row.report - row.recount);
    } else {
      std::printf("%14s %14.9g %11s", "", row.recount, "");
    }
    std::printf("  %.9g .. %.9g%s\n", row.low, row.high, row.agrees() ? "" : "  DIFFERS");
  }
}

bool Table::agrees() const {
  return std::all_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.agrees(); });
}

}  // namespace recount
