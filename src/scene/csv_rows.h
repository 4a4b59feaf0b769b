// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/scatter_row.h"

namespace leafhull {

/// Reads the lines of a .csv file one after the other. The first line gives the separator and names
/// the columns in any order; where its second field is a number, the columns follow from their
/// count.
class CsvRows {
 public:
  /// Returns false where `line` names the columns. `line` is rewritten.
  /// @throws BadRow.
  bool read(std::string& line, ScatterRow& row);

  /// Names of the columns that were ignored, for a warning; else empty.
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
