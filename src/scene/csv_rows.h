// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/scatter_row.h"

namespace leafhull {

/// Reads the lines of a .csv one after the other. The first tells the separator and names the
/// columns, in any order; or its second field is a number, and the columns are known by their
/// count.
class CsvRows {
 public:
  /// False where `line` names the columns. It is rewritten.
  /// @throws BadRow.
  bool read(std::string& line, ScatterRow& row);

  /// Names of columns that say nothing here, for a warning; else empty.
  std::string passed_over() const;

 private:
  std::vector<int> named_columns();

  std::vector<int> columns_;  ///< by field, into kColumns; or none
  std::vector<std::string_view> fields_;
  std::vector<std::string> unknown_;
  char separator_ = ',';
  int rotation_ = -1, scale_ = -1;  ///< their kinds
};

}  // namespace leafhull
