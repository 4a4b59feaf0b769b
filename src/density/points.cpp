// SPDX-License-Identifier: Apache-2.0
#include "density/points.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace leafhull {
namespace {

/// The most points of a root block that are searched together.
constexpr std::size_t kClusterPoints = std::size_t{1} << 14;
/// A batch is handed over at about 4 MiB of ranks or of points.
constexpr std::size_t kBatchRanks = std::size_t{1} << 20;
constexpr std::size_t kBatchPoints = std::size_t{1} << 18;

/// Consecutive points in one root block: points come in an order that keeps neighbours together.
struct Run {
  Coord root;
  std::uint32_t begin, end;
  friend bool operator<(const Run& a, const Run& b) {
    return std::pair(a.root, a.begin) < std::pair(b.root, b.begin);
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
      const Coord root = block_origin(cell_of(Vec3d(points[i])), kRootEdge);
      const auto point = static_cast<std::uint32_t>(i);
      if (!runs.empty() && runs.back().root == root) {
        runs.back().end = point + 1;
      } else {
        runs.push_back({root, point, point + 1});
      }
    }
  });
  std::vector<Run> all;
  for (const auto& runs : slices) all.insert(all.end(), runs.begin(), runs.end());
  tbb::parallel_sort(all);
  return all;
}

/// Runs in one root block.
struct Cluster {
  std::span<const Run> runs;
  std::size_t points = 0;
};

std::vector<Cluster> in_clusters(std::span<const Run> runs) {
  std::vector<Cluster> clusters;
  for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
    std::size_t points = 0;
    while (end < runs.size() && runs[end].root == runs[begin].root) {
      const std::size_t more = runs[end].end - runs[end].begin;
      if (end > begin && points + more > kClusterPoints) break;
      points += more;
      ++end;
    }
    clusters.push_back({runs.subspan(begin, end - begin), points});
  }
  return clusters;
}

/// The place of a cell in its root block in Morton order, in which every octant is consecutive.
std::uint32_t morton(Coord cell) {
  std::uint32_t place = 0;
  for (int bit = 0; 1 << bit < kRootEdge; ++bit) {
    const auto of = [&](std::int32_t along) {
      return static_cast<std::uint32_t>(along >> bit & 1);
    };
    place |= (of(cell.x) << 2 | of(cell.y) << 1 | of(cell.z)) << (3 * bit);
  }
  return place;
}

/// A point of a cluster, in Morton order.
struct Member {
  std::uint32_t place, point;
  friend auto operator<=>(const Member&, const Member&) = default;
};

/// Searches a cluster at a time.
class Search {
 public:
  Search(const KernelSet& set, Within within)
      : descent_(set, kAnyFalloff, kMargin), set_(set), within_(within) {}

  template <class T>
  PointBatch operator()(std::span<const Vec3<T>> points, const Cluster& cluster,
                        std::size_t chunk_points) {
    members_.clear();
    for (const Run& run : cluster.runs) {
      for (std::uint32_t i = run.begin; i < run.end; ++i) {
        members_.push_back({morton(cell_of(Vec3d(points[i]))), i});
      }
    }
    std::sort(members_.begin(), members_.end());
    PointBatch batch;
    batch.chunk_points = chunk_points_ = chunk_points;
    auto next = members_.begin();
    descent_.from(
        cluster.runs.front().root,
        [&](const Block& block, std::span<const std::uint32_t> near, const Descent::Bounds&) {
          const auto edge = static_cast<std::uint32_t>(block.edge);
          const auto end = std::lower_bound(next, members_.end(),
                                            Member{morton(block.origin) + edge * edge * edge, 0});
          if (end == next) return false;
          if (block.edge > kFrameEdge) return true;
          if (block.edge == kFrameEdge && pays_to_divide({next, end})) return true;
          add_brick(points, block.origin, std::span(next, end), near, batch);
          next = end;
          return true;
        });
    return batch;
  }

 private:
  /// The bounds on N are of no use here.
  static constexpr int kAnyFalloff = 1;
  /// A point moves as far as the first sample of the next brick.
  static constexpr int kMargin = 1;

  /// Whether the points of a frame are searched brick by brick. Each group tests the whole list of
  /// its block: a frame's is about three times as long as a brick's.
  bool pays_to_divide(std::span<const Member> members) const {
    constexpr std::uint32_t kBrickCells = kBrickSamples;
    std::size_t bricks = 1;
    for (std::size_t i = 1; i < members.size(); ++i) {
      bricks += members[i].place / kBrickCells != members[i - 1].place / kBrickCells;
    }
    const std::size_t group_points = kGroupChunks * chunk_points_;
    return 3 * ((members.size() + group_points - 1) / group_points) > bricks;
  }

  template <class T>
  void add_brick(std::span<const Vec3<T>> points, Coord brick, std::span<const Member> members,
                 std::span<const std::uint32_t> near, PointBatch& batch) {
    batch.bricks.add(brick, near);
    const std::size_t group_points = kGroupChunks * batch.chunk_points;
    while (!members.empty()) {
      const auto of_group = members.first(std::min(members.size(), group_points));
      add_group(points, block_origin(brick, kFrameEdge), of_group, batch);
      members = members.subspan(of_group.size());
    }
  }

