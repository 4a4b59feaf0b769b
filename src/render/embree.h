// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <memory>

namespace leafhull::render {

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using DeviceHandle = std::unique_ptr<RTCDeviceTy, Release>;
using SceneHandle = std::unique_ptr<RTCSceneTy, Release>;
using GeometryHandle = std::unique_ptr<RTCGeometryTy, Release>;

/// @throws Error internal: Embree does not start.
DeviceHandle open_embree();

}  // namespace leafhull::render
