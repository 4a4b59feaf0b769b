// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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

/// An option and the one or more values it takes in a sweep, written as on a command line.
struct SweptOption {
  const OptionRow* row = nullptr;  ///< of option_table()
  std::vector<std::string> values;
};

/// Whether a sweep may give the option several values: numbers and names of Shape and Resolution.
LEAFHULL_API bool can_sweep(const OptionRow& row);

/// Parses the values in `text`: a range first:last:step of numbers, including the last if a step
/// meets it; a list a,b,c; or one value, passed on unread. Numbers that end in % are values of the
/// row's `percent`, or hundredths of a fraction.
/// @throws Error usage: neither a range nor a list, a range without values, a step that is not
/// above zero, a value given twice.
LEAFHULL_API SweptOption swept_option(const OptionRow& row, std::string_view text);

/// How many combinations there are.
/// @throws Error usage: more than a sweep can hold, 100,000.
LEAFHULL_API std::size_t combination_count(std::span<const SweptOption> swept);

/// What a sweep extracts: plan_sweep() has checked and combined it.
class SweepPlan {
 public:
  /// One or more, in the order of option_table(), none twice.
  const std::vector<SweptOption>& swept() const { return swept_; }
  /// All of them, as resolve() returns them; the last swept option changes fastest.
  const std::vector<Options>& combinations() const { return combinations_; }

 private:
  friend SweepPlan plan_sweep(const Options& options, std::vector<SweptOption> swept);
  SweepPlan(std::vector<SweptOption> swept, std::vector<Options> combinations)
      : swept_(std::move(swept)), combinations_(std::move(combinations)) {}

  std::vector<SweptOption> swept_;
  std::vector<Options> combinations_;
};

/// Every combination of the values in `swept`, in any order; all else is as in `options`.
/// @throws Error usage: nothing is swept, an option that cannot be, that has no values or stands
///         twice, a value that is no number or name of its option, more combinations than a sweep
///         can hold, and what resolve() throws.
LEAFHULL_API SweepPlan plan_sweep(const Options& options, std::vector<SweptOption> swept);

/// Where a sweep is kept.
struct SweepFolder {
  OutputFolder folder;   ///< made where it does not exist
  bool restart = false;  ///< first removes what another sweep left there
};

/// A summary of one run of a sweep.
struct SweepSummary {
  std::size_t combinations = 0;
  std::size_t resumed = 0;         ///< of these, done by an earlier run
  std::size_t empty = 0;           ///< of these, without a surface
  std::size_t failed = 0;          ///< of these, not computed; the rows say why
  std::vector<StageTime> seconds;  ///< of this run by stage, the total last
  std::vector<std::string> warnings;
};

/// Extracts every combination of `plan` and keeps in `folder`: sweep.csv and sweep.json, a row per
/// combination in the order of `plan`; plot-OPTION.svg for every swept number; a picture of each
/// combination in pictures/, and contact-sheet.png with all. Each finished
/// combination is on disk at once (sweep.jsonl), so a sweep that was cut off resumes there. A row's
/// seconds are the time it added to the rows before it: neighbours share their work.
/// @param progress counts combinations, those of earlier runs from the start.
/// @throws Error usage: the folder holds another sweep, or files of these names from elsewhere;
///         output: which file and why; and what extract_series throws.
LEAFHULL_API SweepSummary run_sweep(const LeafSet& leaves, const SweepPlan& plan, Device& device,
                                    const SweepFolder& folder, const RunDescription& run,
                                    const Progress& progress = {});

/// One choice of erosion and dilation, and its result.
struct Suggestion {
  double erosion = 0, dilation = 0;  ///< as asked for
  std::string failure;               ///< why the tree cannot have them; empty where it can
  bool empty = false;                ///< no sample reaches T
  Report report;
  double dilated_volume = 0;            ///< dilated voxels, model units cubed
  std::optional<double> dilated_share;  ///< of the leaves' bounding box, where it has a volume
};

/// A range for an artist to choose from: erosions of 2, 12 and 25%, each with the least dilation
/// that the tree can have, the most, and one between, for R_max from 1.5 to 9 crown units. All else
/// is as in `options`, which hold neither a threshold nor a radius. If dilations alone would not
/// tell neighbours in a row apart, their erosions differ too, by 5%.
struct Suggestions {
  std::vector<Suggestion> choices;  ///< the dilation changes fastest
  Picture strip;                    ///< a labelled picture of each choice
};

/// @throws Error as extract_series does.
LEAFHULL_API Suggestions suggest(const LeafSet& leaves, const Options& options, Device& device,
                                 std::string_view title, const Progress& progress = {});

}  // namespace leafhull
