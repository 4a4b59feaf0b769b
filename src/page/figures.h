// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/study.h"

namespace leafhull {

/// A parameter of the paper and the two figures that vary it: numbers, and pictures.
struct ParameterFigures {
  int curves, pictures;  ///< the paper's numbers of the figures
  std::string_view symbol, meaning, axis;
  std::vector<StudyRow> ReadingStudy::*rows;
  double StudyRow::*value;
  std::vector<LabelledPicture> TreeStudy::*sheet;
};

extern const std::array<ParameterFigures, 3> kParameterFigures;

/// "k = 2, standard deviation, exact density".
std::string reading_name(const Reading& reading);

/// The plots of one tree as SVG, by parameter: in the first reading, and in all of them; and as the
/// band moves, empty where nothing could be fitted.
struct TreePlots {
  std::array<std::string, 3> first, all;
  std::string band;
};

/// Dilated voxels and off-site vertices of CTRLED over each parameter, a line for each reading, and
/// the first over the second as the band moves; no plots where the program that draws them is
/// missing.
/// @throws Error output: it fails.
std::vector<TreePlots> draw_plots(const Study& study);

}  // namespace leafhull
