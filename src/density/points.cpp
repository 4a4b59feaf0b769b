// SPDX-License-Identifier: Apache-2.0
#include "density/points.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace leafhull {
namespace {

/// A batch is handed over at about 4 MiB of ranks or of points.
constexpr std::size_t kBatchRanks = std::size_t{1} << 20;
constexpr std::size_t kBatchPoints = std::size_t{1} << 18;
/// A thread takes this many points or frames at once, and no more than kMostPoints of one frame.
constexpr std::size_t kSlicePoints = std::size_t{1} << 12, kSliceFrames = 64;
constexpr std::size_t kMostPoints = 4 * kSlicePoints;

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
  constexpr std::size_t kStretch = 4096;
  std::vector<std::vector<Run>> stretches((points.size() + kStretch - 1) / kStretch);
  tbb::parallel_for(std::size_t{0}, stretches.size(), [&](std::size_t s) {
    std::vector<Run>& runs = stretches[s];
    const std::size_t end = std::min((s + 1) * kStretch, points.size());
    for (std::size_t i = s * kStretch; i < end; ++i) {
      const Coord frame = block_origin(cell_of(Vec3d(points[i])), kFrameEdge);
      const auto point = static_cast<std::uint32_t>(i);
      if (!runs.empty() && runs.back().frame == frame) {
        runs.back().end = point + 1;
      } else {
        runs.push_back({frame, point, point + 1});
      }
    }
  });
  std::vector<Run> all;
  for (const auto& runs : stretches) all.insert(all.end(), runs.begin(), runs.end());
  tbb::parallel_sort(all);
  return all;
}

/// The runs of some frames, or of a part of one with many points.
std::vector<std::span<const Run>> in_slices(std::span<const Run> runs, std::size_t most_frames) {
  std::vector<std::span<const Run>> slices;
  for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
    std::size_t points = 0, frames = 0;
    for (; end < runs.size(); ++end) {
      const bool is_new = end == begin || runs[end].frame != runs[end - 1].frame;
      const bool is_full = points >= kSlicePoints || frames == most_frames;
      if ((is_new && is_full) || points >= kMostPoints) break;
      frames += is_new;
      points += runs[end].end - runs[end].begin;
    }
    slices.push_back(runs.subspan(begin, end - begin));
  }
  return slices;
}

/// A point of a frame.
struct Member {
  Vec3f offset;         // from the frame's origin
  std::uint32_t brick;  // its place in the frame
  std::uint32_t point;
};

/// Lists of kernels by brick.
class KnownLists {
 public:
  explicit KnownLists(const BrickList* lists) : lists_(lists) {
    if (!lists) return;
    bricks_.reserve(lists->size());
    for (std::uint32_t b = 0; b < lists->size(); ++b) bricks_.push_back({lists->origins[b], b});
    tbb::parallel_sort(bricks_);
  }

  /// The list of a block; none if it is not known.
  std::optional<std::span<const std::uint32_t>> of(const Block& block) const {
    if (!lists_ || block.edge != kBrickEdge) return {};
    const auto found = std::ranges::lower_bound(bricks_, block.origin, {}, &Known::first);
    if (found == bricks_.end() || found->first != block.origin) return {};
    return lists_->list(found->second);
  }

 private:
  using Known = std::pair<Coord, std::uint32_t>;
  const BrickList* lists_;
  std::vector<Known> bricks_;
};

/// Searches a slice at a time.
class Search {
 public:
  Search(const KernelSet& set, const PointSearch& how, const KnownLists& known)
      : set_(set), known_(known), how_(how) {}

