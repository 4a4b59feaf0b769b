// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "leafhull/study.h"

namespace leafhull {

/// How a band study reads the paper's open points.
inline constexpr Reading kBandReading{.falloff = 1};

/// "80–100%", "0 to 2 s".
std::string name(const Band& band);

// The ratios of a row that can be compared between trees.

/// The row's off-site vertices over the leaf vertices.
double share_lost(const StudyRow& row, std::uint64_t leaf_vertices);
/// The row's dilated voxels over those of L&D; not finite if L&D has none.
double share_dilated(const StudyRow& row, const StudyRow& isotropic);

/// Fits T and the leaf scale, then moves the band.
/// @throws Error as extract does, except for an empty surface.
BandStudy study_band(const LeafSet& leaves, Device& device);

}  // namespace leafhull
