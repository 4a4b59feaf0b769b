// SPDX-License-Identifier: Apache-2.0
#include "density/points.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "density/near_kernels.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

/// About how many points have their kernels gathered together.
constexpr std::size_t kClusterPoints = 256;
constexpr std::size_t kLeastChunk = 8;
/// The size of a batch: 2 MiB of ranks, and no more chunks than one launch takes.
constexpr std::size_t kChunkEntries = std::size_t{1} << 19;
constexpr std::size_t kBatchClusters = (std::size_t{1} << 15) / (kClusterPoints / kLeastChunk);

std::size_t chunks_of(std::size_t points, std::size_t chunk_points) {
  return (points + chunk_points - 1) / chunk_points;
}

/// Consecutive points in one frame: points come in an order that keeps neighbours together.
struct Run {
  Coord frame;
  std::uint32_t begin, end;
  friend bool operator<(const Run& a, const Run& b) {
    return std::pair(a.frame, a.begin) < std::pair(b.frame, b.begin);
  }
};

template <class T>
std::vector<Run> sorted_runs(std::span<const Vec3<T>> points) {
  constexpr std::size_t kSlice = 4096;
  std::vector<std::vector<Run>> slices((points.size() + kSlice - 1) / kSlice);
  tbb::parallel_for(std::size_t{0}, slices.size(), [&](std::size_t slice) {
    std::vector<Run>& runs = slices[slice];
    const std::size_t end = std::min((slice + 1) * kSlice, points.size());
    for (std::size_t i = slice * kSlice; i < end; ++i) {
      const Coord frame = block_origin(cell_of(Vec3d(points[i])), kFrameEdge);
      const auto point = static_cast<std::uint32_t>(i);
      if (!runs.empty() && runs.back().frame == frame &&
          point - runs.back().begin < kClusterPoints) {
        runs.back().end = point + 1;
      } else {
        runs.push_back({frame, point, point + 1});
      }
    }
  });
  std::vector<Run> all;
  for (const auto& runs : slices) all.insert(all.end(), runs.begin(), runs.end());
  tbb::parallel_sort(all);
  return all;
}

/// Runs in one frame.
struct Cluster {
  std::span<const Run> runs;
  std::size_t points = 0;
};

std::vector<Cluster> in_clusters(std::span<const Run> runs) {
  std::vector<Cluster> clusters;
  for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
    std::size_t points = 0;
    while (end < runs.size() && runs[end].frame == runs[begin].frame) {
      const std::size_t more = runs[end].end - runs[end].begin;
      if (end > begin && points + more > kClusterPoints) break;
      points += more;
      ++end;
    }
    clusters.push_back({runs.subspan(begin, end - begin), points});
  }
  return clusters;
}

/// A point of a cluster.
struct Member {
  Vec3f offset;  // from the frame's origin
  std::uint32_t point;
};

