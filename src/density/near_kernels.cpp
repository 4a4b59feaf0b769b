// SPDX-License-Identifier: Apache-2.0
#include "density/near_kernels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "density/simd.h"

namespace leafhull {
namespace {

constexpr std::size_t kGroup = sizeof(Floats) / sizeof(float);
/// A distance in voxels that is beyond every search.
constexpr float kFarAway = 1e15f;

}  // namespace

struct alignas(32) KernelGroups::Group {
  Ints cell_x, cell_y, cell_z;  // of the centres
  Floats x, y, z;               // offsets within
  Floats xx, xy, xz, yy, yz, zz;
  Floats reached;  // the square of U d at which the support ends, rounding included
};

/// Eight boxes, each around the centres of one group.
struct alignas(32) NearKernels::Boxes {
  Floats low_x, low_y, low_z, high_x, high_y, high_z;
};

struct alignas(32) NearKernels::Centres {
  Floats x, y, z;
};

KernelGroups::KernelGroups(std::span<const LatticeKernel> kernels)
    : groups_(new Group[(kernels.size() + kGroup - 1) / kGroup]) {
  tbb::parallel_for(std::size_t{0}, (kernels.size() + kGroup - 1) / kGroup, [&](std::size_t g) {
    Group& group = groups_[g];
    const auto members = kernels.subspan(g * kGroup, std::min(kGroup, kernels.size() - g * kGroup));
    for (std::size_t i = 0; i < kGroup; ++i) {
      const LatticeKernel out_of_reach{members[0].cell, {0, 0, kFarAway}, 0, 0, 0, 0, 0, 1, 1};
      const LatticeKernel& k = i < members.size() ? members[i] : out_of_reach;
      group.cell_x[i] = k.cell.x, group.cell_y[i] = k.cell.y, group.cell_z[i] = k.cell.z;
      group.x[i] = k.offset.x, group.y[i] = k.offset.y, group.z[i] = k.offset.z;
      group.xx[i] = k.xx, group.xy[i] = k.xy, group.xz[i] = k.xz;
      group.yy[i] = k.yy, group.yz[i] = k.yz, group.zz[i] = k.zz;
      group.reached[i] = k.top * (1.0f + kXiSlack);
    }
  });
}

KernelGroups::~KernelGroups() = default;

namespace {

/// The numbers of the bits that are set in a byte.
constexpr auto kSetBits = [] {
  std::array<std::array<std::int32_t, kGroup>, 1 << kGroup> numbers{};
  for (unsigned bits = 0; bits < numbers.size(); ++bits) {
    std::size_t size = 0;
    for (unsigned i = 0; i < kGroup; ++i) {
      if (bits >> i & 1) numbers[bits][size++] = static_cast<std::int32_t>(i);
    }
  }
  return numbers;
}();

/// Writes `first` plus the number of each true lane to `list`, which has room for eight. Returns
/// how many are true.
ALWAYS_INLINE std::size_t list_lanes(Ints truth, std::uint32_t first, std::uint32_t* list) {
  const unsigned bits = bits_of(truth);
  const Ints numbers = std::bit_cast<Ints>(kSetBits[bits]) + static_cast<std::int32_t>(first);
  std::memcpy(list, &numbers, sizeof numbers);
  return static_cast<std::size_t>(std::popcount(bits));
}

/// The element of each of eight vectors that `choose` picks: the least or the largest.
template <class Choose>
ALWAYS_INLINE Floats fold(const Floats* v, Choose&& choose) {
  const auto halves = [&](Floats a, Floats b) {
    return choose(__builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14),
                  __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15));
  };
  return halves(halves(halves(v[0], v[1]), halves(v[2], v[3])),
                halves(halves(v[4], v[5]), halves(v[6], v[7])));
}

/// The centres of the chosen groups, counted from `origin`, and the boxes around them.
template <class Group, class Centres, class Boxes>
FOR_EVERY_VECTOR_WIDTH void place(const Group* groups, std::span<const std::uint32_t> chosen,
                                  Coord origin, Centres* centres, Boxes* boxes) {
  const auto along = [&](Ints cell, Floats offset, std::int32_t from) {
    return __builtin_convertvector(cell - from, Floats) + offset;
  };
  const auto smaller = [](Floats a, Floats b) { return a < b ? a : b; };
  const auto larger = [](Floats a, Floats b) { return a > b ? a : b; };
  for (std::size_t first = 0; first < chosen.size(); first += kGroup, ++boxes) {
    Floats x[kGroup], y[kGroup], z[kGroup];
    for (std::size_t i = 0; i < kGroup; ++i) {
      if (first + i >= chosen.size()) {
        x[i] = y[i] = z[i] = Floats{} + kFarAway;
        continue;
      }
      const Group& k = groups[chosen[first + i]];
      x[i] = along(k.cell_x, k.x, origin.x);
      y[i] = along(k.cell_y, k.y, origin.y);
      z[i] = along(k.cell_z, k.z, origin.z);
      centres[first + i] = {x[i], y[i], z[i]};
    }
    *boxes = {fold(x, smaller), fold(y, smaller), fold(z, smaller),
              fold(x, larger),  fold(y, larger),  fold(z, larger)};
  }
}

