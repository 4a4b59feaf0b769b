// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "voxels.h"

namespace recount {

/// Compares the report with the recount and prints both, row by row.
class Table {
 public:
  /// Requires the report to lie between `low` and `high`.
  void compare(const std::string& quantity, double report, double recount, double low, double high);
  void compare(const std::string& quantity, double report, const Count& recount);
  void compare_near(const std::string& quantity, double report, double recount, double tolerance);
  /// Requires a recount that the report does not hold to lie between `low` and `high`.
  void require(const std::string& quantity, double recount, double low, double high);

  void print() const;
  bool agrees() const;

 private:
  struct Row {
    std::string quantity;
    std::optional<double> report;
    double recount, low, high;
    bool agrees() const;
  };
  std::vector<Row> rows_;
};

}  // namespace recount
