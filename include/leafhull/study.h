// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "leafhull/device.h"
#include "leafhull/leaves.h"
#include "leafhull/options.h"
#include "leafhull/picture.h"
#include "leafhull/shape.h"

namespace leafhull {

/// How the points that the paper leaves open are read. SPEC: 2, 3.
struct Reading {
  int falloff = 2;
  Spread spread = Spread::stddev;
  DensitySource density = DensitySource::exact;
};

/// One extraction of a study.
struct StudyRow {
  Method method = Method::controlled;
  double threshold = 0, radius_max = 0, flatness = 0;  ///< T, R_max in crown units, lambda_R
  bool empty = false;                                  ///< no sample reaches T
  Metrics metrics;
  std::uint64_t off_site() const { return metrics.off_site_sampled; }  ///< what Table 1 counts
};

/// Table 2: seconds at one resolution, the median of several runs.
struct StudyTime {
  int resolution = 0;
  double previous = 0;  ///< L&D: steps 1, 6 and 7 of Figure 8
  double proposed = 0;  ///< CTRLED: steps 1 to 7
};

/// One claim of the paper, held against one tree under one reading.
struct Verdict {
  std::string claim;  ///< what is claimed, one sentence
  std::string test;   ///< when it counts as holding, in terms of the figures
  bool holds = false;
  std::string figures;  ///< the numbers that decide
  std::string paper;    ///< the paper's own numbers; empty where it prints none
};

/// The paper's evaluation of one tree under one reading.
struct ReadingStudy {
  Reading reading;
  std::array<StudyRow, 3> table1;                      ///< by Method
  std::vector<StudyRow> figure11, figure13, figure15;  ///< over T, R_max, lambda_R; ascending
  std::vector<StudyTime> table2;
  std::vector<Verdict> verdicts;  ///< the same claims in the same order for every reading
};

struct TreeStudy {
  std::string name;  ///< the file's, without its folder
  std::uint64_t leaves = 0, leaf_vertices = 0;
  std::vector<ReadingStudy> readings;  ///< the project's own reading first
  /// In the project's own reading: the methods (Table 1), and what T, R_max and lambda_R do
  /// (Figures 12, 14, 16).
  std::vector<LabelledPicture> methods, figure12, figure14, figure16;
  std::array<Mesh, 3> meshes;  ///< by Method, of Table 1; empty meshes where there is no surface
  Box bounds;                  ///< of the leaf vertices
  double seconds = 0;          ///< what the tree took
};

struct Study {
  std::vector<TreeStudy> trees;
  std::string version, device, machine, date;  ///< date: YYYY-MM-DD
  std::vector<std::string> command;
  double seconds = 0;
};

}  // namespace leafhull
