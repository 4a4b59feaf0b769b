// SPDX-License-Identifier: Apache-2.0
// Casts a ray per pixel, one to the key light and one sample of the sky. The pixels of a square
// take sixteen directions in turn and share their results; only edges get more rays.
#include "render/draw_buffers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "render/for_each.h"
#include "render/light.h"
#include "render/mesh_target.h"
#include "render/sampling.h"

namespace leafhull::render {
namespace {

constexpr int kTile = 4;  // pixels of a square of kTile x kTile look in different directions
constexpr int kTurns = Surroundings::kTurns;
static_assert(kTile * kTile == kTurns);
constexpr std::size_t kBatch = 1 << 16;  // rays
constexpr std::size_t kGrain = 256;      // items that one thread takes at a time
constexpr double kLookShare = 0.75;      // share of the time, roughly; the rest is for edges

/// The shares of both lights that arrive at a point, 0..1.
struct Light {
  float key = 0, open = 0;
};

/// A place on a surface.
struct Point {
  Object object;
  Vec3f position, normal;
  float per_reach;  ///< 1 / the difference in depth that means another surface
};

class BufferPainter {
 public:
  BufferPainter(std::span<const Target* const> targets, const Surroundings& surroundings,
                const Camera& camera, int width, int height, Effort effort)
      : targets_(targets),
        surroundings_(surroundings),
        camera_(camera),
        edge_rays_(static_cast<std::size_t>(effort.edge_rays)),
        shares_(effort.shares),
        places_(sobol_points(effort.edge_rays, 3)),
        pixel_(2 * camera.tan_x / static_cast<float>(width)),
        tiles_across_((width + kTile - 1) / kTile) {
    buffers_.resize(width, height);
    buffers_.edge_rays = effort.edge_rays;
    buffers_.eye = camera.eye;
    buffers_.to_light = sun_direction(camera);
    buffers_.to_eye = -camera.forward;
    for (const Vec2f turn : sobol_points(kTurns, 1)) {
      key_turns_.push_back(normalized(on_disk(buffers_.to_light, turn, kSunRadius)));
    }
  }

  Buffers draw(const std::function<void(double)>& tell) && {
    const auto done = [&](double share) {
      if (tell) tell(share);
    };
    const int tiles_down = (buffers_.height + kTile - 1) / kTile;
    const int band = std::max<int>(1, kBatch / (kTurns * static_cast<std::size_t>(tiles_across_)));
    for (int first = 0; first < tiles_down; first += band) {
      look(first, std::min(band, tiles_down - first));
      done(kLookShare * std::min(first + band, tiles_down) / tiles_down);
    }
    for (int i = 0; i < shares_; ++i) share();
    find_edges();
    const std::size_t some =
        std::max<std::size_t>(1, kBatch / std::max<std::size_t>(1, edge_rays_));
    for (std::size_t first = 0; first < buffers_.edges.size(); first += some) {
      const std::size_t count = std::min(some, buffers_.edges.size() - first);
      look_around(first, count);
      const double edges = static_cast<double>(first + count) / buffers_.edges.size();
      done(kLookShare + (1 - kLookShare) * edges);
    }
    done(1);
    return std::move(buffers_);
  }

 private:
  struct Pixel {
    int x, y;
  };

  /// The pixel of ray `i` in a band that begins with tile row `first`; rays of a tile are
  /// consecutive.
  Pixel pixel_of(int first, std::size_t i) const {
    const int tile = static_cast<int>(i / kTurns), turn = static_cast<int>(i % kTurns);
    return {tile % tiles_across_ * kTile + turn % kTile,
            (first + tile / tiles_across_) * kTile + turn / kTile};
  }

  bool holds(Pixel p) const {
    return p.x >= 0 && p.y >= 0 && p.x < buffers_.width && p.y < buffers_.height;
  }
  std::size_t index(Pixel p) const { return static_cast<std::size_t>(p.y) * buffers_.width + p.x; }

  Ray ray_through(float x, float y) const {
    const float across = static_cast<float>(buffers_.width);
    const float down = static_cast<float>(buffers_.height);
    return {camera_.eye, normalized(camera_.direction(x / across, y / down))};
  }
  float depth_of(const Spot& spot, const Ray& ray) const {
    return spot.distance * dot(ray.direction, camera_.forward);
  }

  static Vec3f place_of(const Spot& spot, const Ray& ray) {
    return spot.hit() ? ray.origin + ray.direction * spot.distance : Vec3f{};
  }

  std::vector<Spot> nearest(std::span<const Ray> rays) const {
    std::vector<Spot> spots(rays.size()), others(targets_.size() > 1 ? rays.size() : 0);
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      if (t == 0) {
        targets_[t]->closest(rays, spots);
        continue;
      }
      targets_[t]->closest(rays, others);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (others[i].distance < spots[i].distance) spots[i] = others[i];
      }
    }
    return spots;
  }

