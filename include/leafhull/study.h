// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/api.h"
#include "leafhull/device.h"
#include "leafhull/leaves.h"
#include "leafhull/options.h"
#include "leafhull/output.h"
#include "leafhull/picture.h"
#include "leafhull/progress.h"
#include "leafhull/shape.h"

namespace leafhull {

/// A reading of the points that the paper leaves open. SPEC: 2, 3.
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

/// Table 2: seconds at one resolution, medians of `runs` extractions.
struct StudyTime {
  int resolution = 0;
  int runs = 0;
  bool empty = false;   ///< one of the two has no surface: there are no seconds
  double previous = 0;  ///< L&D: seconds for steps 1, 6 and 7 of Figure 8
  double proposed = 0;  ///< CTRLED: seconds for steps 1 to 7
  double control = 0;   ///< the part of `proposed` for steps 2 to 5
};

/// Whether a claim holds; open: there are no figures to compare.
enum class Outcome { holds, fails, open };

LEAFHULL_API std::string_view name(Outcome outcome);  ///< "holds", "fails", "open"
/// "holds", "does not hold", "cannot be told"
LEAFHULL_API std::string_view in_words(Outcome outcome);

/// One claim of the paper, or half of one, tested on one tree under one reading. Plain text.
struct Verdict {
  std::string number;  ///< "1a"
  std::string claim;   ///< what is claimed, one sentence
  std::string test;    ///< when it counts as holding, in terms of the figures
  Outcome outcome = Outcome::open;
  std::string figures;  ///< the numbers that decide, or why none do
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

/// The ends p1 and p2 of a band: `low` and `high` are deviations s above the mean m of N_iso, or
/// the percent of leaf vertices with a lower N_iso. Source: Eqs. (9), (10), which use 0 and 2 s.
struct Band {
  double low = 0, high = 2;
  bool percent = false;
};

/// CTRLED with another band.
struct BandRow {
  Band band;
  StudyRow row;
};

/// How CTRLED changes as its band moves, between an L&D and an UNCTRLED that lose as many leaf
/// vertices as in the paper's Table 1: T is fitted to the first, then the leaf scale to the second.
/// k = 1; R_max and lambda_R are as in Table 1.
struct BandStudy {
  double evenness = 0;                   ///< s / m of N_iso: 0 if all leaves are equally dense
  double threshold = 0, leaf_scale = 0;  ///< as fitted
  std::string failure;                   ///< why a fit failed; there are no rows then
  StudyRow isotropic, uncontrolled;      ///< the two ends, as fitted
  std::vector<BandRow> by_share, by_deviation;  ///< from the densest leaves to the sparsest
};

struct TreeStudy {
  std::string name;  ///< the file's name without folder and extension, unique in a study
  std::uint64_t leaves = 0, leaf_vertices = 0;
  std::vector<ReadingStudy> readings;  ///< the project's own reading first
  BandStudy band;
  /// Pictures in the project's own reading: the methods (Table 1), and the effects of T, R_max and
  /// lambda_R (Figures 12, 14, 16).
  std::vector<LabelledPicture> methods, figure12, figure14, figure16;
  std::array<Mesh, 3> meshes;  ///< Table 1 by Method; empty meshes where there is no surface
  Box bounds;                  ///< of the leaf vertices
  double seconds = 0;          ///< time spent on the tree
};

struct Study {
  std::vector<TreeStudy> trees;
  std::string version, device, machine, date;  ///< date: YYYY-MM-DD
  std::string command;                         ///< for a POSIX shell
  double seconds = 0;
};

/// What the paper calls a method: "L&D", "UNCTRLED", "CTRLED".
LEAFHULL_API std::string_view paper_name(Method method);

/// Every reading: k = 1, 2 by stddev, variance by exact, grid; the project's own first.
LEAFHULL_API std::array<Reading, 8> readings();

/// The numbers that the paper prints in Tables 1 and 2. The curves of its Figures 11, 13 and 15 are
/// not given as numbers and stay empty; it does not state T, R_max and lambda_R of Table 1, which
/// are zero. Source: pp. 54-56; the tree has kPaperLeafVertices leaf vertices, the CPU is an AMD
/// Athlon 64 3200+ at 2.01 GHz.
LEAFHULL_API const ReadingStudy& paper_results();
inline constexpr std::uint64_t kPaperLeafVertices = 52648;

/// Verdicts on the paper's claims, from the tables and figures of `study` alone.
/// @param band if given, claim 2b also says for which bands it holds; the verdict stays the same.
LEAFHULL_API std::vector<Verdict> verdicts(const ReadingStudy& study,
                                           const BandStudy* band = nullptr);

/// The paper's evaluation of one tree under every reading. T is 2, R_max 1.5 crown units and
/// lambda_R 0.7 unless they vary or are fitted; there are 64 voxels except in Table 2. Takes tens
/// of seconds.
/// @param progress `done` is the share of all the work, and even.
/// @throws Error as extract does, except for an empty surface, which is a result.
LEAFHULL_API TreeStudy study_tree(const LeafSet& leaves, const std::string& name, Device& device,
                                  const Progress& progress = {});

/// Writes report.html (with curves if gnuplot is installed) and study.json into `folder`, or
/// neither. Makes the folder if it is missing.
/// @param study one tree or more, each with the same readings, one or more.
/// @throws Error usage: no tree, or a tree without readings; output: which file and why.
LEAFHULL_API void write_study(const Study& study, const OutputFolder& folder);

}  // namespace leafhull
