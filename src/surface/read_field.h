// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "density/field.h"

namespace leafhull {

/// A density from a file, on a lattice whose origin is at `origin`, model units.
struct FieldFile {
  Field field;
  Vec3d origin;
};

/// Reads grids made by density_grid(), and density grids from elsewhere: the one named `density`,
/// or the only grid of floats. T is `threshold`, else the grid's own.
/// @throws Error input: the file, its grid or the grid's transform; usage: no T, or not the T that
/// the grid was sampled for; empty: nothing reaches T.
FieldFile read_field(const std::filesystem::path& file, std::optional<double> threshold);

}  // namespace leafhull
