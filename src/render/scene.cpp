// SPDX-License-Identifier: Apache-2.0
#include "render/scene.h"

#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <utility>

#include "leafhull/error.h"

namespace leafhull::render {
namespace {

constexpr float kNear = 1e-5f;

RTCIntersectContext incoherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

RTCRay make_ray(Vec3f origin, Vec3f direction, float distance) {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = kNear;
  ray.tfar = distance;
  ray.mask = ~0u;
  return ray;
}

/// The normals at the three corners of a triangle, on the side of `face_normal`.
std::array<Vec3f, 3> corner_normals(const Surface& surface, unsigned triangle, Vec3f face_normal) {
  std::array<Vec3f, 3> normals{face_normal, face_normal, face_normal};
  if (surface.normals.empty()) return normals;
  for (int corner = 0; corner < 3; ++corner) {
    const Vec3f stored = surface.normals[surface.triangles[triangle][corner]];
    if (stored != Vec3f{}) normals[corner] = dot(stored, face_normal) < 0 ? -stored : stored;
  }
  return normals;
}

}  // namespace

DeviceHandle open_embree() {
  DeviceHandle device(rtcNewDevice(nullptr));
  if (!device) throw Error(ErrorCode::internal, "Embree does not start");
  return device;
}

Scene::Scene(RTCDevice device, std::vector<std::shared_ptr<const Surface>> surfaces, Build build)
    : surfaces_(std::move(surfaces)), scene_(rtcNewScene(device)) {
  if (build == Build::careful) {
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  } else {
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
  }
  for (unsigned id = 0; id < surfaces_.size(); ++id) {
    rtcAttachGeometryByID(scene_.get(), surfaces_[id]->geometry.get(), id);
  }
  // With several threads Embree would build a different hierarchy each time, and thus choose
  // differently among equally near hits.
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
    throw Error(ErrorCode::internal, "Embree cannot build the scene");
  }
}

void Scene::closest(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) std::array<int, kPacket> valid{};
  RTCRayHit16 packet{};
  for (unsigned i = 0; i < rays.size(); ++i) {
    valid[i] = -1;
    const auto& [origin, direction] = rays[i];
    RTCRay16& lanes = packet.ray;
    lanes.org_x[i] = origin.x, lanes.org_y[i] = origin.y, lanes.org_z[i] = origin.z;
    lanes.dir_x[i] = direction.x, lanes.dir_y[i] = direction.y, lanes.dir_z[i] = direction.z;
    lanes.tnear[i] = kNear, lanes.tfar[i] = HUGE_VALF;
    lanes.mask[i] = ~0u;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect16(valid.data(), scene_.get(), &context, &packet);
  for (unsigned i = 0; i < rays.size(); ++i) {
    hits[i].reset();
    const RTCHit hit = rtcGetHitFromHitN(reinterpret_cast<RTCHitN*>(&packet.hit), kPacket, i);
    if (hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    hits[i] = hit_of(rays[i].origin, rays[i].direction, hit, packet.ray.tfar[i]);
  }
}

Hit Scene::hit_of(Vec3f origin, Vec3f direction, const RTCHit& hit, float distance) const {
  const Surface& surface = *surfaces_[hit.geomID];
  const Vec3f stored_face = normalized(Vec3f{hit.Ng_x, hit.Ng_y, hit.Ng_z});
  const Vec3f face_normal = dot(stored_face, direction) > 0 ? -stored_face : stored_face;
  const std::array<Vec3f, 3> normals = corner_normals(surface, hit.primID, face_normal);
  const std::array<float, 3> weights{1 - hit.u - hit.v, hit.u, hit.v};
  const Vec3f flat = origin + direction * distance;
  Vec3f position = flat, normal;
  // Source: J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021.
  for (int corner = 0; corner < 3; ++corner) {
    const Vec3f vertex = surface.vertices[surface.triangles[hit.primID][corner]];
    const float below = std::fmin(0.0f, dot(flat - vertex, normals[corner]));
    position = position - normals[corner] * (below * weights[corner]);
    normal = normal + normals[corner] * weights[corner];
  }
  return {position,    normalized(normal),
          face_normal, surface.color(hit.primID, {hit.u, hit.v}),
          &surface,    distance};
}

bool Scene::occluded(Vec3f origin, Vec3f direction, float distance) const {
  RTCIntersectContext context = incoherent_context();
  RTCRay ray = make_ray(origin, direction, distance);
  rtcOccluded1(scene_.get(), &context, &ray);
  return ray.tfar < 0;
}

}  // namespace leafhull::render