template <class Group, class Centres>
FOR_EVERY_VECTOR_WIDTH std::size_t list_reaching(const Group* groups, const std::uint32_t* gathered,
                                                 const Centres* centres,
                                                 std::span<const std::uint32_t> near, Vec3f q,
                                                 Vec3f half, std::uint32_t* list) {
  std::size_t size = 0;
  for (const std::uint32_t place : near) {
    const Centres& c = centres[place];
    const Group& k = groups[gathered[place]];
    const Floats dx = q.x - c.x, dy = q.y - c.y, dz = q.z - c.z;
    const Floats mx = absolute(k.xx * dx + k.xy * dy + k.xz * dz);
    const Floats my = absolute(k.yy * dy + k.yz * dz);
    const Floats mz = absolute(k.zz * dz);
    const Floats ex = half.x * k.xx + half.y * absolute(k.xy) + half.z * absolute(k.xz);
    const Floats ey = half.y * k.yy + half.z * absolute(k.yz);
    const Floats ez = half.z * k.zz;
    const Floats x = positive(mx - ex), y = positive(my - ey), z = positive(mz - ez);
    const Ints reaches = x * x + y * y + z * z < k.reached;
    size += list_lanes(reaches, gathered[place] * static_cast<std::uint32_t>(kGroup), list + size);
  }
  return size;
}

template <class Boxes>
FOR_EVERY_VECTOR_WIDTH std::size_t list_near(const Boxes* boxes, std::size_t count, LocalBox box,
                                             float reach, std::uint32_t* list) {
  const float square = reach * reach;
  std::size_t size = 0;
  for (std::uint32_t first = 0; first < count; first += kGroup, ++boxes) {
    const Floats x = positive(larger(boxes->low_x - box.high.x, box.low.x - boxes->high_x));
    const Floats y = positive(larger(boxes->low_y - box.high.y, box.low.y - boxes->high_y));
    const Floats z = positive(larger(boxes->low_z - box.high.z, box.low.z - boxes->high_z));
    size += list_lanes(x * x + y * y + z * z <= square, first, list + size);
  }
  return size;
}

}  // namespace

NearKernels::NearKernels(const KernelSet& set, const KernelGroups& groups)
    : set_(set), groups_(groups) {}
NearKernels::~NearKernels() = default;
NearKernels::NearKernels(NearKernels&&) noexcept = default;

void NearKernels::load(Coord origin, const LocalBox& box) {
  const Vec3d from = to_vec3d(origin);
  set_.gather(from + Vec3d(box.low), from + Vec3d(box.high), gathered_);
  for (std::uint32_t& rank : gathered_) rank /= kGroup;
  gathered_.erase(std::unique(gathered_.begin(), gathered_.end()), gathered_.end());

  const Vec3f size = box.high - box.low;
  reach_ = static_cast<float>(set_.reach());
  slack_ = kDistanceSlack * (reach_ + std::max({size.x, size.y, size.z}));

  const std::size_t count = gathered_.size();
  centres_.resize(std::max(count, centres_.size()));
  boxes_.resize(std::max(count / kGroup + 1, boxes_.size()));
  place(groups_.groups_.get(), gathered_, origin, centres_.data(), boxes_.data());
}

void NearKernels::append_reaching(const LocalBox& box, std::vector<std::uint32_t>& ranks) {
  near_.resize(gathered_.size() + kGroup);  // entries are written before it is known if they count
  near_.resize(list_near(boxes_.data(), gathered_.size(), box, reach_ * (1 + kXiSlack) + slack_,
                         near_.data()));
  const Vec3f half =
      0.5f * (1 + kPositionSlack) * (box.high - box.low) + Vec3f(slack_, slack_, slack_);
  const std::size_t before = ranks.size();
  ranks.resize(before + (near_.size() + 1) * kGroup);
  ranks.resize(before + list_reaching(groups_.groups_.get(), gathered_.data(), centres_.data(),
                                      near_, 0.5f * (box.low + box.high), half,
                                      ranks.data() + before));
}

}  // namespace leafhull
