// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "leafhull/api.h"
#include "leafhull/device.h"
#include "leafhull/leaves.h"
#include "leafhull/options.h"
#include "leafhull/progress.h"
#include "leafhull/shape.h"

namespace leafhull {

/// The result of one entry of a series.
struct SeriesEntry {
  /// The report of an extraction, with the same T, counts and metrics. But `evaluated_voxels` and
  /// `evaluated_pairs` serve several entries, and `seconds` is the time that this entry added.
  Report report;
  /// The surface where the lattice puts it: vertices are not moved onto N = T, and normals come
  /// from the faces around them. It has no vertices if no sample reaches T.
  Mesh mesh;
  bool empty() const { return mesh.positions.empty(); }
  /// Why the entry could not be computed, such as a resolution that does not fit in memory; the
  /// report then holds only its options and grid. Empty if it was computed.
  std::string failure;
};

/// Called with each entry as soon as it is done; `index` is into the series' options. Returning
/// false ends the series.
using SeriesVisitor = std::function<bool(std::size_t index, SeriesEntry&& entry)>;

/// Extracts one tree with each of `options`, ordered so that neighbours share the most work: the
/// hash, N_iso, the kernels, and one field for all thresholds. An entry without a surface is empty,
/// and one that cannot be computed says why: neither ends the series.
/// @throws Error as extract does for its options and the crown, before any work is done; device.
LEAFHULL_API void extract_series(const LeafSet& leaves, std::span<const Options> options,
                                 Device& device, const SeriesVisitor& visit,
                                 const Progress& progress = {});

}  // namespace leafhull
