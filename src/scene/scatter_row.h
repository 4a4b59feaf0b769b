// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/scene.h"
#include "text/choice.h"

namespace leafhull {

/// A quaternion of any length.
struct Rotation {
  double x = 0, y = 0, z = 0, w = 1;
};

/// A rotation about +y, right-handed.
Rotation rotation_of_yaw(double degrees);

/// A rotation about x, then y, then z, in degrees: the Euler angles XYZ of Blender.
Rotation rotation_of_angles(Vec3d degrees);

/// A line of a scatter file.
struct ScatterRow {
  std::string model;  ///< a tree file, as written
  Vec3d position;
  Rotation rotation;
  Vec3d scale{1, 1, 1};
};

/// What is wrong with a line; the line's reader knows where it is.
struct BadRow {
  std::string what, remedy;
};

/// The tree of a row, scaled, rotated and moved; its model is set later.
PlacedTree placed(const ScatterRow& row);

/// Reads the lines of a .csv file one after the other. The first line gives the separator and names
/// the columns in any order; where its second field is a number, the columns follow from their
/// count.
class CsvRows {
 public:
  /// Returns false where `line` names the columns. `line` is rewritten.
  /// @throws BadRow.
  bool read(std::string& line, ScatterRow& row);

  /// Names of the columns that were ignored, for a warning; else empty.
  std::string passed_over() const { return joined(unknown_, ", "); }

 private:
  std::vector<int> named_columns();

  std::vector<int> columns_;  ///< by field, into kColumns; or none
  std::vector<std::string_view> fields_;
  std::vector<std::string> unknown_;
  char separator_ = ',';
  int rotation_ = -1, scale_ = -1;  ///< their kinds
};

/// Reads the lines of a .jsonl file one after the other, each an object.
class JsonRows {
 public:
  /// @returns true. @throws BadRow.
  bool read(std::string& line, ScatterRow& row);

  /// Names of the members that were ignored, for a warning; else empty.
  std::string passed_over() const { return joined(unknown_, ", "); }

 private:
  std::set<std::string> unknown_;
};

}  // namespace leafhull
