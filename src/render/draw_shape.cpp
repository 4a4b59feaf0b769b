// SPDX-License-Identifier: Apache-2.0
// A quick picture of one mesh: a ray, one of the sun's and one of the sky's per pixel. Neighbours
// take turns over sixteen directions and share what they found; only at edges are there more rays.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "leafhull/error.h"
#include "leafhull/picture.h"
#include "render/light.h"
#include "render/sampling.h"
#include "render/scene.h"

namespace leafhull {
namespace render {
namespace {

constexpr float kMargin = 0.02f;
constexpr int kTurns = 4;     // pixels of a square of kTurns x kTurns look in different directions
constexpr int kEdgeRays = 4;  // beside the one through the centre

/// How much of the light arrives at a point, 0..1.
struct Light {
  float sun = 0, sky = 0;
};

/// What a pixel's centre sees.
struct Spot {
  std::optional<Hit> hit;
  Light light;
};

/// The first points of a sequence, computed once.
template <std::size_t count>
std::array<Vec2f, count> sobol_points(std::uint32_t seed) {
  std::array<Vec2f, count> points;
  for (std::uint32_t i = 0; i < count; ++i) points[i] = sobol(i, seed);
  return points;
}

template <class T>
class Grid {
 public:
  Grid(int width, int height)
      : width_(width), height_(height), cells_(static_cast<std::size_t>(width) * height) {}
  int width() const { return width_; }
  int height() const { return height_; }
  T& operator()(int x, int y) { return cells_[static_cast<std::size_t>(y) * width_ + x]; }
  const T& operator()(int x, int y) const {
    return cells_[static_cast<std::size_t>(y) * width_ + x];
  }
  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

 private:
  int width_, height_;
  std::vector<T> cells_;
};

class ShapePainter {
 public:
  ShapePainter(const Scene& scene, const Camera& camera, int width, int height)
      : scene_(scene),
        camera_(camera),
        sun_(sun_direction(camera)),
        spots_(width, height),
        smooth_(width, height),
        pixel_(2 * camera.tan_x * length(camera.eye) / width) {}

  Picture picture() {
    Picture picture{spots_.width(), spots_.height(), {}};
    picture.rgb.resize(std::size_t{3} * picture.width * picture.height);
    each_pixel([&](int x, int y) { spots_(x, y) = look(x, y); });
    each_pixel([&](int x, int y) { smooth_(x, y) = share(x, y); });
    each_pixel([&](int x, int y) {
      const Vec3f color = is_edge(x, y) ? edge_color(x, y) : color_at(x, y);
      std::uint8_t* rgb = &picture.rgb[3 * (static_cast<std::size_t>(y) * picture.width + x)];
      rgb[0] = srgb(color.x), rgb[1] = srgb(color.y), rgb[2] = srgb(color.z);
    });
    return picture;
  }

 private:
  template <class Function>
  void each_pixel(Function&& function) const {
    tbb::parallel_for(0, spots_.height(), [&](int y) {
      for (int x = 0; x < spots_.width(); ++x) function(x, y);
    });
  }

  std::optional<Hit> cast(float x, float y) const {
    return scene_.closest(camera_.eye, camera_.direction(x / spots_.width(), y / spots_.height()));
  }

  Spot look(int x, int y) const {
    Spot spot{cast(x + 0.5f, y + 0.5f), {}};
    if (!spot.hit) return spot;
    const Hit& hit = *spot.hit;
    const std::uint32_t turn = x % kTurns + y % kTurns * kTurns;
    const Vec3f sun = normalized(on_disk(sun_, sun_turns_[turn], kSunRadius));
    if (dot(hit.normal, sun) > 0) spot.light.sun = !scene_.occluded(hit.position, sun, HUGE_VALF);
    const Vec3f ray = cosine_direction(hit.normal, sky_turns_[turn]);
    spot.light.sky =
        dot(ray, hit.face_normal) > 0 && !scene_.occluded(hit.position, ray, kSkyReach);
    return spot;
  }

  /// How much two points belong to one surface, 0..1.
  float likeness(const Hit& a, const Hit& b) const {
    const float apart = std::abs(dot(a.normal, b.position - a.position)) / (4 * pixel_);
    const float turned = std::max(0.0f, dot(a.normal, b.normal));
    return std::max(0.0f, 1 - apart) * turned * turned;
  }

