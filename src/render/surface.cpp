// SPDX-License-Identifier: Apache-2.0
#include "render/surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "colour/colour.h"
#include "leafhull/error.h"
#include "render/light.h"

namespace leafhull::render {
namespace {

/// Two neighbouring texels along one axis and the weight of the second.
struct Texels {
  std::array<int, 2> index;
  float weight;

  Texels(float coordinate, int size, Wrap wrap) {
    float inside = coordinate;
    if (wrap == Wrap::repeat) inside -= std::floor(coordinate);
    if (wrap == Wrap::mirror) inside = std::abs(coordinate - 2 * std::floor((coordinate + 1) / 2));
    inside = inside > 0 ? std::min(inside, 1.0f) : 0;  // NaN becomes 0
    const float texel = inside * size - 0.5f;
    const int first = static_cast<int>(texel + 1) - 1, second = first + 1, last = size - 1;
    const bool around = wrap == Wrap::repeat;
    index = {first >= 0 ? first : around ? last : 0, second <= last ? second : around ? 0 : last};
    weight = texel - first;
  }
};

/// The texels around a point of an image, each with its weight.
template <class Function>
void for_each_texel(const Image& image, const Material& material, Vec2f uv, Function&& use) {
  const Texels column(uv.x, image.width, material.wrap_u);
  const Texels row(uv.y, image.height, material.wrap_v);
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const std::size_t texel =
          static_cast<std::size_t>(row.index[j]) * image.width + column.index[i];
      use(&image.rgba[4 * texel],
          (i ? column.weight : 1 - column.weight) * (j ? row.weight : 1 - row.weight));
    }
  }
}

/// The linear base colour of a material at `uv`: `image`, bilinear and wrapped, if there is one,
/// times its factor.
Vec3f base_color(const Material& material, const Image* image, Vec2f uv) {
  const std::array<float, 4>& factor = material.base_color;
  const Vec3f plain{factor[0], factor[1], factor[2]};
  if (!image) return plain;
  Vec3f sum;
  float total = 0;
  for_each_texel(*image, material, uv, [&](const std::uint8_t* rgba, float weight) {
    // Colours are weighted by their alpha: the colour of a hole must not bleed into the leaf.
    const float covered = weight * std::max<float>(rgba[3], 0.001f);
    sum = sum + linear_of_srgb({rgba[0], rgba[1], rgba[2]}) * covered;
    total += covered;
  });
  return {plain.x * sum.x / total, plain.y * sum.y / total, plain.z * sum.z / total};
}

/// The alpha of a material at `uv`, 0..1.
float alpha(const Material& material, const Image* image, Vec2f uv) {
  if (!image) return material.base_color[3];
  float sum = 0;
  for_each_texel(*image, material, uv,
                 [&](const std::uint8_t* rgba, float weight) { sum += weight * rgba[3]; });
  return material.base_color[3] * sum / 255;
}

void pass_holes(const RTCFilterFunctionNArguments* args) {
  const auto& surface = *static_cast<const Surface*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (!args->valid[i]) continue;
    const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
    const Vec2f at{RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i)};
    if (surface.is_hole(surface.uv(triangle, at))) args->valid[i] = 0;
  }
}

/// Gives the surface its triangles; `position(i)` is vertex i in model space.
template <class Function>
void set_triangles(Surface& surface, RTCDevice device, std::size_t vertex_count,
                   std::span<const std::array<std::uint32_t, 3>> triangles,
                   const Placement& placement, Function&& position) {
  surface.geometry = GeometryHandle(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  RTCGeometry geometry = surface.geometry.get();
  auto* vertices = static_cast<Vec3f*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), vertex_count));
  if (!vertices) throw Error(ErrorCode::internal, "Embree has no memory for a surface");
  for (std::size_t i = 0; i < vertex_count; ++i) vertices[i] = placement(position(i));
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(),
                             0, sizeof triangles[0], triangles.size());
  surface.vertices = {vertices, vertex_count};
  surface.triangles = triangles;
}

/// The flat material that a shape is drawn in.
Material shape_material(const std::optional<Vec3f>& leaves) {
  const auto [r, g, b] = foliage_colour(leaves);
  Material material;
  material.base_color = {r, g, b, 1};
  return material;
}

}  // namespace

