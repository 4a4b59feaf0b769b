// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "voxels.h"

namespace recount {

/// What the report says beside what the recount finds; printed row by row.
class Table {
 public:
  /// The report must lie between `low` and `high`.
  void compare(const std::string& quantity, double report, double recount, double low, double high);
  void compare(const std::string& quantity, double report, const Count& recount);
  void compare_near(const std::string& quantity, double report, double recount, double tolerance);
  /// The recount, of something that the report does not hold, must lie between `low` and `high`.
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
