// SPDX-License-Identifier: Apache-2.0
// A watercolour, layer over layer.
#include "watercolour/paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "device/engine.h"
#include "leafhull/error.h"
#include "watercolour/foot.h"
#include "watercolour/passes.h"
#include "watercolour/things.h"
#include "watercolour/tint.h"
#include "watercolour/tones.h"

namespace leafhull::watercolour {
namespace {

constexpr std::size_t kMostPlanes = 40;  // in use at the same time

constexpr float kWrap = 0.25f;            // how far light reaches around a mass
constexpr float kNeighbourhood = 0.006f;  // of the picture's height
constexpr float kWoodMelts = 0.6f;        // behind foliage: its own lines are lost last
constexpr float kAntialias = 0.7f;        // pixels
constexpr float kBroad = 1.6f;        // size of the brush that breaks edges, in strokes of leaves
constexpr float kSoftness = 0.0008f;  // of the broken edges, as a share of the picture's height
constexpr float kLeafScale = 45;      // leaf-sized cells that break edges, in the scene

Vec3f absorbance(Vec3f color) {
  const auto of = [](float c) { return -std::log(std::max(c, 1 / 255.0f)); };
  return {of(color.x), of(color.y), of(color.z)};
}

/// Leaves of one colour, and the pigments for them.
struct Tone {
  Style style;
  Plane weight;  ///< how much of each pixel's foliage has it, 0..1; none: all
};

/// One picture while it is painted.
class Painting {
 public:
  Painting(Passes& passes, const PaperPlanes& paper, const render::Buffers& buffers,
           const Style& style)
      : passes_(passes),
        paper_(paper),
        buffers_(buffers),
        style_(style),
        unit_(static_cast<float>(buffers.height)),
        absorbance_{passes.constant(0), passes.constant(0), passes.constant(0)} {}

  std::vector<std::uint8_t> paint(const Leaves& leaves) {
    mix_tones(leaves.tones);
    const SeenPlanes seen = passes_.see(buffers_, style_.sky, kWrap);
    const Plane everywhere = passes_.constant(1);
    const Plane visible = look_around(seen);
    const Plane outline = blurred(passes_.upload(buffers_.foliage), style_.ambient);
    const Plane wood = blurred(passes_.upload(buffers_.wood), style_.wood);
    const Plane single_leaves = look_at_leaves(leaves, outline);

    if (const std::optional<Foot> foot = find_foot(buffers_)) {
      lay(style_.ground, ground_around(*foot), everywhere);
    }
    const Plane melted = passes_.mask(everywhere, visible, kWoodMelts);
    for (const Thing& thing : things_of(buffers_)) {
      const auto wash = [&](const Wash& of_wood) {
        return thing.colour ? hued(of_wood, *thing.colour) : of_wood;
      };
      const Plane bark =
          lay(wash(style_.wood), blurred(passes_.upload(thing.coverage), style_.wood), melted);
      lay(wash(style_.wood_shadow), dark(seen, style_.wood_shadow), bark);
    }

    const Plane crown =
        lay_foliage(&Style::ambient, outline, passes_.mask(everywhere, visible, style_.gaps));
    const Plane inside = passes_.mask(passes_.mask(crown, visible, 1), unlike(wood), 1);
    lay_foliage(&Style::tone, dark(seen, style_.tone), inside);
    run_together(crown);
    lay_foliage(&Style::shadow, dark(seen, style_.shadow), inside);
    if (single_leaves) lay_foliage(&Style::leaves, single_leaves, everywhere);
    return passes_.develop(absorbance_, paper_.relief, style_.paper, style_.relief);
  }

 private:
  /// Computes noise and darkness, extended softly beyond the silhouette, and returns how visible
  /// each place is behind the masses in front of it.
  Plane look_around(const SeenPlanes& seen) {
    const float sigma = kNeighbourhood * unit_;
    const Plane near = passes_.blur(seen.seen, sigma);
    const auto extended = [&](const Plane& plane) {
      return passes_.extend(seen.seen, plane, near, passes_.blur(plane, sigma));
    };
    const std::array<Plane, 3> places{extended(seen.x), extended(seen.y), extended(seen.z)};
    flow_ = passes_.flow(near, places, style_.eddies, kLeafScale, style_.seed);
    dark_ = passes_.darkness(passes_.blur(seen.light, sigma), near);

    const float width = style_.melting_width * unit_;
    const Plane visible = passes_.visibility(extended(seen.far), passes_.blur(seen.seen, width),
                                             passes_.blur(seen.far, width), style_.melting);
    return passes_.blur(visible, std::max(kAntialias, style_.melting_softness * unit_));
  }

