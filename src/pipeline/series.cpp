// SPDX-License-Identifier: Apache-2.0
#include "pipeline/series.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "pipeline/describe.h"
#include "pipeline/finish_mesh.h"
#include "pipeline/measure_shape.h"
#include "pipeline/sliders.h"

namespace leafhull {
namespace {

/// An entry of the series.
struct Entry {
  std::size_t index;  ///< into the series' options
  Options options;    ///< resolved
  Grid grid;
  FieldOptions field;
};

/// Whether an entry cannot share a field, as its R_max or T must still be found.
bool is_alone(const Options& options) { return options.erosion || options.dilation; }

/// The series in groups that can share a field, ordered so that each group shares the most with the
/// previous one.
std::vector<std::vector<Entry>> groups_of(const LeafSet& leaves, std::span<const Options> series) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Options options = resolve(series[i]);
    const Grid grid = grid_of(leaves, options);
    entries.push_back({i, options, grid, field_options(options, grid)});
  }
  std::ranges::stable_sort(entries,
                           [](const Entry& a, const Entry& b) { return a.field < b.field; });
  std::vector<std::vector<Entry>> groups;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool is_new = i == 0 || is_alone(entries[i].options) ||
                        is_alone(groups.back().front().options) ||
                        entries[i].field != entries[i - 1].field;
    if (is_new) groups.emplace_back();
    groups.back().push_back(entries[i]);
  }
  return groups;
}

/// An entry whose kernels and T are prepared.
struct PreparedEntry {
  std::size_t index;
  Prepared prepared;
};

std::vector<double> thresholds_of(std::span<const PreparedEntry> group) {
  std::vector<double> thresholds;
  for (const PreparedEntry& entry : group) thresholds.push_back(entry.prepared.threshold);
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  return thresholds;
}

/// Extracts entry by entry and hands each to the visitor until it returns false.
class Series {
 public:
  Series(const LeafSet& leaves, Device& device, const SeriesVisitor& visit,
         const Progress& progress)
      : watch_(progress), run_{leaves, device, watch_}, stages_(run_), visit_(visit) {}

  /// Returns false if the visitor ends the series, as do the functions below.
  bool extract(std::span<const Entry> group) {
    if (is_alone(group.front().options)) return extract_alone(group.front());
    std::vector<PreparedEntry> prepared;
    for (const Entry& entry : group) {
      const std::string failure = failure_of([&] {
        prepared.push_back({entry.index, stages_.prepare(entry.options, 0)});
      });
      if (!failure.empty() && !fail(entry.index, entry.options, entry.grid, failure)) return false;
    }
    std::ranges::stable_sort(prepared, {},
                             [](const PreparedEntry& entry) { return entry.prepared.threshold; });
    return prepared.empty() || extract_at(prepared);
  }

 private:
  /// Extracts entries ascending by T. If one field for all does not fit in memory, each half shares
  /// one.
  bool extract_at(std::span<const PreparedEntry> group) {
    const Prepared& first = group.front().prepared;
    const std::vector<double> thresholds = thresholds_of(group);
    if (thresholds.size() > 1 && !field_memory(run_, first, thresholds).fits()) {
      const std::size_t half = group.size() / 2;
      return extract_at(group.first(half)) && extract_at(group.subspan(half));
    }
    Sampled sampled;
    const std::string failure = failure_of([&] { sampled = sample(run_, first, thresholds); });
    return std::ranges::all_of(group, [&](const auto& entry) {
      const auto& [index, prepared] = entry;
      if (!failure.empty()) return fail(index, prepared.options, prepared.grid, failure);
      SampledSurface surface{{without_hollows(run_, prepared, sampled.field.at(prepared.threshold)),
                              sampled.pairs, sampled.density},
                             {}};
      surface.pieces = polygonise(run_, surface.sampled.field, prepared.options);
      return finish(index, prepared, surface);
    });
  }

  bool extract_alone(const Entry& entry) {
    Sliders sliders(run_, stages_, entry.options);
    Prepared prepared;
    SampledSurface surface;
    const std::string failure = failure_of([&] {
      prepared = sliders.prepare();
      surface = sliders.surface(prepared);
    });
    if (!failure.empty()) return fail(entry.index, entry.options, entry.grid, failure);
    return finish(entry.index, prepared, surface);
  }

  /// Takes the polygons of `surface`.
  bool finish(std::size_t index, const Prepared& prepared, SampledSurface& surface) {
    auto& [sampled, pieces] = surface;
    SeriesEntry result;
    result.report = describe(run_, prepared);
    describe_pieces(pieces, result.report);
    result.mesh = lattice_mesh(std::move(pieces.polygons), sampled.field.lattice());
    result.mesh.colour = run_.leaves.colour;
    result.report.metrics = measure(run_, stages_, prepared, sampled.field, pieces.dropped_cells);
    describe_mesh(result.mesh, sampled, result.report);
    result.report.seconds = watch_.finish();
    return visit_(index, std::move(result));
  }

  /// Why `work` failed, as the options do not suit the tree; empty if it succeeded.
  template <class Work>
  static std::string failure_of(Work&& work) {
    try {
      work();
      return {};
    } catch (const Error& error) {
      if (error.code() != ErrorCode::usage) throw;
      return std::string(error.what()) + ". " + error.remedy();
    }
  }

  bool fail(std::size_t index, const Options& options, const Grid& grid,
            const std::string& failure) {
    Report report = describe(options, grid);
    report.seconds = watch_.finish();
    return visit_(index, {std::move(report), {}, failure});
  }

  Stopwatch watch_;
  Run run_;
  Stages stages_;
  const SeriesVisitor& visit_;
};

}  // namespace

void check_series(const LeafSet& leaves, std::span<const Options> options) {
  groups_of(leaves, options);
}

void extract_series(const LeafSet& leaves, std::span<const Options> options, Device& device,
                    const SeriesVisitor& visit, const Progress& progress) {
  const ThreadLimit limit(device.threads());
  Series series(leaves, device, visit, progress);
  for (const std::vector<Entry>& group : groups_of(leaves, options)) {
    if (!series.extract(group)) return;
  }
}

}  // namespace leafhull
