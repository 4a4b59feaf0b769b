// SPDX-License-Identifier: Apache-2.0
#include "leafhull/series.h"

#include <algorithm>
#include <utility>
#include <vector>

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

/// The series in groups, so ordered that the next group shares the most with the last.
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
    if (i == 0 || entries[i].first != entries[i - 1].first) groups.emplace_back();
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

/// Entries that share a field, ascending by T; where it does not fit in memory, halves share one.
/// False where the visitor ends the series.
bool visit_group(std::span<Entry> group, Stages& stages, Stopwatch& watch,
                 const SeriesVisitor& visit) {
  const std::vector<double> thresholds = thresholds_of(group);
  if (thresholds.size() > 1 && !stages.memory(group.front().report, thresholds).fits()) {
    const std::size_t half = group.size() / 2;
    return visit_group(group.first(half), stages, watch, visit) &&
           visit_group(group.subspan(half), stages, watch, visit);
  }
  const Field& sampled = stages.sample(group.front().report, thresholds);
  for (Entry& entry : group) {
    Report& report = entry.report;
    const Field field = sampled.at(report.threshold);
    SeriesEntry result;
    result.mesh = lattice_mesh(stages.polygonise(field, Mesher::bricks, report), field.lattice());
    report.counts.mesh_vertices = result.mesh.positions.size();
    report.counts.mesh_triangles = result.mesh.triangles.size();
    stages.measure(field, report);
    report.seconds = watch.finish();
    result.report = std::move(report);
    if (!visit(entry.index, std::move(result))) return false;
  }
  return true;
}

}  // namespace

void extract_series(const LeafSet& leaves, std::span<const Options> options, Device& device,
                    const SeriesVisitor& visit, const Progress& progress) {
  const ThreadLimit limit(device);
  Stopwatch watch(progress);
  Stages stages(leaves, device, watch);
  for (std::vector<Entry>& group : groups_of(leaves, options)) {
    for (Entry& entry : group) stages.prepare(entry.report);
    std::stable_sort(group.begin(), group.end(), [](const Entry& a, const Entry& b) {
      return a.report.threshold < b.report.threshold;
    });
    if (!visit_group(group, stages, watch, visit)) return;
  }
}

}  // namespace leafhull