  /// The offset of a point from its frame, rounded so that its cell stays the same.
  static Vec3f offset_in(Coord frame, Vec3d point) {
    const Vec3f offset(point - to_vec3d(frame));
    const Vec3d end = to_vec3d(cell_of(point)) - to_vec3d(frame) + Vec3d(1, 1, 1);
    const auto below = [](float v, double end) {
      const auto limit = static_cast<float>(end);
      return v < limit ? v : std::nextafter(limit, 0.0f);
    };
    return {below(offset.x, end.x), below(offset.y, end.y), below(offset.z, end.z)};
  }

  /// Adds a group to the last brick.
  template <class T>
  void add_group(std::span<const Vec3<T>> points, Coord frame, std::span<const Member> members,
                 PointBatch& batch) {
    const std::size_t n = batch.chunk_points;
    PointGroup group{frame, *(batch.bricks.first.end() - 2), batch.bricks.first.back(),
                     static_cast<std::uint32_t>(batch.index.size() / n), 0};
    ChunkBoxes boxes;
    for (; !members.empty(); ++group.count) {
      const auto of_chunk = members.first(std::min(members.size(), n));
      Vec3f low, high;
      for (std::size_t lane = 0; lane < n; ++lane) {
        const std::uint32_t point = of_chunk[std::min(lane, of_chunk.size() - 1)].point;
        const Vec3f p = offset_in(frame, Vec3d(points[point]));
        batch.index.push_back(point);
        batch.x.push_back(p.x), batch.y.push_back(p.y), batch.z.push_back(p.z);
        low = lane == 0 ? p : least(low, p), high = lane == 0 ? p : most(high, p);
      }
      set_box(boxes, group.count, low, high);
      members = members.subspan(of_chunk.size());
    }
    for (std::size_t c = group.count; c < kGroupChunks; ++c) {
      for (auto& row : boxes) row[c] = row[group.count - 1];
    }
    batch.groups.push_back(group);
    batch.boxes.push_back(boxes);
  }

  static Vec3f least(Vec3f a, Vec3f b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
  }
  static Vec3f most(Vec3f a, Vec3f b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
  }

  /// Rounding is allowed for.
  void set_box(ChunkBoxes& boxes, std::size_t chunk, Vec3f low, Vec3f high) const {
    if (within_ == Within::cell) {
      const auto below = [](Vec3f p) {
        return Vec3f(std::floor(p.x), std::floor(p.y), std::floor(p.z));
      };
      low = below(low), high = below(high) + Vec3f(1, 1, 1);
    }
    const float slack = kDistanceSlack * (static_cast<float>(set_.reach()) + kFrameEdge);
    const Vec3f centre = 0.5f * (low + high);
    const Vec3f half = 0.5f * (1 + kPositionSlack) * (high - low) + Vec3f(slack, slack, slack);
    const float row[] = {centre.x, centre.y, centre.z, half.x, half.y, half.z};
    for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i][chunk] = row[i];
  }

  Descent descent_;
  const KernelSet& set_;
  Within within_;
  std::size_t chunk_points_ = 0;
  std::vector<Member> members_;
};

template <class T>
void find_near(const KernelSet& set, std::span<const Vec3<T>> points, Within within,
               std::size_t chunk_points, const std::function<void(PointBatch&)>& visit) {
  const std::vector<Run> runs = sorted_runs(points);
  const std::vector<Cluster> clusters = in_clusters(runs);
  tbb::enumerable_thread_specific<Search> searches([&] { return Search(set, within); });
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  PointBatch batch;
  std::size_t step = threads;  // clusters searched at once, fewer if they have many points
  for (std::size_t begin = 0, end = 0; begin < clusters.size(); begin = end) {
    for (std::size_t ahead = 0; end < std::min(begin + step, clusters.size()); ++end) {
      if (ahead >= kBatchPoints && end >= begin + threads) break;
      ahead += clusters[end].points;
    }
    std::vector<PointBatch> found(end - begin);
    tbb::parallel_for(begin, end, [&](std::size_t c) {
      found[c - begin] = searches.local()(points, clusters[c], chunk_points);
    });
    std::size_t longest = 1;
    for (PointBatch& one : found) {
      longest = std::max(longest, one.bricks.kernels.size());
      batch.append(std::exchange(one, {}));
      if (batch.bricks.kernels.size() < kBatchRanks && batch.index.size() < kBatchPoints) continue;
      visit(batch);
      batch = {};
    }
    step = std::clamp(kBatchRanks / longest, threads, 4 * step);
  }
  if (!batch.groups.empty()) visit(batch);
}

template <class T>
void append_all(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

void PointBatch::append(const PointBatch& other) {
  chunk_points = other.chunk_points;
  const auto kernels = static_cast<std::uint32_t>(bricks.kernels.size());
  const auto chunks = static_cast<std::uint32_t>(index.size() / chunk_points);
  bricks.append(other.bricks);
  for (PointGroup group : other.groups) {
    group.first += kernels, group.end += kernels, group.chunk += chunks;
    groups.push_back(group);
  }
  append_all(boxes, other.boxes);
  append_all(index, other.index);
  append_all(x, other.x), append_all(y, other.y), append_all(z, other.z);
}

void find_kernels_near(const KernelSet& kernels, std::span<const Vec3d> points, Within within,
                       std::size_t chunk_points, const std::function<void(PointBatch&)>& visit) {
  find_near(kernels, points, within, chunk_points, visit);
}

void find_kernels_near(const KernelSet& kernels, std::span<const Vec3f> points, Within within,
                       std::size_t chunk_points, const std::function<void(PointBatch&)>& visit) {
  find_near(kernels, points, within, chunk_points, visit);
}

}  // namespace leafhull
