// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "leafhull/shape.h"
#include "leafhull/study.h"

namespace leafhull {

inline constexpr int kResolution = 64;  ///< everywhere except in Table 2. Source: p. 53
inline constexpr int kTable2Resolutions[] = {32, 64, 128};

/// The middle values of Figures 11, 13 and 15. Table 1 uses them too, as the paper does not state
/// its values; all its methods use the same T, or they could not be compared.
inline constexpr double kThreshold = 2, kRadiusMax = 1.5, kFlatness = 0.7;

/// The tables and figures of a reading with their parameters, nothing measured yet.
ReadingStudy planned(const Reading& reading);

/// The options with which extract computes a row.
Options options_of(const StudyRow& row, const Reading& reading, int resolution = kResolution);

/// Extractions that serve all rows of some studies, each setting once.
struct Plan {
  std::vector<Options> options;
  std::vector<std::vector<StudyRow*>> rows;  ///< for each of `options`, the rows it serves
};

Plan plan(std::span<ReadingStudy> studies);

/// Fills in the metrics of a plan's rows; calls `each` with the report of every extraction.
/// @throws Error as extract does, except for an empty surface.
void measure(const Plan& plan, const LeafSet& leaves, Device& device,
             const std::function<void(const Report&)>& each);

}  // namespace leafhull
