// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "leafhull/device.h"
#include "leafhull/leaves.h"
#include "leafhull/options.h"
#include "leafhull/shape.h"

namespace leafhull {

/// What one entry of a series came to.
struct SeriesEntry {
  /// As an extraction's: the same T, counts and metrics, but for `evaluated_voxels` and
  /// `evaluated_pairs`, which serve several entries, and `seconds`, what this entry took beyond the
  /// ones before it.
  Report report;
  /// The surface where the lattice puts it: not moved onto N = T, normals of the faces around a
  /// vertex. Without vertices where no sample reaches T.
  Mesh mesh;
  bool empty() const { return mesh.positions.empty(); }
};

/// Told of each entry as soon as it is done, `index` into the series' options; false ends the
/// series.
using SeriesVisitor = std::function<bool(std::size_t index, SeriesEntry&& entry)>;

/// Extracts one tree with each of `options`, in the order in which neighbours share the most: the
/// hash, N_iso, the kernels, and one field for all thresholds. An entry without a surface is empty,
/// not an error.
/// @throws Error as extract does, usage of any of `options` before the first entry.
void extract_series(const LeafSet& leaves, std::span<const Options> options, Device& device,
                    const SeriesVisitor& visit, const Progress& progress = {});

}  // namespace leafhull
