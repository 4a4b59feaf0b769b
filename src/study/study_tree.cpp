// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "leafhull/error.h"
#include "leafhull/study.h"
#include "study/band_study.h"
#include "study/numbers.h"
#include "study/study_plan.h"

namespace leafhull {
namespace {

constexpr int kPictureSize = 480;
constexpr int kRuns = 5;  // of each method in Table 2; odd, for the median

// The rough cost of a study's parts in entries of the series, only for the progress bar.
constexpr int kPictureWork = 12;
constexpr int kBandWork = 24;
int timing_work(int resolution) { return 2 * kRuns * (3 + resolution / 16); }

// Which stages of `extract` are which steps of Figure 8. Two stages belong to no step: `metrics`,
// and `threshold`, N at the leaf vertices, which is not needed if T is given.
constexpr std::string_view kGridAndSurface[] = {  // steps 1, 6 and 7
    "hash", "field", "polygonise", "snap"};
constexpr std::string_view kControl[] = {  // steps 2 and 3 to 5
    "isotropic density", "control"};

double seconds_of(const Report& report, std::span<const std::string_view> stages) {
  double sum = 0;
  for (const std::string_view stage : stages) {
    const auto found = std::find_if(report.seconds.begin(), report.seconds.end(),
                                    [&](const StageTime& time) { return time.stage == stage; });
    if (found == report.seconds.end()) {
      throw Error(ErrorCode::internal, "extract has no stage " + std::string(stage));
    }
    sum += found->seconds;
  }
  return sum;
}

double median(std::array<double, kRuns> values) {
  static_assert(kRuns % 2 == 1);
  std::nth_element(values.begin(), values.begin() + kRuns / 2, values.end());
  return values[kRuns / 2];
}

/// A row of Table 2, from kRuns extractions of each method; empty where there is no surface.
StudyTime table2_time(const LeafSet& leaves, const Reading& reading, int resolution,
                      Device& device) {
  const ReadingStudy plan = planned(reading);
  const auto report = [&](Method method) {
    const StudyRow& row = plan.table1[static_cast<std::size_t>(method)];
    return extract(leaves, options_of(row, reading, resolution), device).report;
  };
  StudyTime time{.resolution = resolution, .runs = kRuns};
  std::array<double, kRuns> previous, proposed, control;
  try {
    for (int run = 0; run < kRuns; ++run) {  // in turn, so that a disturbance affects both
      previous[run] = seconds_of(report(Method::isotropic), kGridAndSurface);
      const Report controlled = report(Method::controlled);
      control[run] = seconds_of(controlled, kControl);
      proposed[run] = seconds_of(controlled, kGridAndSurface) + control[run];
    }
  } catch (const Error& error) {
    if (error.code() != ErrorCode::empty) throw;
    time.empty = true;
    return time;
  }
  time.previous = median(previous);
  time.proposed = median(proposed);
  time.control = median(control);
  return time;
}

/// Tells how much of the work is done.
class Steps {
 public:
  Steps(const Progress& progress, int work) : progress_(progress), work_(work) {}

  void start(std::string_view stage) {
    stage_ = stage;
    advance(0);
  }
  void advance(int work) {
    done_ += work;
    if (!progress_) return;
    progress_({.stage = stage_, .done = static_cast<double>(done_) / work_, .is_even = true});
  }

 private:
  const Progress& progress_;
  int work_, done_ = 0;
  std::string stage_;
};

void time(ReadingStudy& study, const LeafSet& leaves, Device& device, Steps& steps) {
  steps.start("times");
  for (const int resolution : kTable2Resolutions) {
    study.table2.push_back(table2_time(leaves, study.reading, resolution, device));
    steps.advance(timing_work(resolution));
  }
}

/// The surface of a row; empty where there is none.
Mesh surface(const LeafSet& leaves, const StudyRow& row, const Reading& reading, Device& device) {
  try {
    return extract(leaves, options_of(row, reading), device, {}, Detail::shape).mesh;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::empty) throw;
    return {};
  }
}

/// A row of pictures, and the parameter in which they differ.
struct Strip {
  std::vector<LabelledPicture> TreeStudy::*pictures;
  std::vector<StudyRow> rows;
  std::string (*label)(const StudyRow&);
};

/// The three of a figure's five rows that the paper shows.
std::vector<StudyRow> shown(const std::vector<StudyRow>& figure) {
  return {figure.front(), figure[figure.size() / 2], figure.back()};
}

constexpr int kPictures = 12;

std::array<Strip, 4> strips(const ReadingStudy& study) {
  using Row = const StudyRow&;
  return {{{&TreeStudy::methods,
            {study.table1.begin(), study.table1.end()},
            [](Row row) { return std::string(paper_name(row.method)); }},
           {&TreeStudy::figure12, shown(study.figure11),
            [](Row row) { return "T = " + fixed(row.threshold, 1); }},
           {&TreeStudy::figure14, shown(study.figure13),
            [](Row row) { return "R_max = " + fixed(row.radius_max, 1); }},
           {&TreeStudy::figure16, shown(study.figure15),
            [](Row row) { return "λ_R = " + fixed(row.flatness, 1); }}}};
}

/// Fills in the meshes and the pictures, all taken from one viewpoint.
void draw(TreeStudy& tree, const LeafSet& leaves, Device& device, Steps& steps) {
  steps.start("pictures");
  const ReadingStudy& own = tree.readings.front();
  std::vector<Mesh> meshes;
  double radius_max = 0;
  for (const Strip& strip : strips(own)) {
    for (const StudyRow& row : strip.rows) {
      meshes.push_back(surface(leaves, row, own.reading, device));
      radius_max = std::max(radius_max, row.radius_max);
    }
  }
  const Frame frame = frame_of(leaves, radius_max * leaves.crown.longest_side() / kCrownUnits);
  auto mesh = meshes.begin();
  for (const Strip& strip : strips(own)) {
    for (const StudyRow& row : strip.rows) {
      LabelledPicture picture{draw_shape(*mesh, frame, kPictureSize, kPictureSize),
                              {strip.label(row)}};
      if (row.empty) picture.lines.emplace_back("no surface");
      (tree.*strip.pictures).push_back(std::move(picture));
      ++mesh;
      steps.advance(kPictureWork);
    }
  }
  std::move(meshes.begin(), meshes.begin() + tree.meshes.size(), tree.meshes.begin());
}

}  // namespace

TreeStudy study_tree(const LeafSet& leaves, const std::string& name, Device& device,
                     const Progress& progress) {
  const auto began = std::chrono::steady_clock::now();
  TreeStudy tree;
  tree.name = name;
  tree.leaves = leaves.leaf_count;
  tree.leaf_vertices = leaves.vertices.size();
  tree.bounds = leaves.bounds;
  for (const Reading& reading : readings()) tree.readings.push_back(planned(reading));

  const Plan all = plan(tree.readings);
  int work = static_cast<int>(all.options.size()) + kBandWork + kPictures * kPictureWork;
  for (const int resolution : kTable2Resolutions) {
    work += static_cast<int>(tree.readings.size()) * timing_work(resolution);
  }
  Steps steps(progress, work);
  steps.start("tables");
  measure(all, leaves, device, [&](const Report&) { steps.advance(1); });
  steps.start("band");
  tree.band = study_band(leaves, device);
  steps.advance(kBandWork);
  draw(tree, leaves, device, steps);
  for (ReadingStudy& study : tree.readings) {
    time(study, leaves, device, steps);
    study.verdicts = verdicts(study, &study == &tree.readings.front() ? &tree.band : nullptr);
  }
  tree.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return tree;
}

}  // namespace leafhull
