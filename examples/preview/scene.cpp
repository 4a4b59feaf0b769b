// SPDX-License-Identifier: Apache-2.0
#include "scene.h"

#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "leafhull/error.h"
#include "texture.h"

namespace leafhull::preview {
namespace {

constexpr float kNear = 1e-5f;  // the tree is about 1 high

/// Normals go by the cofactors of the linear part, which is its inverse transpose up to scale.
std::array<Vec3d, 3> cofactors(const Transform& m) {
  const auto row = [&](int i) { return Vec3d{m[i][0], m[i][1], m[i][2]}; };
  return {cross(row(1), row(2)), cross(row(2), row(0)), cross(row(0), row(1))};
}

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

}  // namespace

std::vector<Vec3d> world_positions(const TreeModel& model, const Instance& instance) {
  std::vector<Vec3d> points;
  const std::vector<Vec3f>& local = model.primitives[instance.primitive].positions;
  points.reserve(local.size());
  for (const Vec3f p : local) {
    const auto along = [&](const std::array<double, 4>& r) {
      return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
    };
    points.push_back(
        {along(instance.to_world[0]), along(instance.to_world[1]), along(instance.to_world[2])});
  }
  return points;
}

struct Surface {
  const TreeModel& model;
  const Primitive& primitive;
  Material material;
  Look look;
  std::array<Vec3d, 3> normal_matrix;
  std::unique_ptr<RTCGeometryTy, Release> geometry;
  const Vec3f* vertices = nullptr;  ///< placed; the geometry's own

  Vec2f uv_at(unsigned triangle, float u, float v) const {
    if (primitive.uvs.empty()) return {};
    const auto& [a, b, c] = primitive.triangles[triangle];
    const Vec2f &p = primitive.uvs[a], &q = primitive.uvs[b], &r = primitive.uvs[c];
    const float w = 1 - u - v;
    return {w * p.x + u * q.x + v * r.x, w * p.y + u * q.y + v * r.y};
  }

  /// At the three corners, on the side of `face_normal`.
  std::array<Vec3f, 3> normals_at(unsigned triangle, Vec3f face_normal) const {
    std::array<Vec3f, 3> normals{face_normal, face_normal, face_normal};
    if (primitive.normals.empty()) return normals;
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3d local(primitive.normals[primitive.triangles[triangle][corner]]);
      const Vec3f world(normalized(Vec3d{dot(normal_matrix[0], local), dot(normal_matrix[1], local),
                                         dot(normal_matrix[2], local)}));
      if (length(world) > 0) normals[corner] = dot(world, face_normal) < 0 ? -world : world;
    }
    return normals;
  }

  bool has_holes() const { return material.alpha_mode != AlphaMode::opaque && look != Look::shape; }
  double cutoff() const {
    return material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 0.5;
  }
};

namespace {

void pass_holes(const RTCFilterFunctionNArguments* args) {
  const auto& surface = *static_cast<const Surface*>(args->geometryUserPtr);
  const unsigned triangle = RTCHitN_primID(args->hit, args->N, 0);
  const float u = RTCHitN_u(args->hit, args->N, 0), v = RTCHitN_v(args->hit, args->N, 0);
  if (alpha(surface.model, surface.material, surface.uv_at(triangle, u, v)) < surface.cutoff()) {
    args->valid[0] = 0;
  }
}

}  // namespace

DeviceHandle open_embree() {
  DeviceHandle device(rtcNewDevice(nullptr));
  if (!device) throw Error(ErrorCode::internal, "Embree does not start");
  return device;
}

std::shared_ptr<Surface> make_surface(RTCDevice device, const TreeModel& model,
                                      const Instance& instance, Look look,
                                      const Placement& placement) {
  const Primitive& primitive = model.primitives[instance.primitive];
  std::shared_ptr<Surface> surface(new Surface{
      model, primitive, primitive.material < 0 ? Material{} : model.materials[primitive.material],
      look, cofactors(instance.to_world),
      std::unique_ptr<RTCGeometryTy, Release>(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE))});
  if (primitive.uvs.empty()) surface->material.base_color_image = -1;
  RTCGeometry geometry = surface->geometry.get();

  auto* vertices = static_cast<Vec3f*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, sizeof(Vec3f),
                                                               primitive.positions.size()));
  auto* triangles =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              sizeof primitive.triangles[0], primitive.triangles.size());
  if (!vertices || !triangles) {
    throw Error(ErrorCode::input, model.path.string() + ": too large to draw");
  }
  surface->vertices = vertices;
  for (const Vec3d p : world_positions(model, instance)) *vertices++ = placement(p);
  std::memcpy(triangles, primitive.triangles.data(),
              primitive.triangles.size() * sizeof primitive.triangles[0]);

  if (surface->has_holes()) {
    rtcSetGeometryUserData(geometry, surface.get());
    rtcSetGeometryIntersectFilterFunction(geometry, pass_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, pass_holes);
  }
  rtcCommitGeometry(geometry);
  return surface;
}

Scene::Scene(RTCDevice device, std::vector<std::shared_ptr<Surface>> surfaces)
    : surfaces_(std::move(surfaces)), scene_(rtcNewScene(device)) {
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  for (unsigned id = 0; id < surfaces_.size(); ++id) {
    rtcAttachGeometryByID(scene_.get(), surfaces_[id]->geometry.get(), id);
  }
  // Built by one thread the hierarchy, and so the choice among equally near hits, is always the
  // same.
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
    throw Error(ErrorCode::internal, "Embree cannot build the scene");
  }
}

std::optional<Hit> Scene::closest(Vec3f origin, Vec3f direction) const {
  RTCIntersectContext context = incoherent_context();
  RTCRayHit ray{make_ray(origin, direction, std::numeric_limits<float>::infinity()), {}};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_.get(), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const Surface& surface = *surfaces_[ray.hit.geomID];
  const RTCHit& hit = ray.hit;
  const Vec3f stored_face = normalized(Vec3f{hit.Ng_x, hit.Ng_y, hit.Ng_z});
  const Vec3f face_normal = dot(stored_face, direction) > 0 ? -stored_face : stored_face;
  const std::array<Vec3f, 3> normals = surface.normals_at(hit.primID, face_normal);
  const std::array<float, 3> weights{1 - hit.u - hit.v, hit.u, hit.v};
  const Vec3f flat = origin + direction * ray.ray.tfar;
  Vec3f position = flat, normal;
  // Source: J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021.
  for (int corner = 0; corner < 3; ++corner) {
    const Vec3f vertex = surface.vertices[surface.primitive.triangles[hit.primID][corner]];
    const float below = std::fmin(0.0f, dot(flat - vertex, normals[corner]));
    position = position - normals[corner] * (below * weights[corner]);
    normal = normal + normals[corner] * weights[corner];
  }
  return Hit{position, normalized(normal), face_normal,
             base_color(surface.model, surface.material, surface.uv_at(hit.primID, hit.u, hit.v)),
             surface.look};
}

bool Scene::occluded(Vec3f origin, Vec3f direction, float distance) const {
  RTCIntersectContext context = incoherent_context();
  RTCRay ray = make_ray(origin, direction, distance);
  rtcOccluded1(scene_.get(), &context, &ray);
  return ray.tfar < 0;
}

}  // namespace leafhull::preview
