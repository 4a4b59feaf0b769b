// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/study.h"

namespace leafhull {

/// A parameter of the paper and the two figures that vary it: one of numbers, one of pictures.
struct ParameterFigures {
  int curves, pictures;  ///< the figures' numbers in the paper
  std::string_view symbol, meaning, axis;
  std::vector<StudyRow> ReadingStudy::*rows;
  double StudyRow::*value;
  std::vector<LabelledPicture> TreeStudy::*sheet;
};

extern const std::array<ParameterFigures, 3> kParameterFigures;

/// "k = 2, standard deviation, exact density".
std::string reading_name(const Reading& reading);

/// The plots of one tree as SVG: by parameter, in the first reading and in all readings; and as the
/// band moves, which is empty if nothing could be fitted.
struct TreePlots {
  std::array<std::string, 3> first, all;
  std::string band;
};

/// Plots dilated voxels and off-site vertices of CTRLED over each parameter, a line for each
/// reading, and the voxels over the vertices as the band moves. There are none without gnuplot.
/// @throws Error output: gnuplot fails.
std::vector<TreePlots> draw_plots(const Study& study);

}  // namespace leafhull