  /// The light of a spot and its neighbours, every turn counted once.
  Light share(int x, int y) const {
    const Spot& centre = spots_(x, y);
    if (!centre.hit) return {};
    Light sum;
    float sun_weight = 1e-6f, sky_weight = 1e-6f;
    constexpr int kReach = kTurns / 2;
    for (int j = -kReach; j <= kReach; ++j) {
      for (int i = -kReach; i <= kReach; ++i) {
        if (!spots_.holds(x + i, y + j)) continue;
        const Spot& spot = spots_(x + i, y + j);
        if (!spot.hit) continue;
        const bool rim_x = std::abs(i) == kReach, rim_y = std::abs(j) == kReach;
        const float weight =
            likeness(*centre.hit, *spot.hit) * (rim_x ? 0.5f : 1) * (rim_y ? 0.5f : 1);
        sum.sky += weight * spot.light.sky, sky_weight += weight;
        if (dot(spot.hit->normal, sun_) <= 0) continue;
        sum.sun += weight * spot.light.sun, sun_weight += weight;
      }
    }
    return {sum.sun / sun_weight, sum.sky / sky_weight};
  }

  bool is_edge(int x, int y) const {
    const std::optional<Hit>& here = spots_(x, y).hit;
    for (const auto [i, j] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      if (!spots_.holds(x + i, y + j)) continue;
      const std::optional<Hit>& there = spots_(x + i, y + j).hit;
      if (here.has_value() != there.has_value()) return true;
      if (here && likeness(*here, *there) < 0.1f) return true;
    }
    return false;
  }

  Vec3f shade(const Hit& hit, Light light) const {
    const Vec3f sky_there =
        mix(kPaperBounce, mix(kHorizon, kZenith, 0.6f), 0.5f + 0.5f * hit.normal.y);
    const Vec3f sky_light = mix(kShapeGreen * kHorizon * 0.35f, sky_there, light.sky);
    const Vec3f sun_light = kSun * (light.sun * std::max(0.0f, dot(hit.normal, sun_)));
    return develop(kShapeGreen * (sun_light + sky_light));
  }

  Vec3f color_at(int x, int y) const {
    const Spot& spot = spots_(x, y);
    return spot.hit ? shade(*spot.hit, smooth_(x, y)) : kWhite;
  }

  Vec3f edge_color(int x, int y) const {
    Vec3f sum = color_at(x, y);
    for (const Vec2f at : edge_points_) {
      const std::optional<Hit> hit = cast(x + at.x, y + at.y);
      sum = sum + (hit ? shade(*hit, light_like(*hit, x, y)) : kWhite);
    }
    return sum * (1.0f / (1 + kEdgeRays));
  }

  /// The light of the spot around (x, y) that is most like `hit`.
  Light light_like(const Hit& hit, int x, int y) const {
    float best = 0;
    Light light{0.5f, 0.5f};
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        if (!spots_.holds(x + i, y + j) || !spots_(x + i, y + j).hit) continue;
        const float like = likeness(hit, *spots_(x + i, y + j).hit);
        if (like > best) best = like, light = smooth_(x + i, y + j);
      }
    }
    return light;
  }

  const Scene& scene_;
  const Camera& camera_;
  Vec3f sun_;
  Grid<Spot> spots_;
  Grid<Light> smooth_;
  float pixel_;  ///< its size in the scene
  const std::array<Vec2f, kTurns* kTurns> sun_turns_ = sobol_points<kTurns * kTurns>(1);
  const std::array<Vec2f, kTurns* kTurns> sky_turns_ = sobol_points<kTurns * kTurns>(2);
  const std::array<Vec2f, kEdgeRays> edge_points_ = sobol_points<kEdgeRays>(3);
};

Picture draw(const Mesh& mesh, const Frame& view, const Box& box, int width, int height) {
  const Placement placement{(box.low + box.high) / 2, 1 / box.longest_side()};
  const DeviceHandle embree = open_embree();
  const Scene scene(embree.get(), {make_surface(embree.get(), mesh, placement)}, Build::quick);
  std::vector<Vec3f> points;
  points.reserve(view.points.size());
  for (const Vec3d p : view.points) points.push_back(placement(p));
  const Camera camera = frame(points, width / static_cast<float>(height), kMargin,
                              static_cast<float>(view.reach * placement.scale));
  return ShapePainter(scene, camera, width, height).picture();
}

/// The box of what a frame holds.
Box box_of(const Frame& frame) {
  Box box;
  for (const Vec3d p : frame.points) box.include(p);
  const Vec3d reach{frame.reach, frame.reach, frame.reach};
  return {box.low - reach, box.high + reach};
}

}  // namespace
}  // namespace render

Frame frame_of(const LeafSet& leaves, double radius_max) {
  Frame frame{{}, radius_max};
  frame.points.reserve(leaves.vertices.size());
  for (const LeafVertex& leaf : leaves.vertices) {
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