  template <class T>
  PointBatch operator()(std::span<const Vec3<T>> points, std::span<const Run> runs) {
    PointBatch batch;
    batch.chunk_points = how_.chunk_points;
    for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
      const Coord frame = runs[begin].frame;
      members_.clear();
      for (; end < runs.size() && runs[end].frame == frame; ++end) {
        for (std::uint32_t i = runs[end].begin; i < runs[end].end; ++i) {
          const Vec3f offset = offset_in(frame, Vec3d(points[i]));
          members_.push_back({offset, brick_of(offset), i});
        }
      }
      std::ranges::sort(members_, {}, &Member::brick);
      add_frame(frame, batch);
    }
    return batch;
  }

 private:
  void add_frame(Coord frame, PointBatch& batch) {
    if (!how_.known && !pays_to_divide()) {
      return add_block({frame, kFrameEdge}, frame, members_, batch);
    }
    for (auto next = members_.begin(); next != members_.end();) {
      const auto last = std::find_if(next, members_.end(),
                                     [&](const Member& m) { return m.brick != next->brick; });
      const Coord brick = frame + block_origin(cell_of(Vec3d(next->offset)), kBrickEdge);
      add_block({brick, kBrickEdge}, frame, std::span(next, last), batch);
      next = last;
    }
  }

  /// The number of a point's brick in its frame.
  static std::uint32_t brick_of(Vec3f offset) {
    const auto upper = [](float v) { return v >= kBrickEdge ? 1u : 0u; };
    static_assert(kFrameEdge == 2 * kBrickEdge);
    return upper(offset.x) << 2 | upper(offset.y) << 1 | upper(offset.z);
  }

  /// Whether the frame is searched brick by brick. Each group tests the whole list of its block: a
  /// frame's is about three times as long as a brick's.
  bool pays_to_divide() const {
    std::size_t bricks = 1;
    for (std::size_t i = 1; i < members_.size(); ++i) {
      bricks += members_[i].brick != members_[i - 1].brick;
    }
    const std::size_t group_points = kGroupChunks * how_.chunk_points;
    return 3 * ((members_.size() + group_points - 1) / group_points) > bricks;
  }

  /// The kernels that may reach the places where points are evaluated, in a frame.
  std::span<const std::uint32_t> near(Coord frame, std::span<const Member> members) {
    const auto [low, high] = range_of(members);
    const PlaceBox places = places_in(low, high);
    const Vec3d centre = to_vec3d(frame) + Vec3d(places.centre), half(places.half);
    set_.gather(centre - half, centre + half, near_);
    // The device tests the list for each group anyway, so a test here pays off with several.
    if (members.size() > kGroupChunks * how_.chunk_points) {
      std::erase_if(
          near_, [&](std::uint32_t rank) { return !reaches(set_.kernels()[rank], frame, places); });
    }
    return near_;
  }

  void add_block(const Block& block, Coord frame, std::span<Member> members, PointBatch& batch) {
    const auto known = known_.of(block);
    batch.bricks.add(block.origin, known ? *known : near(frame, members));
    halve(members, batch.chunk_points);
    const std::size_t group_points = kGroupChunks * batch.chunk_points;
    while (!members.empty()) {
      const auto of_group = members.first(std::min(members.size(), group_points));
      add_group(frame, of_group, batch);
      members = members.subspan(of_group.size());
    }
  }

  static std::pair<Vec3f, Vec3f> range_of(std::span<const Member> members) {
    Vec3f low = members.front().offset, high = low;
    for (const auto& [p, brick, point] : members) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return {low, high};
  }

  /// Orders points so that chunks, consecutive ones, have small boxes: halves them, by whole
  /// chunks, along the longest side.
  static void halve(std::span<Member> members, std::size_t chunk_points) {
    if (members.size() <= chunk_points) return;
    const auto [low, high] = range_of(members);
    const Vec3f side = high - low;
    const auto axis = side.x >= side.y && side.x >= side.z ? &Vec3f::x
                      : side.y >= side.z                   ? &Vec3f::y
                                                           : &Vec3f::z;
    const std::size_t chunks = (members.size() + chunk_points - 1) / chunk_points;
    const std::size_t half = (chunks + 1) / 2 * chunk_points;
    std::nth_element(
        members.begin(), members.begin() + static_cast<std::ptrdiff_t>(half), members.end(),
        [axis](const Member& a, const Member& b) { return a.offset.*axis < b.offset.*axis; });
    halve(members.first(half), chunk_points);
    halve(members.subspan(half), chunk_points);
  }

  /// The offset of a point from its frame, rounded so that its cell stays the same.
  static Vec3f offset_in(Coord frame, Vec3d point) {
    const Vec3d offset = point - to_vec3d(frame);
    const Vec3d end = to_vec3d(cell_of(point)) - to_vec3d(frame) + Vec3d(1, 1, 1);
    const auto below = [](double v, double bound) {
      const auto near = static_cast<float>(v), limit = static_cast<float>(bound);
      return near < limit ? near : std::nextafter(limit, 0.0f);
    };
    return {below(offset.x, end.x), below(offset.y, end.y), below(offset.z, end.z)};
  }

  /// Adds a group to the last block.
  void add_group(Coord frame, std::span<const Member> members, PointBatch& batch) {
    const std::size_t n = batch.chunk_points;
    PointGroup group{frame, *(batch.bricks.first.end() - 2), batch.bricks.first.back(),
                     static_cast<std::uint32_t>(batch.index.size() / n), 0};
    ChunkBoxes boxes;
    for (; !members.empty(); ++group.count) {
      const auto of_chunk = members.first(std::min(members.size(), n));
      const std::size_t first = batch.index.size();
      batch.index.resize(first + n);
      for (auto* v : {&batch.x, &batch.y, &batch.z}) v->resize(first + n);
      for (std::size_t lane = 0; lane < n; ++lane) {
        const auto& [p, brick, point] = of_chunk[std::min(lane, of_chunk.size() - 1)];
        const std::size_t at = first + lane;
        batch.index[at] = point;
        batch.x[at] = p.x, batch.y[at] = p.y, batch.z[at] = p.z;
      }
      const auto [low, high] = range_of(of_chunk);
      const auto [centre, half] = places_in(low, high);
      const float row[] = {centre.x, centre.y, centre.z, half.x, half.y, half.z};
      for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i][group.count] = row[i];
      members = members.subspan(of_chunk.size());
    }
    for (std::size_t c = group.count; c < kGroupChunks; ++c) {
      for (auto& row : boxes) row[c] = row[group.count - 1];
    }
    batch.groups.push_back(group);
    batch.boxes.push_back(boxes);
  }

  /// The box in which points between `low` and `high` may be evaluated, rounding included.
  PlaceBox places_in(Vec3f low, Vec3f high) const {
    if (how_.within == Within::cell) {
      const auto below = [](Vec3f p) {
        return Vec3f(std::floor(p.x), std::floor(p.y), std::floor(p.z));
      };
      low = below(low), high = below(high) + Vec3f(1, 1, 1);
    }
    const float slack = kDistanceSlack * (static_cast<float>(set_.reach()) + kFrameEdge);
    return {0.5f * (low + high),
            0.5f * (1 + kPositionSlack) * (high - low) + Vec3f(slack, slack, slack)};
  }

  const KernelSet& set_;
  const KnownLists& known_;
  const PointSearch& how_;
  std::vector<std::uint32_t> near_;
  std::vector<Member> members_;
};

