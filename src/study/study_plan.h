// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "leafhull/study.h"

namespace leafhull {

inline constexpr int kResolution = 64;  ///< of all but Table 2. Source: p. 53
inline constexpr int kTable2Resolutions[] = {32, 64, 128};

/// The middles of Figures 11, 13 and 15. Table 1 takes them too, where the paper says nothing, and
/// all its methods take one T: only so do they compare.
inline constexpr double kThreshold = 2, kRadiusMax = 1.5, kFlatness = 0.7;

/// The tables and figures of a reading with their parameters, nothing measured yet.
ReadingStudy planned(const Reading& reading);

/// What a row asks of extract.
Options options_of(const StudyRow& row, const Reading& reading, int resolution = kResolution);

/// Extractions that serve all rows of some studies, each setting once.
struct Plan {
  std::vector<Options> options;
  std::vector<std::vector<StudyRow*>> rows;  ///< as many: whose metrics these are
};

Plan plan(std::span<ReadingStudy> studies);

}  // namespace leafhull