  /// A sample of the light at each spot.
  std::vector<Light> sample_light(std::span<const Spot> spots,
                                  std::span<const std::uint8_t> turns) const {
    std::vector<Ray> rays;
    std::vector<std::size_t> facing;
    for (std::size_t i = 0; i < spots.size(); ++i) {
      const Vec3f key = key_turns_[turns[i]];
      if (!spots[i].hit() || dot(spots[i].normal, key) <= 0) continue;
      rays.push_back({spots[i].start, key});
      facing.push_back(i);
    }
    std::vector<Light> light(spots.size());
    const std::vector<std::uint8_t> hidden = occluded(targets_, rays, HUGE_VALF);
    for (std::size_t i = 0; i < facing.size(); ++i) light[facing[i]].key = hidden[i] ? 0 : 1;

    std::vector<float> open(spots.size());
    surroundings_.openness(spots, turns, open);
    for (std::size_t i = 0; i < spots.size(); ++i) light[i].open = open[i];
    return light;
  }

  /// Casts rays through the centres of the pixels in some rows of tiles.
  void look(int first, int rows) {
    const std::size_t count = std::size_t{kTurns} * tiles_across_ * rows;
    std::vector<Ray> rays(count);
    std::vector<std::uint8_t> turns(count);
    for_each(count, kGrain, [&](std::size_t i) {
      const auto [x, y] = pixel_of(first, i);
      rays[i] = ray_through(x + 0.5f, y + 0.5f);
      turns[i] = static_cast<std::uint8_t>(i % kTurns);
    });
    const std::vector<Spot> spots = nearest(rays);
    const std::vector<Light> light = sample_light(spots, turns);
    for_each(count, kGrain, [&](std::size_t i) {
      const Pixel pixel = pixel_of(first, i);
      if (!spots[i].hit() || !holds(pixel)) return;
      const std::size_t at = index(pixel);
      buffers_.object[at] = spots[i].object;
      buffers_.foliage[at] = spots[i].object == Object::foliage;
      buffers_.wood[at] = spots[i].object == Object::wood;
      buffers_.depth[at] = depth_of(spots[i], rays[i]);
      buffers_.normal[at] = spots[i].normal;
      buffers_.position[at] = place_of(spots[i], rays[i]);
      buffers_.color[at] = spots[i].color;
      buffers_.key[at] = light[i].key;
      buffers_.open[at] = light[i].open;
    });
  }

  Point point(std::size_t i) const {
    return {buffers_.object[i], buffers_.position[i], buffers_.normal[i],
            per_reach(buffers_.depth[i])};
  }
  float per_reach(float depth) const { return 1 / (4 * pixel_ * depth); }

  /// How likely two points belong to one surface, 0..1.
  float likeness(const Point& a, const Point& b) const {
    const float turned = dot(a.normal, b.normal);
    if (a.object != b.object || !(turned > 0)) return 0;
    const float apart = std::abs(dot(a.normal, b.position - a.position));
    return std::max(0.0f, 1 - apart * a.per_reach) * turned * turned;
  }

  /// Gives every pixel the mean light of its surface nearby, which has each turn once.
  void share() {
    std::vector<float> key = buffers_.key, open = buffers_.open;
    tbb::parallel_for(0, buffers_.height, [&](int y) {
      for (int x = 0; x < buffers_.width; ++x) {
        const std::size_t at = index({x, y});
        if (buffers_.object[at] == Object::paper) continue;
        const Light light = shared({x, y});
        key[at] = light.key, open[at] = light.open;
      }
    });
    buffers_.key.swap(key), buffers_.open.swap(open);
  }

  Light shared(Pixel pixel) const {
    const Point centre = point(index(pixel));
    Light sum;
    float key_weight = 1e-6f, open_weight = 1e-6f;
    constexpr int kReach = kTile / 2;
    for (int j = -kReach; j <= kReach; ++j) {
      for (int i = -kReach; i <= kReach; ++i) {
        const Pixel neighbour{pixel.x + i, pixel.y + j};
        if (!holds(neighbour)) continue;
        const std::size_t at = index(neighbour);
        const bool rim_x = std::abs(i) == kReach, rim_y = std::abs(j) == kReach;
        const float weight = likeness(centre, point(at)) * (rim_x ? 0.5f : 1) * (rim_y ? 0.5f : 1);
        sum.open += weight * buffers_.open[at], open_weight += weight;
        if (dot(buffers_.normal[at], buffers_.to_light) <= 0) continue;
        sum.key += weight * buffers_.key[at], key_weight += weight;
      }
    }
    return {sum.key / key_weight, sum.open / open_weight};
  }

  bool is_edge(Pixel pixel) const {
    const Point here = point(index(pixel));
    for (const auto [i, j] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const Pixel neighbour{pixel.x + i, pixel.y + j};
      if (!holds(neighbour)) continue;
      const Point there = point(index(neighbour));
      if (here.object != there.object) return true;
      if (here.object != Object::paper && likeness(here, there) < 0.1f) return true;
    }
    return false;
  }