LocalBox box_of(std::span<const Member> members) {
  LocalBox box{members.front().offset, members.front().offset};
  for (const Member& m : members) {
    const Vec3f p = m.offset;
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

/// The box in which points of `box` may be evaluated.
LocalBox reach_of(const LocalBox& box, Within within) {
  if (within == Within::point) return box;
  const auto below = [](Vec3f p) {
    return Vec3f(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  };
  return {below(box.low), below(box.high) + Vec3f(1, 1, 1)};
}

/// Searches a cluster at a time: halves it, by whole chunks, along the longest side.
class Search {
 public:
  Search(const KernelSet& set, const KernelGroups& groups, Within within)
      : near_(set, groups), within_(within) {}

  /// Writes the cluster's chunks to `batch` from `chunk` on and their lists to `ranks`; chunks
  /// index into `ranks`.
  template <class T>
  void operator()(std::span<const Vec3<T>> points, const Cluster& cluster, std::size_t chunk,
                  PointBatch& batch, std::vector<std::uint32_t>& ranks) {
    origin_ = cluster.runs.front().frame;
    batch_ = &batch;
    chunk_points_ = batch.chunk_points;
    chunk_ = chunk;
    ranks_ = &ranks;
    ranks.clear();
    members_.clear();
    for (const Run& run : cluster.runs) {
      for (std::uint32_t i = run.begin; i < run.end; ++i) {
        members_.push_back({Vec3f(Vec3d(points[i]) - to_vec3d(origin_)), i});
      }
    }
    near_.load(origin_, reach_of(box_of(members_), within_));
    halve(members_);
  }

 private:
  void halve(std::span<Member> members) {
    const LocalBox box = box_of(members);
    if (members.size() <= chunk_points_) return add_chunk(members, reach_of(box, within_));
    const Vec3f side = box.high - box.low;
    const auto axis = side.x >= side.y && side.x >= side.z ? &Vec3f::x
                      : side.y >= side.z                   ? &Vec3f::y
                                                           : &Vec3f::z;
    const std::size_t half = (chunks_of(members.size(), chunk_points_) + 1) / 2 * chunk_points_;
    std::nth_element(
        members.begin(), members.begin() + static_cast<std::ptrdiff_t>(half), members.end(),
        [axis](const Member& a, const Member& b) { return a.offset.*axis < b.offset.*axis; });
    halve(members.first(half));
    halve(members.subspan(half));
  }

  void add_chunk(std::span<const Member> members, const LocalBox& reach) {
    const auto first = static_cast<std::uint32_t>(ranks_->size());
    near_.append_reaching(reach, *ranks_);
    batch_->chunks[chunk_] = {origin_, first, static_cast<std::uint32_t>(ranks_->size())};
    for (std::size_t lane = 0; lane < chunk_points_; ++lane) {
      const Member& m = members[std::min(lane, members.size() - 1)];
      const std::size_t at = chunk_ * chunk_points_ + lane;
      batch_->index[at] = m.point;
      batch_->x[at] = m.offset.x, batch_->y[at] = m.offset.y, batch_->z[at] = m.offset.z;
    }
    ++chunk_;
  }

  NearKernels near_;
  Within within_;
  std::vector<Member> members_;
  Coord origin_;
  PointBatch* batch_ = nullptr;
  std::size_t chunk_points_ = 0;
  std::vector<std::uint32_t>* ranks_ = nullptr;
  std::size_t chunk_ = 0;
};

/// Replaces `batch` by the chunks of `clusters`. `lists` is scratch space.
template <class T>
void search(std::span<const Vec3<T>> points, std::span<const Cluster> clusters,
            tbb::enumerable_thread_specific<Search>& searches,
            std::vector<std::vector<std::uint32_t>>& lists, PointBatch& batch) {
  std::vector<std::size_t> first_chunk{0};
  for (const Cluster& c : clusters) {
    first_chunk.push_back(first_chunk.back() + chunks_of(c.points, batch.chunk_points));
  }
  batch.chunks.resize(first_chunk.back());
  batch.index.resize(first_chunk.back() * batch.chunk_points);
  for (auto* v : {&batch.x, &batch.y, &batch.z}) v->resize(batch.index.size());

  lists.resize(std::max(clusters.size(), lists.size()));
  tbb::parallel_for(std::size_t{0}, clusters.size(), [&](std::size_t i) {
    searches.local()(points, clusters[i], first_chunk[i], batch, lists[i]);
  });

  std::vector<std::size_t> first{0};
  for (std::size_t i = 0; i < clusters.size(); ++i) first.push_back(first[i] + lists[i].size());
  if (first.back() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::usage, "too many kernels reach one place",
                "Lower --radius-max or --leaf-scale.");
  }
  batch.kernels.resize(first.back());
  tbb::parallel_for(std::size_t{0}, clusters.size(), [&](std::size_t i) {
    std::copy(lists[i].begin(), lists[i].end(),
              batch.kernels.begin() + static_cast<std::ptrdiff_t>(first[i]));
    for (std::size_t c = first_chunk[i]; c < first_chunk[i + 1]; ++c) {
      batch.chunks[c].first += static_cast<std::uint32_t>(first[i]);
      batch.chunks[c].end += static_cast<std::uint32_t>(first[i]);
    }
  });
}

template <class T>
void find_near(const KernelSet& set, std::span<const Vec3<T>> points, Within within,
               std::size_t chunk_points, const std::function<void(PointBatch&)>& visit) {
  const std::vector<Run> runs = sorted_runs(points);
  const std::vector<Cluster> clusters = in_clusters(runs);
  if (clusters.empty()) return;
  const KernelGroups groups(set.kernels());
  tbb::enumerable_thread_specific<Search> searches([&] { return Search(set, groups, within); });
  // Even if every kernel reaches every point, a batch has at most 64 MiB of ranks or one cluster.
  constexpr std::size_t kMostEntries = std::size_t{1} << 24;
  std::size_t group = std::clamp<std::size_t>(
      kMostEntries / (chunks_of(kClusterPoints, chunk_points) * set.kernels().size() + 1), 1, 64);
  std::vector<std::vector<std::uint32_t>> lists;
  PointBatch batch;
  batch.chunk_points = chunk_points;
  for (std::size_t begin = 0, end = 0; begin < clusters.size(); begin = end) {
    end = std::min(begin + group, clusters.size());
    search(points, std::span(clusters).subspan(begin, end - begin), searches, lists, batch);
    group = std::clamp<std::size_t>(kChunkEntries * (end - begin) / (batch.kernels.size() + 1), 1,
                                    std::min(4 * group, kBatchClusters));
    visit(batch);
  }
}

}  // namespace

void find_kernels_near(const KernelSet& kernels, std::span<const Vec3d> points, Within within,
                       std::size_t chunk_points, const std::function<void(PointBatch&)>& visit) {
  find_near(kernels, points, within, chunk_points, visit);
}

void find_kernels_near(const KernelSet& kernels, std::span<const Vec3f> points, Within within,
                       std::size_t chunk_points, const std::function<void(PointBatch&)>& visit) {
  find_near(kernels, points, within, chunk_points, visit);
}

}  // namespace leafhull