template <class T>
void find_near(const KernelSet& set, std::span<const Vec3<T>> points, const PointSearch& how,
               const std::function<void(PointBatch&)>& visit) {
  const std::vector<Run> runs = sorted_runs(points);
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  // Even if every kernel reaches every brick, there are 2^26 ranks at once at most, or a frame's
  // for each thread.
  const std::size_t most_ranks = (std::size_t{1} << 26) / threads;
  const std::vector<std::span<const Run>> slices = in_slices(
      runs, std::clamp<std::size_t>(most_ranks / (8 * set.kernels().size() + 1), 1, kSliceFrames));
  const KnownLists known(how.known);
  tbb::enumerable_thread_specific<Search> searches([&] { return Search(set, how, known); });
  PointBatch batch;
  std::size_t step = threads;  // slices searched at once
  for (std::size_t begin = 0, end = 0; begin < slices.size(); begin = end) {
    end = std::min(begin + step, slices.size());
    std::vector<PointBatch> found(end - begin);
    tbb::parallel_for(
        begin, end, [&](std::size_t s) { found[s - begin] = searches.local()(points, slices[s]); });
    std::size_t longest = 1;
    for (PointBatch& one : found) {
      longest = std::max(longest, one.bricks.kernels.size());
      batch.append(std::exchange(one, {}));
      if (batch.bricks.kernels.size() < kBatchRanks && batch.index.size() < kBatchPoints) continue;
      visit(batch);
      batch = {};
    }
    step = std::clamp<std::size_t>(kBatchRanks / longest, 1, 4 * threads);
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

void find_kernels_near(const KernelSet& kernels, std::span<const Vec3d> points,
                       const PointSearch& how, const std::function<void(PointBatch&)>& visit) {
  find_near(kernels, points, how, visit);
}

void find_kernels_near(const KernelSet& kernels, std::span<const Vec3f> points,
                       const PointSearch& how, const std::function<void(PointBatch&)>& visit) {
  find_near(kernels, points, how, visit);
}

}  // namespace leafhull