  Plane ground_around(const Foot& foot) {
    const float reach = style_.ground_reach * foot.reach;
    return passes_.ground(unit_, {foot.x + 0.3f * reach, foot.y}, {reach, 0.14f * reach},
                          style_.seed);
  }

  Plane unlike(const Plane& plane) { return passes_.darkness(plane, passes_.constant(1)); }

  Plane blurred(const Plane& plane, const Wash& wash) {
    return passes_.blur(plane, wash.size * unit_);
  }

  Plane dark(const SeenPlanes& seen, const Wash& wash) {
    return passes_.darkness(blurred(seen.light, wash), blurred(seen.seen, wash));
  }

  /// Mixes the pigments for leaves of these colours, and finds where each colour is.
  void mix_tones(std::span<const Vec3f> colours) {
    if (colours.size() < 2) {
      tones_.push_back({colours.empty() ? style_ : tinted(style_, colours.front()), {}});
      return;
    }
    const float sigma = kNeighbourhood * unit_;
    const Weights weights = weigh_tones(buffers_, colours);
    const Plane seen = passes_.blur(passes_.upload(weights.seen), sigma);
    const auto lack_of = [&](const std::vector<float>& some) {
      return passes_.darkness(passes_.blur(passes_.upload(some), sigma), seen);
    };
    // The first tone takes what the others leave, which is everything where no leaf is near.
    tones_.push_back({tinted(style_, colours[0]), lack_of(weights.others)});
    for (std::size_t i = 1; i < colours.size(); ++i) {
      tones_.push_back({tinted(style_, colours[i]), unlike(lack_of(weights.other[i - 1]))});
    }
  }

  /// Paints a wash where `rho`, a blurred image, says, and returns where it lies.
  Plane lay(const Wash& wash, const Plane& rho, const Plane& within) {
    const auto [alpha, density] = spread(wash, rho, within, 0);
    glaze(wash, density);
    return alpha;
  }

  /// As lay(), with each tone's own pigments.
  Plane lay_foliage(Wash Style::*of, const Plane& rho, const Plane& within) {
    const Wash& wash = style_.*of;
    const auto [alpha, density] =
        spread(wash, rho, within, of == &Style::ambient ? style_.dilution : 0);
    for (const Tone& tone : tones_) {
      glaze(tone.style.*of, tone.weight ? passes_.mask(density, tone.weight, 1) : density);
    }
    return alpha;
  }

  /// Where a wash lies, and how much pigment.
  struct Layer {
    Plane alpha, density;
  };

  Layer spread(const Wash& wash, const Plane& rho, const Plane& within, float dilution) {
    const float crisp = std::min(0.5f, 0.35f / std::max(wash.size * unit_, 0.7f));
    Edge edge;
    edge.level = wash.level;
    edge.softness = crisp + (0.5f - crisp) * wash.wetness;
    edge.lost = 0.5f * wash.lost_edges;
    edge.dryness = wash.dry_brush * style_.roughness;
    edge.wobble = style_.wobble;
    edge.raggedness = wash.raggedness;
    const Plane alpha = passes_.layer(rho, within, paper_, flow_, edge);
    const Plane around = passes_.blur(alpha, style_.edge_width * unit_);
    const Plane density = passes_.darken_edges(alpha, around, wash.edge_darkening);
    passes_.dilute(density, flow_.turbulence, dark_, style_.turbulence, style_.backruns, dilution);
    passes_.granulate(density, paper_, wash.granulation * style_.roughness, style_.dispersion);
    return {alpha, density};
  }

  void glaze(const Wash& wash, const Plane& density) {
    const Vec3f cool = absorbance(wash.cool), warm = absorbance(wash.warm);
    passes_.glaze(density, flow_.warmth, {cool * wash.strength, warm * wash.strength},
                  style_.warm_cool, absorbance_);
  }

