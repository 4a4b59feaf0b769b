// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// Tells the colour of a crown's leaves at a place, at the scale of its masses.
class CrownColours {
 public:
  /// None if the leaves have a single or unknown colour.
  /// @param leaves of the tree's own instances; @param mass the size of masses, model units.
  static std::optional<CrownColours> of(const TreeModel& tree, const LeafSet& leaves, double mass);

  /// The mean colour of the leaves around a place in model units; linear.
  Vec3f at(Vec3d place) const;
  /// The 2 to 4 tones of the crown, the one of most leaves first; linear.
  const std::vector<Vec3f>& tones() const { return tones_; }

 private:
  /// A colour and how much leaf area has it.
  struct Heap {
    Vec3d sum;
    double area = 0;
  };

  CrownColours(const Box& crown, double mass);
  void put(Vec3d place, Vec3f colour, double area);
  void put_triangle(const std::array<Vec3d, 3>& corners, Vec3f colour, double kept);
  void spread();
  void tell_tones();
  /// Calls use(node, weight) for the nodes around a place.
  template <class Use>
  void around(Vec3d place, Use&& use) const;

  Vec3d low_;
  double cell_;
  std::array<std::size_t, 3> size_;
  std::vector<Heap> nodes_;  ///< x fastest
  Vec3f mean_;
  std::vector<Vec3f> tones_;
};

}  // namespace leafhull
