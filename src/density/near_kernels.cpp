// SPDX-License-Identifier: Apache-2.0
#include "density/near_kernels.h"

#include <algorithm>
#include <cmath>

#include "density/simd.h"

namespace leafhull {
namespace {

constexpr std::size_t kGroup = sizeof(Floats) / sizeof(float);

constexpr LocalBox kNowhere{{HUGE_VALF, HUGE_VALF, HUGE_VALF},
                            {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF}};

Vec3f least(Vec3f a, Vec3f b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3f most(Vec3f a, Vec3f b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

}  // namespace

struct alignas(32) NearKernels::Group {
  Floats x, y, z;  // centres
  Floats xx, xy, xz, yy, yz, zz;
  std::uint32_t ranks[kGroup];
};

/// Boxes around the centres of eight groups.
struct alignas(32) NearKernels::Boxes {
  Floats low_x, low_y, low_z, high_x, high_y, high_z;
};

namespace {

template <class Group>
FOR_EVERY_VECTOR_WIDTH std::size_t list_reaching(const Group* groups,
                                                 std::span<const std::uint32_t> near, Vec3f q,
                                                 Vec3f half, std::uint32_t* list) {
  std::size_t size = 0;
  for (const std::uint32_t group : near) {
    const Group& k = groups[group];
    const Floats dx = q.x - k.x, dy = q.y - k.y, dz = q.z - k.z;
    const Floats mx = absolute(k.xx * dx + k.xy * dy + k.xz * dz);
    const Floats my = absolute(k.yy * dy + k.yz * dz);
    const Floats mz = absolute(k.zz * dz);
    const Floats ex = half.x * k.xx + half.y * absolute(k.xy) + half.z * absolute(k.xz);
    const Floats ey = half.y * k.yy + half.z * absolute(k.yz);
    const Floats ez = half.z * k.zz;
    const Floats x = positive(mx - ex), y = positive(my - ey), z = positive(mz - ez);
    const Ints reaches = x * x + y * y + z * z < 1.0f + kXiSlack;
    for (std::size_t i = 0; i < kGroup; ++i) {
      list[size] = k.ranks[i];
      size += static_cast<std::size_t>(-reaches[i]);
    }
  }
  return size;
}

template <class Boxes>
FOR_EVERY_VECTOR_WIDTH std::size_t list_near(const Boxes* boxes, std::size_t groups, LocalBox box,
                                             float reach, std::uint32_t* list) {
  const float square = reach * reach;
  std::size_t size = 0;
  for (std::uint32_t first = 0; first < groups; first += kGroup, ++boxes) {
    const Floats x = positive(larger(boxes->low_x - box.high.x, box.low.x - boxes->high_x));
    const Floats y = positive(larger(boxes->low_y - box.high.y, box.low.y - boxes->high_y));
    const Floats z = positive(larger(boxes->low_z - box.high.z, box.low.z - boxes->high_z));
    const Ints near = x * x + y * y + z * z <= square;
    for (std::uint32_t i = 0; i < kGroup; ++i) {
      list[size] = first + i;
      size += static_cast<std::size_t>(-near[i]);
    }
  }
  return size;
}

}  // namespace

NearKernels::NearKernels() = default;
NearKernels::~NearKernels() = default;

void NearKernels::set_box(std::size_t group, const LocalBox& box) {
  Boxes& boxes = boxes_[group / kGroup];
  const std::size_t i = group % kGroup;
  boxes.low_x[i] = box.low.x, boxes.low_y[i] = box.low.y, boxes.low_z[i] = box.low.z;
  boxes.high_x[i] = box.high.x, boxes.high_y[i] = box.high.y, boxes.high_z[i] = box.high.z;
}

void NearKernels::load(const KernelSet& set, Coord origin, const LocalBox& box) {
  const Vec3d from = to_vec3d(origin);
  set.gather(from + Vec3d(box.low), from + Vec3d(box.high), gathered_);
  const Vec3f size = box.high - box.low;
  reach_ = static_cast<float>(set.reach());
  slack_ = kDistanceSlack * (reach_ + std::max({size.x, size.y, size.z}));

  const std::size_t count = (gathered_.size() + kGroup - 1) / kGroup;
  count_ = count;
  if (groups_.size() < count) groups_.resize(count);
  if (boxes_.size() <= count / kGroup) boxes_.resize(count / kGroup + 1);
  const std::span<const LatticeKernel> kernels = set.kernels();
  for (std::size_t g = 0; g < count; ++g) {
    Group& group = groups_[g];
    LocalBox centres = kNowhere;
    const std::size_t filled = std::min(kGroup, gathered_.size() - g * kGroup);
    for (std::size_t i = 0; i < filled; ++i) {
      const LatticeKernel& k = kernels[gathered_[g * kGroup + i]];
      const Vec3f c =
          Vec3f(static_cast<float>(k.cell.x - origin.x), static_cast<float>(k.cell.y - origin.y),
                static_cast<float>(k.cell.z - origin.z)) +
          k.offset;
      centres = {least(centres.low, c), most(centres.high, c)};
      group.x[i] = c.x, group.y[i] = c.y, group.z[i] = c.z;
      group.xx[i] = k.xx, group.xy[i] = k.xy, group.xz[i] = k.xz;
      group.yy[i] = k.yy, group.yz[i] = k.yz, group.zz[i] = k.zz;
      group.ranks[i] = gathered_[g * kGroup + i];
    }
    for (std::size_t i = filled; i < kGroup; ++i) {  // out of reach
      group.z[i] = 1e15f, group.zz[i] = 1;
      group.xx[i] = group.xy[i] = group.xz[i] = group.yy[i] = group.yz[i] = 0;
    }
    set_box(g, centres);
  }
  for (std::size_t g = count; g % kGroup != 0; ++g) set_box(g, kNowhere);
}

void NearKernels::append_reaching(const LocalBox& box, std::vector<std::uint32_t>& ranks) {
  near_.resize(count_ + kGroup);  // what is written before it is known to count
  near_.resize(
      list_near(boxes_.data(), count_, box, reach_ * (1 + kXiSlack) + slack_, near_.data()));
  const Vec3f half =
      0.5f * (1 + kPositionSlack) * (box.high - box.low) + Vec3f(slack_, slack_, slack_);
  const std::size_t before = ranks.size();
  ranks.resize(before + (near_.size() + 1) * kGroup);
  ranks.resize(before + list_reaching(groups_.data(), near_, 0.5f * (box.low + box.high), half,
                                      ranks.data() + before));
}

}  // namespace leafhull