  /// Lets colours bleed where the crown is wet.
  void run_together(const Plane& crown) {
    if (style_.bleeding <= 0 || style_.bleeding_width <= 0) return;
    const float sigma = style_.bleeding_width * unit_;
    const Plane wet =
        passes_.blur(passes_.wet(flow_.wetness, crown, 1.6f * style_.bleeding), sigma);
    for (const Plane& plane : absorbance_) passes_.bleed(plane, passes_.blur(plane, sigma), wet);
  }

  /// Lets leaves break the edges of washes, and returns the strokes of single leaves, or none.
  Plane look_at_leaves(const Leaves& leaves, const Plane& outline) {
    if (leaves.strokes.empty()) return {};
    const std::vector<float> outline_here = passes_.download(outline);
    const std::vector<float> dark_here = passes_.download(dark_);
    const Room room{buffers_.width, buffers_.height, outline_here, dark_here, buffers_.depth};
    const Brush brush{.size = style_.leaf_size,
                      .least = style_.leaf_width * unit_,
                      .most = 2 * style_.leaf_width * unit_,
                      .tolerance = style_.melting,
                      .mark = leaves.mark};
    Brush broad = brush;
    broad.size *= kBroad, broad.least *= kBroad, broad.most *= kBroad;
    flow_.breaking = passes_.blur(passes_.upload(break_edges(leaves.strokes, room, broad)),
                                  std::max(kAntialias, kSoftness * unit_));
    if (style_.detail <= 0) return {};
    return passes_.upload(paint_leaves(leaves.strokes, room, brush, style_.detail));
  }

  Passes& passes_;
  const PaperPlanes& paper_;
  const render::Buffers& buffers_;
  const Style& style_;
  float unit_;  ///< the picture's height, pixels
  std::vector<Tone> tones_;
  FlowPlanes flow_;
  Plane dark_;
  std::array<Plane, 3> absorbance_;
};

}  // namespace

struct Painter::Impl {
  Device& device;
  int width = 0, height = 0;
  std::optional<Passes> passes{};
  PaperPlanes paper{};
  float grain = 0;
  std::uint32_t seed = 0;

  void prepare(const render::Buffers& buffers, const Style& style) {
    const bool same_size = passes && buffers.width == width && buffers.height == height;
    if (!same_size) {
      paper = {};
      passes.emplace(device, buffers.width, buffers.height);
      width = buffers.width, height = buffers.height;
    }
    if (same_size && paper.height && style.grain == grain && style.seed == seed) return;
    const int cells = std::max(1, static_cast<int>(std::lround(1 / style.grain)));
    paper = passes->paper(static_cast<float>(height), cells, style.seed);
    grain = style.grain, seed = style.seed;
  }
};

Painter::Painter(Device& device) : impl_(new Impl{device}) {}
Painter::~Painter() = default;
Painter::Painter(Painter&&) noexcept = default;

std::size_t Painter::memory() const { return impl_->passes ? impl_->passes->memory() : 0; }

std::size_t Painter::memory_of(int width, int height) {
  return kMostPlanes * Passes::plane_bytes(width, height);
}

Picture Painter::paint(const render::Buffers& buffers, const Leaves& leaves, const Style& style) {
  Device::Engine& engine = impl_->device.engine();
  const int width = buffers.width, height = buffers.height;
  if (width < 1 || height < 1) throw Error(ErrorCode::usage, "a picture has at least one pixel");
  const std::string what =
      "a watercolour of " + std::to_string(width) + "x" + std::to_string(height);
  return engine.run(what.c_str(), [&]() -> Picture {
    if (memory_of(width, height) > engine.info.memory_bytes ||
        Passes::plane_bytes(width, height) >
            engine.device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>()) {
      throw Error(ErrorCode::usage,
                  what + " does not fit into the memory of '" + engine.info.name + "'",
                  "Ask for a smaller picture.");
    }
    impl_->prepare(buffers, style);
    Painting painting(*impl_->passes, impl_->paper, buffers, style);
    return {width, height, painting.paint(leaves)};
  });
}

}  // namespace leafhull::watercolour
