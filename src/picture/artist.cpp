// SPDX-License-Identifier: Apache-2.0
#include "picture/artist.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "leafhull/error.h"
#include "picture/check_picture.h"
#include "picture/parts.h"
#include "pipeline/stopwatch.h"
#include "render/draw_buffers.h"
#include "render/exr.h"
#include "render/light.h"
#include "render/shade.h"
#include "watercolour/style.h"

namespace leafhull {
namespace {

constexpr float kMargin = 0.06f;
constexpr double kTurn = 360;

/// The rough share of a picture's time that rays take.
double share_of_rays(Look look) { return look == Look::watercolour ? 0.5 : 1; }

render::Viewpoint viewpoint(Viewpoint named) {
  constexpr render::Viewpoint kViewpoints[] = {render::kFront, render::kThreeQuarter, render::kTop};
  return kViewpoints[static_cast<std::size_t>(named)];
}

/// The angle of view along a picture's longer side, degrees; `angle` is along its height.
double longer_angle(double angle, double aspect) {
  constexpr double kHalfDegree = std::numbers::pi / 360;
  return std::atan(std::tan(angle * kHalfDegree) * std::max(1.0, aspect)) / kHalfDegree;
}

render::Camera camera_at(const View& view, const render::Placement& placement, float aspect) {
  const auto in_scene = [&](Vec3d p) { return (p - placement.origin) * placement.scale; };
  constexpr double kFarthest = 1e9;  // beyond this, floats cannot hold rays
  if (!(length(in_scene(view.eye)) < kFarthest)) {
    throw Error(ErrorCode::usage, "the camera is too far from what it should draw",
                "Give an eye nearer to it, in the model's units.");
  }
  return render::look_at(in_scene(view.eye), in_scene(view.target), view.up,
                         longer_angle(view.angle, static_cast<double>(aspect)), aspect);
}

/// Gives the visible parts of a crown with several colours the colour of the leaves there.
void colour_foliage(const Subject::Parts& parts, render::Buffers& buffers) {
  if (!parts.crown_colours) return;
  const auto colour_at = [&](Vec3f position) {
    const auto& [origin, scale] = parts.placement;
    return render::foliage_colour(parts.crown_colours->at(Vec3d(position) / scale + origin));
  };
  tbb::parallel_for(std::size_t{0}, buffers.size(), [&](std::size_t i) {
    if (buffers.object[i] != render::Object::foliage) return;
    buffers.color[i] = colour_at(buffers.position[i]);
  });
  tbb::parallel_for(std::size_t{0}, buffers.samples.size(), [&](std::size_t i) {
    render::EdgeSample& sample = buffers.samples[i];
    if (sample.object == render::Object::foliage) sample.color = colour_at(sample.position);
  });
}

/// The leaves' colours for which pigments are mixed, linear.
std::vector<Vec3f> tones_of(const Subject::Parts& parts) {
  if (parts.crown_colours) return parts.crown_colours->tones();
  return parts.leaf_colour ? std::vector{*parts.leaf_colour} : std::vector<Vec3f>{};
}

watercolour::Mark mark_of(LeafKind kind) {
  switch (kind) {
    case LeafKind::needle:
      return watercolour::Mark::tuft;
    case LeafKind::frond:
      return watercolour::Mark::blade;
    case LeafKind::broad:
      break;
  }
  return watercolour::Mark::dab;
}

}  // namespace

render::Camera camera_of(const Subject::Parts& parts, const PictureOptions& options) {
  const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
  const double degrees = kTurn * options.turn;
  if (const View* view = std::get_if<View>(&options.camera)) {
    const render::Camera camera = camera_at(*view, parts.placement, aspect);
    // The middle of the subject is the scene's origin.
    return options.turntable ? render::Turntable{camera, {}}.at(degrees) : camera;
  }
  const render::Viewpoint from = viewpoint(std::get<Viewpoint>(options.camera));
  return options.turntable
             ? render::turntable(parts.points, aspect, kMargin, parts.reach, from).at(degrees)
             : render::frame(parts.points, aspect, kMargin, parts.reach, from);
}

std::vector<watercolour::Stroke> strokes_of(const Subject::Parts& parts,
                                            const render::Camera& camera, int width, int height) {
  const auto across = static_cast<float>(width), down = static_cast<float>(height);
  const auto depth = [&](Vec3f p) { return dot(p - camera.eye, camera.forward); };
  const auto project = [&](Vec3f p) {
    const Vec3f from_eye = p - camera.eye;
    const float x = dot(from_eye, camera.right) / (depth(p) * camera.tan_x);
    const float y = dot(from_eye, camera.up) / (depth(p) * camera.tan_y);
    return Vec2f{(1 + x) / 2 * across, (1 - y) / 2 * down};
  };
  std::vector<watercolour::Stroke> strokes;
  for (const LeafCard& leaf : parts.leaves) {
    const Vec3f major = leaf.centre + leaf.half_major, minor = leaf.centre + leaf.half_minor;
    if (!(std::min({depth(leaf.centre), depth(major), depth(minor)}) > 0)) continue;
    const Vec2f centre = project(leaf.centre), u = project(major), v = project(minor);
    strokes.push_back({.centre = centre,
                       .half_major = {u.x - centre.x, u.y - centre.y},
                       .half_minor = {v.x - centre.x, v.y - centre.y},
                       .depth = depth(leaf.centre),
                       .leaf = leaf.leaf});
  }
  return strokes;
}

Picture Artist::shade(const Subject::Parts& parts, const render::Buffers& buffers,
                      const render::Camera& camera, const PictureOptions& options) {
  const bool painted = options.look == Look::watercolour;
  switch (painted && parts.as_drawn ? Look::phong : options.look) {
    case Look::normals:
      return render::shade_normals(buffers, camera);
    case Look::depth:
      return render::shade_depth(buffers);
    case Look::watercolour: {
      if (!painter_) painter_.emplace(device_);
      const WatercolourStyle style =
          options.style ? options.style
                        : read_watercolour_style(std::string(watercolour_styles().front()));
      const auto strokes = strokes_of(parts, camera, options.width, options.height);
      const std::vector<Vec3f> tones = tones_of(parts);
      return painter_->paint(buffers, {strokes, tones, mark_of(parts.leaf_kind)}, *style);
    }
    case Look::phong:
      break;
  }
  return render::shade_phong(buffers);
}

Rendering Artist::draw(const Subject& subject, const PictureOptions& options,
                       const Progress& progress) {
  const ThreadLimit limit(device_.threads());
  const Progress untold;
  Stopwatch watch(untold);
  const Subject::Parts& parts = subject.parts();
  Rendering rendering;
  const double rays = share_of_rays(options.look);
  const auto start = [&](std::string_view stage, double done) {
    watch.start(stage);
    if (progress) progress(stage, done);
  };
  start("rays", 0);
  const render::Camera camera = camera_of(parts, options);
  const auto buffers = std::make_shared<render::Buffers>(
      render::draw_buffers(parts.targets, parts.surroundings(), camera, options.width,
                           options.height, {}, [&](double done) {
                             if (progress) progress("rays", rays * done);
                           }));
  colour_foliage(parts, *buffers);
  start("paint", rays);
  rendering.picture = shade(parts, *buffers, camera, options);
  rendering.blank = std::ranges::all_of(
      buffers->object, [](render::Object object) { return object == render::Object::paper; });
  rendering.buffers = buffers;
  rendering.seconds = watch.finish();
  rendering.seconds.pop_back();  // the total
  return rendering;
}

Rendering draw(const Subject& subject, const PictureOptions& options, Device& device,
               const Progress& progress) {
  check_picture(options, &device.info());
  return Artist(device).draw(subject, options, progress);
}

std::vector<std::uint8_t> encode_exr(const Rendering& rendering) {
  return render::encode_exr(*rendering.buffers, rendering.picture);
}

}  // namespace leafhull
