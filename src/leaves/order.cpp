// SPDX-License-Identifier: Apache-2.0
#include "leaves/order.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace leafhull {
namespace {

constexpr int kBitsPerAxis = 21;

/// Two zero bits after each of the low 21 bits.
std::uint64_t spread_bits(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

bool precedes(const LeafVertex& a, const LeafVertex& b) {
  const auto key = [](const LeafVertex& v) {
    return std::tie(v.position.x, v.position.y, v.position.z, v.normal.x, v.normal.y, v.normal.z,
                    v.major.x, v.major.y, v.major.z, v.radius_major, v.radius_minor);
  };
  return key(a) < key(b);
}

/// The rank of each leaf when leaves are compared by all their vertices. Vertices that are equal
/// may belong to different leaves.
std::vector<std::uint32_t> rank_leaves(const LeafSet& leaves) {
  std::vector<std::size_t> begin(leaves.leaf_count + 1);
  for (const LeafVertex& vertex : leaves.vertices) ++begin[vertex.leaf + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());

  std::vector<std::uint32_t> order(leaves.leaf_count);
  std::iota(order.begin(), order.end(), 0u);
  const auto at = [&](std::size_t i) { return leaves.vertices.begin() + static_cast<long>(i); };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::lexicographical_compare(at(begin[a]), at(begin[a + 1]), at(begin[b]),
                                        at(begin[b + 1]), precedes);
  });
  std::vector<std::uint32_t> rank(leaves.leaf_count);
  for (std::uint32_t place = 0; place < order.size(); ++place) rank[order[place]] = place;
  return rank;
}

std::vector<std::uint32_t> order_of_vertices(const LeafSet& leaves) {
  const std::vector<LeafVertex>& vertices = leaves.vertices;
  const auto code = [&](std::uint32_t i) {
    return morton_code(vertices[i].position, leaves.bounds);
  };
  std::vector<std::uint32_t> rank;  // few files have leaves that lie on each other
  return order_by_code(vertices.size(), code, [&](std::uint32_t a, std::uint32_t b) {
    if (precedes(vertices[a], vertices[b])) return true;
    if (precedes(vertices[b], vertices[a])) return false;
    if (rank.empty()) rank = rank_leaves(leaves);
    return rank[vertices[a].leaf] < rank[vertices[b].leaf];
  });
}

}  // namespace

std::uint64_t morton_code(Vec3d position, const Box& bounds) {
  constexpr double kCells = 1 << kBitsPerAxis;
  const double side = bounds.longest_side();
  const Vec3d scaled = side > 0 ? (position - bounds.low) / side * kCells : Vec3d{};
  const auto cell = [](double x) {
    return spread_bits(static_cast<std::uint64_t>(std::clamp(x, 0.0, kCells - 1)));
  };
  return cell(scaled.x) | cell(scaled.y) << 1 | cell(scaled.z) << 2;
}

std::vector<std::uint32_t> order_by_code(
    std::size_t count, const std::function<std::uint64_t(std::uint32_t)>& code,
    const std::function<bool(std::uint32_t, std::uint32_t)>& precedes) {
  struct Entry {
    std::uint64_t code;
    std::uint32_t place;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const auto place = static_cast<std::uint32_t>(i);
    entries[i] = {code(place), place};
  });
  tbb::parallel_sort(entries.begin(), entries.end());
  for (auto begin = entries.begin(); begin != entries.end();) {
    const auto end =
        std::find_if(begin, entries.end(), [&](const Entry& e) { return e.code != begin->code; });
    if (end - begin > 1) std::ranges::sort(begin, end, precedes, &Entry::place);
    begin = end;
  }
  std::vector<std::uint32_t> order;
  order.reserve(entries.size());
  for (const Entry& entry : entries) order.push_back(entry.place);
  return order;
}

void sort_vertices(LeafSet& leaves) {
  put_in_order(leaves.vertices, order_of_vertices(leaves));
  constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> renumbered(leaves.leaf_count, kUnseen);
  std::uint32_t next = 0;
  for (LeafVertex& vertex : leaves.vertices) {
    std::uint32_t& number = renumbered[vertex.leaf];
    if (number == kUnseen) number = next++;
    vertex.leaf = number;
  }
  leaves.order_in_file.resize(leaves.leaf_count);
  for (std::uint32_t in_file = 0; in_file < renumbered.size(); ++in_file) {
    leaves.order_in_file[renumbered[in_file]] = in_file;
  }
}

}  // namespace leafhull
