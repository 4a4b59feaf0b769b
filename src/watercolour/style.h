// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "leafhull/vec.h"

namespace leafhull::watercolour {

/// One layer of paint: what it looks like on white paper, and how the brush lays it.
struct Wash {
  Vec3f cool{}, warm{};      ///< sRGB of a coat of strength 1
  float strength = 0;        ///< pigment in the water
  float level = 0;           ///< how dark (washes of tone) or how near (outlines) it begins
  float size = 0;            ///< the size of the shapes it is simplified to
  float wetness = 0;         ///< how wet its edges are: 0 wet on dry to 1 wet on wet
  float lost_edges = 0;      ///< how much wetter the edges are in patches
  float edge_darkening = 0;  ///< pigment carried to the rim
  float granulation = 0;     ///< pigment in the valleys of the paper
  float raggedness = 0;      ///< how leaves break the edge
  float dry_brush = 0;       ///< how the paper's peaks break the edge
};

/// How a watercolour is painted. Widths are parts of the picture's height. The values of
/// styles/classic.json are the defaults.
struct Style {
  std::uint32_t seed = 0;

  Vec3f paper{};        ///< sRGB
  float grain = 0;      ///< the width of the paper's grain
  float roughness = 0;  ///< how much paint feels the grain
  float relief = 0;     ///< how much the light shows the grain

  float sky = 0;               ///< the sky's share of the light that tones are read from
  float dilution = 0;          ///< how much the lights are thinned towards the paper
  float warm_cool = 0;         ///< how far colours lean to warm and cool across the crown
  float turbulence = 0;        ///< unevenness of the pigment in the water
  float eddies = 0;            ///< the number of eddies across the scene
  float backruns = 0;          ///< fronts of pigment where water flowed back
  float dispersion = 0;        ///< specks of pigment
  float bleeding = 0;          ///< how much wet patches run into each other
  float bleeding_width = 0;    ///< how far wet patches run
  float edge_width = 0;        ///< the width of dark rims
  float wobble = 0;            ///< how an edge sways
  float gaps = 0;              ///< paper left free behind a mass in front
  float melting = 0;           ///< how far behind another a mass has melted away; scene units
  float melting_width = 0;     ///< how far around masses melt
  float melting_softness = 0;  ///< the softness of the edges of masses in front
  float ground_reach = 0;      ///< the reach of the wash at the foot, in half crowns

  float detail = 0;      ///< how many leaves are painted one by one
  float leaf_size = 0;   ///< the size of their strokes, in leaves
  float leaf_width = 0;  ///< the least half-length of a stroke, and half the largest

  Wash ambient, tone, shadow, wood, wood_shadow, leaves, ground;
};

/// A key of a style file.
struct StyleKey {
  std::string_view name;  ///< such as "bleeding"; for a wash, such as "shadow.wetness"
  std::string_view range, help;
  std::variant<std::uint32_t Style::*, float Style::*, Vec3f Style::*, float Wash::*, Vec3f Wash::*>
      member;
  float low = 0, high = 0;
};

/// The keys of a style; wash_keys() has those of every wash.
std::span<const StyleKey> style_keys();
std::span<const StyleKey> wash_keys();

struct WashName {
  std::string_view name, help;
  Wash Style::*wash;
};
std::span<const WashName> wash_names();

/// The keys, their ranges, defaults and meaning as a Markdown table.
std::string style_table();

/// The style that a JSON text describes. Missing keys are taken from the shipped style that its
/// key "base" names, else from `classic`.
/// @param file its name, for messages.
/// @throws Error usage: not JSON; or a key that is unknown, of a wrong type or out of range, named.
Style parse_style(std::string_view json, const std::string& file);

/// The shipped styles, `classic` first.
std::span<const std::string_view> style_names();

/// @throws Error usage: there is no style of this name.
Style shipped_style(std::string_view name);

}  // namespace leafhull::watercolour
