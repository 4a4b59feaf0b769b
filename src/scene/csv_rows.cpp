// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>

#include "scene/csv.h"
#include "scene/scatter_row.h"
#include "text/numbers.h"
#include "text/text.h"

namespace leafhull {
namespace {

enum Column { kModel, kX, kY, kZ, kQx, kQy, kQz, kQw, kYaw, kRx, kRy, kRz, kScale, kSx, kSy, kSz };

constexpr std::array<std::string_view, 16> kColumns{"model", "x",  "y",   "z",  "qx", "qy",
                                                    "qz",    "qw", "yaw", "rx", "ry", "rz",
                                                    "scale", "sx", "sy",  "sz"};

/// Columns that come together.
struct Group {
  Column first, last;
};
constexpr std::array<Group, 2> kRequired{{{kModel, kModel}, {kX, kZ}}};
constexpr std::array<Group, 3> kRotations{{{kQx, kQw}, {kYaw, kYaw}, {kRx, kRz}}};
constexpr std::array<Group, 2> kScales{{{kScale, kScale}, {kSx, kSz}}};
enum RotationKind { kQuaternion, kAboutY, kAngles };
enum ScaleKind { kUniform, kPerAxis };

constexpr const char* kNameThem =
    "Name the columns in the first line: model,x,y,z,qx,qy,qz,qw,scale.";

int column_called(std::string_view name) {
  std::string lower = in_lower_case(std::string(name));
  if (lower.starts_with("position_")) lower.erase(0, 9);
  const auto found = std::ranges::find(kColumns, lower);
  return found == kColumns.end() ? -1 : static_cast<int>(found - kColumns.begin());
}

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  return parsed<double>(text);
}

bool has_decimal_comma(std::string_view text) {
  std::string with_point(text);
  std::ranges::replace(with_point, ',', '.');
  return with_point != text && number_in(with_point);
}

double number(std::string_view text, int column) {
  const std::optional<double> value = number_in(text);
  if (value) return *value;
  if (has_decimal_comma(text)) {
    throw BadRow{'"' + printable(text) + "\" in column " + std::string(kColumns[column]) +
                     " has a decimal comma",
                 "Write a decimal point, as in 1.5."};
  }
  throw BadRow{
      '"' + printable(text) + "\" in column " + std::string(kColumns[column]) + " is not a number",
      "Write numbers such as 1.5."};
}

/// The columns of a file that names none, by their count.
std::vector<int> usual_columns(std::size_t count) {
  std::vector<int> columns = {kModel, kX, kY, kZ};
  if (count > 4) columns.insert(columns.end(), {kQx, kQy, kQz, kQw});
  if (count == 9) columns.push_back(kScale);
  if (count == 11) columns.insert(columns.end(), {kSx, kSy, kSz});
  if (columns.size() != count) {
    throw BadRow{"has " + std::to_string(count) + " fields, not 4, 8, 9 or 11", kNameThem};
  }
  return columns;
}

/// Whether the columns of a group are named.
bool has(const std::vector<int>& columns, Group group) {
  int named = 0, missing = 0;
  for (int column = group.first; column <= group.last; ++column) {
    const auto count = std::ranges::count(columns, column);
    if (count > 1) {
      throw BadRow{"names the column " + std::string(kColumns[column]) + " twice", "Name it once."};
    }
    count == 1 ? ++named : missing = column;
  }
  if (named > 0 && named <= group.last - group.first) {
    throw BadRow{"names no column " + std::string(kColumns[missing]), kNameThem};
  }
  return named > 0;
}

/// Which of several groups is named; -1: none.
template <std::size_t kCount>
int kind_of(const std::vector<int>& columns, const std::array<Group, kCount>& groups) {
  int kind = -1;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (!has(columns, groups[i])) continue;
    if (kind >= 0) {
      throw BadRow{"names both " + std::string(kColumns[groups[kind].first]) + " and " +
                       std::string(kColumns[groups[i].first]),
                   "Leave one of them out."};
    }
    kind = static_cast<int>(i);
  }
  return kind;
}

}  // namespace

bool CsvRows::read(std::string& line, ScatterRow& row) {
  if (columns_.empty()) separator_ = separator_of(line);
  split_csv(line, separator_, fields_);
  if (columns_.empty()) {
    const bool named =
        fields_.size() < 2 || (!number_in(fields_[1]) && !has_decimal_comma(fields_[1]));
    columns_ = named ? named_columns() : usual_columns(fields_.size());
    rotation_ = kind_of(columns_, kRotations);
    scale_ = kind_of(columns_, kScales);
    if (named) return false;
  }
  if (fields_.size() != columns_.size()) {
    throw BadRow{"has " + std::to_string(fields_.size()) + " fields where the first line has " +
                     std::to_string(columns_.size()),
                 "Write a field for each column."};
  }

  std::array<double, kColumns.size()> v{};
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (columns_[i] == kModel) {
      row.model = fields_[i];
    } else if (columns_[i] >= 0) {
      v[columns_[i]] = number(fields_[i], columns_[i]);
    }
  }
  row.position = {v[kX], v[kY], v[kZ]};
  row.rotation = rotation_ == kQuaternion ? Rotation{v[kQx], v[kQy], v[kQz], v[kQw]}
                 : rotation_ == kAboutY   ? rotation_of_yaw(v[kYaw])
                 : rotation_ == kAngles   ? rotation_of_angles({v[kRx], v[kRy], v[kRz]})
                                          : Rotation{};
  row.scale = scale_ == kUniform   ? Vec3d(v[kScale], v[kScale], v[kScale])
              : scale_ == kPerAxis ? Vec3d(v[kSx], v[kSy], v[kSz])
                                   : Vec3d(1, 1, 1);
  return true;
}

std::vector<int> CsvRows::named_columns() {
  std::vector<int> columns;
  for (const std::string_view name : fields_) {
    columns.push_back(column_called(name));
    if (columns.back() < 0) unknown_.push_back('"' + printable(name) + '"');
  }
  for (const Group group : kRequired) {
    if (has(columns, group)) continue;
    throw BadRow{"names no column " + std::string(kColumns[group.first]), kNameThem};
  }
  return columns;
}

}  // namespace leafhull
