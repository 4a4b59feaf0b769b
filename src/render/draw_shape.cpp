// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "leafhull/error.h"
#include "leafhull/picture.h"
#include "render/draw_buffers.h"
#include "render/frame.h"
#include "render/mesh_target.h"
#include "render/shade.h"

namespace leafhull {
namespace render {
namespace {

constexpr float kMargin = 0.02f;
constexpr Effort kEffort{.edge_rays = 4, .shares = 1};

Picture draw(const Mesh& mesh, const Frame& view, const Box& box, int width, int height) {
  const Placement placement{(box.low + box.high) / 2, 1 / box.longest_side()};
  const DeviceHandle embree = open_embree();
  const Scene scene(embree.get(), {make_surface(embree.get(), mesh, placement)}, Build::quick);
  std::vector<Vec3f> points;
  points.reserve(view.points.size());
  for (const Vec3d p : view.points) points.push_back(placement(p));
  const Camera camera = frame(points, width / static_cast<float>(height), kMargin,
                              static_cast<float>(view.reach * placement.scale));
  const MeshTarget target(scene);
  const std::array<const Target*, 1> targets{&target};
  return shade_matte(
      draw_buffers(targets, MeshSurroundings(targets), camera, width, height, kEffort));
}

}  // namespace

Box box_of(const Frame& frame) {
  Box box;
  for (const Vec3d p : frame.points) box.include(p);
  const Vec3d reach{frame.reach, frame.reach, frame.reach};
  return {box.low - reach, box.high + reach};
}

}  // namespace render

Frame frame_of(const LeafSet& leaves, double radius_max) {
  Frame frame{{}, radius_max};
  frame.points.reserve(leaves.vertices.size());
  for (const LeafVertex& leaf : leaves.vertices) {
    if (!leaves.crown.contains(leaf.position)) continue;
    frame.points.push_back(leaf.position);
    frame.reach = std::max(frame.reach, static_cast<double>(leaf.radius_major));
  }
  return frame;
}

Picture draw_shape(const Mesh& mesh, const Frame& frame, int width, int height) {
  if (width < 1 || height < 1) throw Error(ErrorCode::usage, "a picture has at least one pixel");
  if (mesh.triangles.empty()) {
    return {width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, 255)};
  }
  const Box box = render::box_of(frame);
  if (!(box.longest_side() > 0)) {
    throw Error(ErrorCode::usage, "the frame of a picture has no extent");
  }
  return render::draw(mesh, frame, box, width, height);
}

}  // namespace leafhull
