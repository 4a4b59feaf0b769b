// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <optional>
#include <vector>

#include "leafhull/tree.h"

namespace leafhull::preview {

/// From model space to the picture's: `origin` becomes zero, lengths are multiplied by `scale`.
struct Placement {
  Vec3d origin;
  double scale = 1;
  Vec3f operator()(Vec3d p) const { return Vec3f((p - origin) * scale); }
};

/// The vertices of an instance in model space.
std::vector<Vec3d> world_positions(const TreeModel& model, const Instance& instance);

enum class Look { wood, leaf, shape };

struct Hit {
  Vec3f position;  ///< on the smooth surface the normals describe, not to be shaded by its facets
  Vec3f normal;    ///< interpolated, unit, on the side of face_normal
  Vec3f face_normal;  ///< of the triangle, unit, on the ray's side
  Vec3f color;        ///< linear
  Look look;
};

/// An instance ready for ray casting; it can stand in several scenes. The model must outlive it.
struct Surface;

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using DeviceHandle = std::unique_ptr<RTCDeviceTy, Release>;
using SceneHandle = std::unique_ptr<RTCSceneTy, Release>;

/// @throws Error internal where Embree does not start.
DeviceHandle open_embree();

std::shared_ptr<Surface> make_surface(RTCDevice device, const TreeModel& model,
                                      const Instance& instance, Look look,
                                      const Placement& placement);

/// Surfaces that rays are cast against, from any number of threads. Texels below the alpha cutoff
/// are holes.
class Scene {
 public:
  Scene(RTCDevice device, std::vector<std::shared_ptr<Surface>> surfaces);

  std::optional<Hit> closest(Vec3f origin, Vec3f direction) const;
  bool occluded(Vec3f origin, Vec3f direction, float distance) const;

 private:
  std::vector<std::shared_ptr<Surface>> surfaces_;  ///< by Embree's geometry id
  SceneHandle scene_;
};

}  // namespace leafhull::preview
