// SPDX-License-Identifier: Apache-2.0
#include "foliage/appearance.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "colour/colour.h"
#include "foliage/evidence.h"
#include "foliage/surface_colour.h"
#include "foliage/survey.h"

namespace leafhull {
namespace {

constexpr std::size_t kMostParts = 12;
/// Colours closer than this in Oklab count as one.
constexpr double kOneColour = 0.11;
/// A spread of colour within triangles below this means a palette or vertex colours; above it, a
/// photograph.
constexpr double kPaletteSpread = 0.03 * 0.03;
/// A piece with at least this share cut away has holes.
constexpr double kHoles = 0.02;

/// A colour with this much evidence for or against leaves decides alone.
constexpr double kTelling = 1;
/// A piece is mixed if it has at least this many triangles and this share of its area in each of
/// the two colours.
constexpr std::size_t kMixedTriangles = 100;
constexpr double kMixedShare = 0.04;

/// Groups colours: one near an earlier colour joins its class. The largest areas must come first.
class ColourClasses {
 public:
  std::uint8_t of(Vec3d colour) {
    const Vec3d lab = oklab_of(Vec3f(colour));
    std::size_t nearest = 0;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < classes_.size(); ++i) {
      const double distance = length(classes_[i].lab - lab);
      if (distance < least) least = distance, nearest = i;
    }
    if (least > kOneColour && classes_.size() < kMostParts) {
      nearest = classes_.size();
      classes_.push_back({lab, std::abs(colour_evidence(Vec3f(colour))) >= kTelling});
    }
    return static_cast<std::uint8_t>(nearest);
  }
  /// Whether the colour alone tells leaves from other things.
  bool tells(std::uint8_t number) const { return classes_[number].tells; }

 private:
  struct Class {
    Vec3d lab;
    bool tells;
  };
  std::vector<Class> classes_;
};

/// Indices from the greatest area to the least.
std::vector<std::uint32_t> by_area(const std::vector<double>& areas) {
  std::vector<std::uint32_t> order(areas.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](auto a, auto b) { return areas[a] > areas[b]; });
  return order;
}

/// Whether a piece has triangles of a leaf's colour and of bark's: a tree in one piece.
std::vector<bool> mixed_pieces(const Surface& surface) {
  std::vector<double> for_leaves(surface.pieces.size()), against(surface.pieces.size());
  for (std::size_t t = 0; t < surface.areas.size(); ++t) {
    if (surface.pieces[surface.piece_of[t]].triangles < kMixedTriangles) continue;
    const double evidence = colour_evidence(surface.shown_at(t).colour);
    if (evidence > kTelling) for_leaves[surface.piece_of[t]] += surface.areas[t];
    if (evidence < -kTelling) against[surface.piece_of[t]] += surface.areas[t];
  }
  std::vector<bool> mixed;
  for (std::size_t i = 0; i < surface.pieces.size(); ++i) {
    const double least = kMixedShare * surface.pieces[i].area;
    mixed.push_back(for_leaves[i] > least && against[i] > least);
  }
  return mixed;
}

/// The class of each triangle by what differs most plainly: holes, then colour, then form if the
/// colour does not decide.
std::vector<std::uint8_t> classes_of(const Surface& surface, bool has_colour) {
  const std::size_t count = surface.areas.size();
  double area = 0, with_holes = 0, spread = 0;
  for (const Piece& piece : surface.pieces) {
    area += piece.area;
    spread += piece.area * piece.spread;
    if (piece.kept < 1 - kHoles) with_holes += piece.area;
  }
  const bool holes_tell = with_holes > kHoles * area;
  const bool is_palette = spread <= kPaletteSpread * area;
  const std::vector<bool> mixed = mixed_pieces(surface);

  // The unit of colour is a triangle, or a whole piece if it shows a photograph.
  ColourClasses colours;
  std::vector<std::uint8_t> colour_of(count), colour_of_piece(surface.pieces.size());
  std::vector<double> areas;
  for (const Piece& piece : surface.pieces) areas.push_back(piece.area);
  for (const std::uint32_t i : by_area(areas)) {
    if (!is_palette && !mixed[i]) colour_of_piece[i] = colours.of(surface.pieces[i].colour);
  }
  for (const std::uint32_t t : by_area(surface.areas)) {
    const std::uint32_t piece = surface.piece_of[t];
    const bool by_triangle = is_palette || mixed[piece];
    colour_of[t] =
        by_triangle ? colours.of(Vec3d(surface.shown_at(t).colour)) : colour_of_piece[piece];
  }

  constexpr std::uint8_t kWithHoles = 0;
  std::vector<std::uint8_t> classes(count, kWithHoles);
  for (std::size_t t = 0; t < count; ++t) {
    const Piece& piece = surface.pieces[surface.piece_of[t]];
    if (holes_tell && piece.kept < 1 - kHoles) continue;
    const bool tells = has_colour && colours.tells(colour_of[t]);
    const Form form = tells && piece.form != Form::slab ? Form::lobe : piece.form;
    classes[t] = static_cast<std::uint8_t>(1 + colour_of[t] + 16 * static_cast<int>(form));
  }
  return classes;
}

