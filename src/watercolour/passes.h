// SPDX-License-Identifier: Apache-2.0
// The passes of kernels/watercolour*.cl, one call each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "leafhull/device.h"
#include "leafhull/vec.h"
#include "render/buffers.h"

namespace leafhull::watercolour {

/// A float for each pixel, on the device. Copies share it; its memory is reused after the last one.
struct PlaneMemory;
using Plane = std::shared_ptr<PlaneMemory>;

struct PaperPlanes {
  Plane height;   ///< 0..1
  Plane speckle;  ///< -1..1, like `sway`
  Plane sway;
  Plane relief;  ///< about 1
};

/// Values summed over a pixel: zero where it sees nothing.
struct SeenPlanes {
  Plane seen, light, far, x, y, z;
};

/// Noise that stays with the tree, about -1..1.
struct FlowPlanes {
  Plane turbulence, warmth, breaking, wetness;
};

/// How the edge of a layer is laid, as the kernel `layer` says.
struct Edge {
  float level = 0.5f, softness = 0.1f, lost = 0;
  float dryness = 0, wobble = 0, raggedness = 0;
};

struct Pigments {
  Vec3f cool, warm;  ///< absorbances, -ln C
};

/// Passes over pictures of one size. Calls return at once unless they return values to the host.
/// They throw cl::Error.
class Passes {
 public:
  /// @throws Error device: a kernel that does not build.
  Passes(Device& device, int width, int height);
  ~Passes();

  /// Bytes of all planes that it holds, and of one plane.
  std::size_t memory() const;
  static std::size_t plane_bytes(int width, int height);

  Plane constant(float value);
  Plane upload(std::span<const float> values);
  std::vector<float> download(const Plane& plane);

  /// Paper that has `cells` cells of grain in `period` pixels, after which it repeats.
  PaperPlanes paper(float period, int cells, std::uint32_t seed);
  SeenPlanes see(const render::Buffers& buffers, float sky, float wrap);
  /// A patch of ground around `foot`, 1 in its middle.
  Plane ground(float size, Vec2f foot, Vec2f reach, std::uint32_t seed);
  FlowPlanes flow(const Plane& near, std::span<const Plane, 3> places, float eddies, float leaves,
                  std::uint32_t seed);

  /// A Gaussian blur, `sigma` in pixels.
  Plane blur(const Plane& in, float sigma);
  Plane darkness(const Plane& light, const Plane& seen);
  Plane extend(const Plane& seen, const Plane& value, const Plane& seen_near,
               const Plane& value_near);
  Plane visibility(const Plane& far, const Plane& seen_around, const Plane& far_around,
                   float reach);
  /// `plane` where `by` is 1 or `amount` 0, else less.
  Plane mask(const Plane& plane, const Plane& by, float amount);
  Plane layer(const Plane& rho, const Plane& within, const PaperPlanes& paper,
              const FlowPlanes& flow, const Edge& edge);
  Plane darken_edges(const Plane& alpha, const Plane& around, float amount);
  void dilute(const Plane& density, const Plane& turbulence, const Plane& dark, float turbulent,
              float backruns, float dilution);
  void granulate(const Plane& density, const PaperPlanes& paper, float granulation,
                 float dispersion);
  void glaze(const Plane& density, const Plane& warmth, const Pigments& pigments, float warm_cool,
             std::span<const Plane, 3> absorbance);
  Plane wet(const Plane& wetness, const Plane& alpha, float amount);
  void bleed(const Plane& absorbance, const Plane& around, const Plane& wet);
  std::vector<std::uint8_t> develop(std::span<const Plane, 3> absorbance, const Plane& relief,
                                    Vec3f paper, float shading);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace leafhull::watercolour
