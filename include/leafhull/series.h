// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

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
  /// Why the entry could not be computed, such as a resolution that does not fit in memory: the
  /// report then holds its options and grid alone. Empty where it was computed.
  std::string failure;
};

/// Told of each entry as soon as it is done, `index` into the series' options; false ends the
/// series.
using SeriesVisitor = std::function<bool(std::size_t index, SeriesEntry&& entry)>;

/// Looks at the options of a series and at what they mean on this tree, before any work is done.
/// @throws Error as extract does of its options and of the crown.
void check_series(const LeafSet& leaves, std::span<const Options> options);

/// Extracts one tree with each of `options`, in the order in which neighbours share the most: the
/// hash, N_iso, the kernels, and one field for all thresholds. An entry without a surface is empty,
/// and one that cannot be computed says why: neither ends the series.
/// @throws Error as check_series does, before the first entry; device.
void extract_series(const LeafSet& leaves, std::span<const Options> options, Device& device,
                    const SeriesVisitor& visit, const Progress& progress = {});

}  // namespace leafhull
