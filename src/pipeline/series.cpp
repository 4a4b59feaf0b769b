// SPDX-License-Identifier: Apache-2.0
#include "leafhull/series.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "pipeline/finish_mesh.h"
#include "pipeline/grid.h"
#include "pipeline/stages.h"
#include "pipeline/thread_limit.h"

namespace leafhull {
namespace {

/// An entry of the series under way.
struct Entry {
  std::size_t index;  ///< into the series' options
  Report report;
};

/// Where R_max or T is still to be found, no other is known to share a field.
bool is_alone(const Entry& entry) {
  return entry.report.options.erosion || entry.report.options.dilation;
}

/// The series in groups that can share a field, so ordered that the next shares the most with the
/// last.
std::vector<std::vector<Entry>> groups_of(const LeafSet& leaves, std::span<const Options> series) {
  std::vector<std::pair<FieldKey, Entry>> entries;
  for (std::size_t i = 0; i < series.size(); ++i) {
    Report report;
    report.options = resolve(series[i]);
    set_grid(leaves, report);
    entries.emplace_back(field_key(report), Entry{i, report});
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::vector<Entry>> groups;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool is_new = i == 0 || is_alone(entries[i].second) || is_alone(groups.back().front()) ||
                        entries[i].first != entries[i - 1].first;
    if (is_new) groups.emplace_back();
    groups.back().push_back(std::move(entries[i].second));
  }
  return groups;
}

std::vector<double> thresholds_of(std::span<const Entry> group) {
  std::vector<double> thresholds;
  for (const Entry& entry : group) thresholds.push_back(entry.report.threshold);
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  return thresholds;
}

/// Extracts entry by entry and hands each to the visitor until that says no.
class Series {
 public:
  Series(const LeafSet& leaves, Device& device, const SeriesVisitor& visit,
         const Progress& progress)
      : watch_(progress), stages_(leaves, device, watch_), visit_(visit) {}

  /// False where the visitor ends the series, as below.
  bool extract(std::vector<Entry>& group) {
    std::vector<Entry> prepared;
    for (Entry& entry : group) {
      const std::string failure = failure_of([&] { stages_.prepare(entry.report); });
      if (failure.empty()) {
        prepared.push_back(std::move(entry));
      } else if (!fail({&entry, 1}, failure)) {
        return false;
      }
    }
    std::stable_sort(prepared.begin(), prepared.end(), [](const Entry& a, const Entry& b) {
      return a.report.threshold < b.report.threshold;
    });
    return prepared.empty() || extract_at(prepared);
  }

 private:
  /// Entries ascending by T; where the field of all does not fit in memory, halves share one.
  bool extract_at(std::span<Entry> group) {
    if (is_alone(group.front())) return extract_alone(group.front());
    const Report& first = group.front().report;
    const std::vector<double> thresholds = thresholds_of(group);
    if (thresholds.size() > 1 && !stages_.memory(first, thresholds).fits()) {
      const std::size_t half = group.size() / 2;
      return extract_at(group.first(half)) && extract_at(group.subspan(half));
    }
    const std::string failure = failure_of([&] { stages_.sample(first, thresholds); });
    if (!failure.empty()) return fail(group, failure);
    return std::all_of(group.begin(), group.end(),
                       [&](Entry& entry) { return extract(entry, stages_.field(entry.report)); });
  }

  bool extract_alone(Entry& entry) {
    Stages::Surface surface;
    const std::string failure =
        failure_of([&] { surface = stages_.surface(entry.report, Mesher::bricks); });
    if (!failure.empty()) return fail({&entry, 1}, failure);
    return finish(entry, surface.field, surface.polygons);
  }

  bool extract(Entry& entry, const Field& field) {
    return finish(entry, field, stages_.polygonise(field, Mesher::bricks, entry.report));
  }

  bool finish(Entry& entry, const Field& field, const Polygons& polygons) {
    Report& report = entry.report;
    SeriesEntry result;
    result.mesh = lattice_mesh(polygons, field.lattice());
    result.mesh.colour = entry.report.leaf_colour;
    report.counts.mesh_vertices = result.mesh.positions.size();
    report.counts.mesh_triangles = result.mesh.triangles.size();
    stages_.measure(field, report);
    report.seconds = watch_.finish();
    result.report = std::move(report);
    return visit_(entry.index, std::move(result));
  }

  /// What kept `work` from its end: options that do not suit the tree.
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

  bool fail(std::span<Entry> group, const std::string& failure) {
    return std::all_of(group.begin(), group.end(), [&](Entry& entry) {
      entry.report.seconds = watch_.finish();
      return visit_(entry.index, {std::move(entry.report), {}, failure});
    });
  }

  Stopwatch watch_;
  Stages stages_;
  const SeriesVisitor& visit_;
};

}  // namespace

void check_series(const LeafSet& leaves, std::span<const Options> options) {
  groups_of(leaves, options);
}

void extract_series(const LeafSet& leaves, std::span<const Options> options, Device& device,
                    const SeriesVisitor& visit, const Progress& progress) {
  const ThreadLimit limit(device);
  Series series(leaves, device, visit, progress);
  for (std::vector<Entry>& group : groups_of(leaves, options)) {
    if (!series.extract(group)) return;
  }
}

}  // namespace leafhull
