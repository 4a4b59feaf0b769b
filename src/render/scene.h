// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/embree.h"
#include "render/surface.h"
#include "render/target.h"

namespace leafhull::render {

struct Hit {
  Vec3f position;  ///< on the smooth surface that the normals describe; facets cast no shade on it
  Vec3f normal;    ///< interpolated, unit, on the side of face_normal
  Vec3f face_normal;  ///< of the triangle, unit, on the ray's side
  Vec3f color;        ///< linear
  const Surface* surface;
  float distance;  ///< in lengths of the ray's direction
};

enum class Build { careful, quick };  ///< how to build the hierarchy: for many rays, for few

/// Surfaces that rays are cast against, from any number of threads. Texels below the alpha cutoff
/// are holes. The scene is about 1 large.
class Scene {
 public:
  Scene(RTCDevice device, std::vector<std::shared_ptr<const Surface>> surfaces,
        Build build = Build::careful);

  /// The nearest hits of up to kPacket neighbouring rays, which is faster than one by one.
  void closest(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const;
  static constexpr std::size_t kPacket = 16;
  bool occluded(Vec3f origin, Vec3f direction, float distance) const;

 private:
  Hit hit_of(Vec3f origin, Vec3f direction, const RTCHit& hit, float distance) const;

  std::vector<std::shared_ptr<const Surface>> surfaces_;  ///< by Embree's geometry id
  SceneHandle scene_;
};

}  // namespace leafhull::render