Vec2f Surface::uv(unsigned triangle, Vec2f at) const {
  if (uvs.empty()) return {};
  const auto& [a, b, c] = triangles[triangle];
  const Vec2f &p = uvs[a], &q = uvs[b], &r = uvs[c];
  const float w = 1 - at.x - at.y;
  return {w * p.x + at.x * q.x + at.y * r.x, w * p.y + at.x * q.y + at.y * r.y};
}

Vec3f Surface::color(unsigned triangle, Vec2f at) const {
  const Vec3f base = base_color(material, image, uv(triangle, at));
  if (colors.empty()) return base;
  const auto& [a, b, c] = triangles[triangle];
  const Vec3f mixed = (1 - at.x - at.y) * colors[a] + at.x * colors[b] + at.y * colors[c];
  return {base.x * mixed.x, base.y * mixed.y, base.z * mixed.z};
}

bool Surface::is_hole(Vec2f uv) const {
  const double cutoff = material.alpha_mode == AlphaMode::mask ? material.alpha_cutoff : 0.5;
  return alpha(material, image, uv) < cutoff;
}

std::optional<Vec3f> colour_of_shape(const TreeModel& model, const Instance& instance) {
  const int material = model.primitives[instance.primitive].material;
  if (material < 0) return std::nullopt;
  const auto& [r, g, b, alpha] = model.materials[material].base_color;
  const auto [low, high] = std::minmax({r, g, b});
  if (high - low < 1e-3f) return std::nullopt;  // grey is a program's default
  return Vec3f{r, g, b};
}

std::shared_ptr<const Surface> make_surface(RTCDevice device, const TreeModel& model,
                                            const Instance& instance, Look look,
                                            const Placement& placement, bool cut_out) {
  const Primitive& primitive = model.primitives[instance.primitive];
  auto surface = std::make_shared<Surface>();
  surface->look = look;
  const std::vector<Vec3d> positions = world_positions(model, instance);
  set_triangles(*surface, device, positions.size(), primitive.triangles, placement,
                [&](std::size_t i) { return positions[i]; });

  const auto [x, y, z] = cofactors(instance.to_world);
  surface->normals.reserve(primitive.normals.size());
  for (const Vec3f n : primitive.normals) {
    const Vec3d local(n);
    surface->normals.emplace_back(normalized(Vec3d{dot(x, local), dot(y, local), dot(z, local)}));
  }

  surface->uvs = primitive.uvs;
  if (look == Look::shape) {
    surface->material = shape_material(colour_of_shape(model, instance));
  } else {
    if (primitive.material >= 0) surface->material = model.materials[primitive.material];
    surface->colors = primitive.colors;
  }
  const int image = surface->material.base_color_image;
  if (image >= 0 && !primitive.uvs.empty() && !model.images[image].empty()) {
    surface->image = &model.images[image];
  }
  if (cut_out || surface->material.alpha_mode != AlphaMode::opaque) {
    RTCGeometry geometry = surface->geometry.get();
    rtcSetGeometryUserData(geometry, surface.get());
    rtcSetGeometryIntersectFilterFunction(geometry, pass_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, pass_holes);
  }
  rtcCommitGeometry(surface->geometry.get());
  return surface;
}

std::shared_ptr<const Surface> make_surface(RTCDevice device, const Mesh& mesh,
                                            const Placement& placement) {
  auto surface = std::make_shared<Surface>();
  set_triangles(*surface, device, mesh.positions.size(), mesh.triangles, placement,
                [&](std::size_t i) { return mesh.origin + Vec3d(mesh.positions[i]); });
  surface->normals = mesh.normals;
  surface->material = shape_material(mesh.colour);
  rtcSetGeometryBuildQuality(surface->geometry.get(), RTC_BUILD_QUALITY_LOW);
  rtcCommitGeometry(surface->geometry.get());
  return surface;
}

std::vector<Vec3d> world_positions(const TreeModel& model, const Instance& instance) {
  std::vector<Vec3d> points;
  const std::vector<Vec3f>& local = model.primitives[instance.primitive].positions;
  points.reserve(local.size());
  for (const Vec3f p : local) points.push_back(transformed(instance.to_world, Vec3d(p)));
  return points;
}

}  // namespace leafhull::render