/// Numbers the classes from 0, the largest area first; those past the limit join the last.
void renumber(const Surface& surface, std::vector<std::uint8_t>& classes) {
  std::vector<double> areas(256);
  for (std::size_t t = 0; t < classes.size(); ++t) areas[classes[t]] += surface.areas[t];
  std::vector<bool> used(256);
  for (const std::uint8_t c : classes) used[c] = true;
  std::vector<std::uint8_t> number(256);
  std::size_t next = 0;
  for (const std::uint32_t c : by_area(areas)) {
    if (!used[c]) continue;
    number[c] = static_cast<std::uint8_t>(std::min(next, kMostParts - 1));
    ++next;
  }
  for (std::uint8_t& c : classes) c = number[c];
}

std::vector<Appearance> describe(const Surface& surface, const std::vector<std::uint8_t>& part_of,
                                 std::uint32_t primitive, bool has_colour, const Box& all) {
  const std::size_t parts = part_of.empty() ? 1 : std::ranges::max(part_of) + std::size_t{1};
  std::vector<Appearance> looks(parts);
  std::vector<Vec3d> colours(parts);
  std::vector<double> kept(parts);
  std::vector<std::vector<bool>> has_piece(parts, std::vector<bool>(surface.pieces.size()));
  for (std::size_t t = 0; t < surface.areas.size(); ++t) {
    const std::size_t part = part_of.empty() ? 0 : part_of[t];
    const Piece& piece = surface.pieces[surface.piece_of[t]];
    const double area = surface.areas[t];
    Appearance& look = looks[part];
    look.area += area;
    kept[part] += area * surface.shown_at(t).kept;
    colours[part] =
        colours[part] + Vec3d(surface.shown_at(t).colour) * (area * surface.shown_at(t).kept);
    look.piece_length += area * piece.length;
    look.centre = look.centre + piece.middle * area;
    double& form = piece.form == Form::flat   ? look.forms.flat
                   : piece.form == Form::tube ? look.forms.tube
                   : piece.form == Form::lobe ? look.forms.lobe
                                              : look.forms.slab;
    form += area;
    if (!has_piece[part][surface.piece_of[t]]) {
      has_piece[part][surface.piece_of[t]] = true;
      ++look.pieces;
    }
  }
  for (std::size_t part = 0; part < parts; ++part) {
    Appearance& look = looks[part];
    look.primitive = primitive;
    look.has_colour = has_colour && kept[part] > 0;
    if (kept[part] > 0) look.colour = Vec3f(colours[part] / kept[part]);
    if (!(look.area > 0)) continue;
    look.cut = 1 - kept[part] / look.area;
    look.centre = look.centre / look.area;
    look.piece_length /= look.area * std::max(scale_of(all), 1e-300);
    for (double* form : {&look.forms.flat, &look.forms.tube, &look.forms.lobe, &look.forms.slab}) {
      *form /= look.area;
    }
  }
  return looks;
}

}  // namespace

Appearances look_at(const TreeModel& tree, std::uint32_t primitive, const Transform& to_world,
                    const Box& all, Cutting cutting) {
  const Primitive& source = tree.primitives[primitive];
  Surface surface = survey(tree, source, to_world, all);
  const bool has_colour = SurfaceColour(tree, source, 1).is_known();
  Appearances looks;
  if (cutting == Cutting::where_it_differs) {
    looks.part_of = classes_of(surface, has_colour);
    renumber(surface, looks.part_of);
  }
  looks.parts = describe(surface, looks.part_of, primitive, has_colour, all);
  if (looks.parts.size() < 2) looks.part_of.clear();
  looks.welded = std::move(surface.welded);
  return looks;
}

}  // namespace leafhull