  /// Lists the edge pixels tile by tile, so that neighbours are close together.
  void find_edges() {
    const int tiles_down = (buffers_.height + kTile - 1) / kTile;
    std::vector<std::vector<std::uint32_t>> rows(tiles_down);
    tbb::parallel_for(0, tiles_down, [&](int row) {
      for (std::size_t i = 0; i < std::size_t{kTurns} * tiles_across_; ++i) {
        const Pixel pixel = pixel_of(row, i);
        if (holds(pixel) && is_edge(pixel)) {
          rows[row].push_back(static_cast<std::uint32_t>(index(pixel)));
        }
      }
    });
    for (const auto& row : rows) {
      buffers_.edges.insert(buffers_.edges.end(), row.begin(), row.end());
    }
    buffers_.samples.resize(edge_rays_ * buffers_.edges.size());
  }

  /// Casts the extra rays of some edges.
  void look_around(std::size_t first, std::size_t count) {
    const std::span edges = std::span(buffers_.edges).subspan(first, count);
    const std::span samples =
        std::span(buffers_.samples).subspan(edge_rays_ * first, edge_rays_ * count);
    std::vector<Ray> rays(samples.size());
    for_each(samples.size(), kGrain, [&](std::size_t i) {
      const auto [x, y] = pixel_at(edges[i / edge_rays_]);
      const Vec2f place = places_[i % edge_rays_];
      rays[i] = ray_through(x + place.x, y + place.y);
    });
    const std::vector<Spot> spots = nearest(rays);
    std::vector<std::uint8_t> lit(samples.size());
    for_each(samples.size(), kGrain, [&](std::size_t i) {
      const Spot& spot = spots[i];
      EdgeSample& sample = samples[i];
      sample = {spot.object, depth_of(spot, rays[i]),
                spot.normal, place_of(spot, rays[i]),
                spot.color,  sample.key,
                sample.open};
      lit[i] = !spot.hit() || light_like(pixel_at(edges[i / edge_rays_]), sample);
    });
    light_alone(samples, spots, lit);
    for_each(count, kGrain,
             [&](std::size_t i) { cover(edges[i], samples.subspan(edge_rays_ * i, edge_rays_)); });
  }

  Pixel pixel_at(std::uint32_t index) const {
    const auto width = static_cast<std::uint32_t>(buffers_.width);
    return {static_cast<int>(index % width), static_cast<int>(index / width)};
  }

  /// Gives a sample the light of the neighbouring pixel that is most like it; false if none is like
  /// it.
  bool light_like(Pixel pixel, EdgeSample& sample) const {
    const Point here{sample.object, sample.position, sample.normal, per_reach(sample.depth)};
    float best = 0;
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const Pixel neighbour{pixel.x + i, pixel.y + j};
        if (!holds(neighbour)) continue;
        const std::size_t at = index(neighbour);
        const float like = likeness(here, point(at));
        if (like > best)
          best = like, sample.key = buffers_.key[at], sample.open = buffers_.open[at];
      }
    }
    return best > 0;
  }

  /// Samples the light of surfaces that no pixel's centre sees, such as twigs.
  void light_alone(std::span<EdgeSample> samples, std::span<const Spot> spots,
                   std::span<const std::uint8_t> lit) const {
    std::vector<Spot> alone;
    std::vector<std::size_t> places;
    std::vector<std::uint8_t> turns;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (lit[i]) continue;
      alone.push_back(spots[i]);
      places.push_back(i);
      turns.push_back(static_cast<std::uint8_t>(i % kTurns));
    }
    const std::vector<Light> light = sample_light(alone, turns);
    for (std::size_t i = 0; i < places.size(); ++i) {
      samples[places[i]].key = light[i].key, samples[places[i]].open = light[i].open;
    }
  }

  void cover(std::size_t pixel, std::span<const EdgeSample> samples) {
    for (const EdgeSample& sample : samples) {
      buffers_.foliage[pixel] += sample.object == Object::foliage;
      buffers_.wood[pixel] += sample.object == Object::wood;
    }
    buffers_.foliage[pixel] /= 1 + samples.size();
    buffers_.wood[pixel] /= 1 + samples.size();
  }

  std::span<const Target* const> targets_;
  const Surroundings& surroundings_;
  const Camera& camera_;
  std::size_t edge_rays_;
  int shares_;
  std::vector<Vec2f> places_;  ///< where an edge's rays lie in its pixel
  float pixel_;                ///< its size at a depth of 1
  int tiles_across_;
  std::vector<Vec3f> key_turns_;
  Buffers buffers_;
};

}  // namespace

void Buffers::resize(int new_width, int new_height) {
  width = new_width, height = new_height;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  object.assign(pixels, Object::paper);
  foliage.assign(pixels, 0), wood.assign(pixels, 0);
  depth.assign(pixels, HUGE_VALF);
  normal.assign(pixels, {}), position.assign(pixels, {}), color.assign(pixels, {});
  key.assign(pixels, 1), open.assign(pixels, 1);
  edges.clear(), samples.clear();
}

Buffers draw_buffers(std::span<const Target* const> targets, const Surroundings& surroundings,
                     const Camera& camera, int width, int height, Effort effort,
                     const std::function<void(double)>& tell) {
  return BufferPainter(targets, surroundings, camera, width, height, effort).draw(tell);
}

}  // namespace leafhull::render
