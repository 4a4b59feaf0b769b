// SPDX-License-Identifier: Apache-2.0
#include "leaves/alpha_mask.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <span>

#include "leaves/convex_polygon.h"
#include "leaves/texels.h"

namespace leafhull {
namespace {

constexpr double kBlendCutoff = 0.5;
// A box that repeats the image over more texels than this is no picture of one leaf.
constexpr double kMostTexels = 1 << 26;

/// The range of x in which a polygon, clipped to a row of texels, spans the row from top to bottom:
/// texels in that range lie wholly inside it.
std::pair<double, double> across(const ConvexPolygon& row, double top) {
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (std::size_t i = 0; i < row.size(); ++i) {
    for (int side = 0; side < 2; ++side) {
      if (row[i].y != top + side) continue;
      low[side] = std::min(low[side], row[i].x);
      high[side] = std::max(high[side], row[i].x);
    }
  }
  return {std::max(low[0], low[1]), std::min(high[0], high[1])};
}

/// The moments of the kept texels in a row of whole texels, which starts at (left, top); `turn` is
/// their sign.
PolygonMoments whole_texels(std::span<const std::uint8_t> texels, double left, double top,
                            double turn) {
  std::uint64_t count = 0, places = 0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    count += texels[i];
    places += texels[i] * i;
  }
  const double n = turn * static_cast<double>(count);
  return {n, {turn * static_cast<double>(places) + n * (left + 0.5), n * (top + 0.5)}};
}

/// First and last texel whose centre lies between two texture coordinates.
std::pair<double, double> texel_range(double low, double high, int size) {
  return {std::ceil(low * size - 0.5), std::floor(high * size - 0.5)};
}

}  // namespace

AlphaMask::AlphaMask(const Material& material, const Image& image)
    : width_(image.width),
      height_(image.height),
      wrap_u_(material.wrap_u),
      wrap_v_(material.wrap_v),
      kept_(image.rgba.size() / 4) {
  const double cutoff =
      material.alpha_mode == AlphaMode::blend ? kBlendCutoff : material.alpha_cutoff;
  std::array<bool, 256> keeps{};  // by alpha
  for (std::size_t alpha = 0; alpha < keeps.size(); ++alpha) {
    keeps[alpha] = static_cast<double>(alpha) / 255.0 * material.base_color[3] >= cutoff;
  }
  for (std::size_t texel = 0; texel < kept_.size(); ++texel) {
    kept_[texel] = keeps[image.rgba[4 * texel + 3]];
    kept_count_ += kept_[texel];
  }
}

std::optional<AlphaMask> AlphaMask::of(const Material& material, const std::vector<Image>& images,
                                       bool cut_out) {
  const bool is_opaque = material.alpha_mode == AlphaMode::opaque && !cut_out;
  if (is_opaque || material.base_color_image < 0) return {};
  const Image& image = images[material.base_color_image];
  if (image.empty()) return {};
  AlphaMask mask(material, image);
  if (mask.kept_count_ == mask.kept_.size()) return {};
  return mask;
}

bool AlphaMask::keeps(Vec2d uv) const {
  const auto texel = [](double v) { return static_cast<std::int64_t>(std::floor(v)); };
  const std::int64_t row = wrapped(texel(uv.y * height_), height_, wrap_v_) * width_;
  const std::int64_t column = wrapped(texel(uv.x * width_), width_, wrap_u_);
  return kept_[static_cast<std::size_t>(row + column)] != 0;
}

KeptPart AlphaMask::kept_part(const std::array<Vec2d, 3>& triangle) const {
  ConvexPolygon all;
  Vec2d middle;
  for (const Vec2d uv : triangle) {
    all.push_back({uv.x * width_, uv.y * height_});
    middle = {middle.x + uv.x / 3, middle.y + uv.y / 3};
  }
  const PolygonMoments whole = moments_of(all);
  const double texels = std::abs(whole.area);
  if (texels == 0) return {keeps(middle) ? 1.0 : 0.0, middle};
  const auto [low, high] = extent(all);
  if (!((high.x - low.x) * (high.y - low.y) <= kMostTexels)) {
    return {static_cast<double>(kept_count_) / static_cast<double>(kept_.size()), middle};
  }
  const double turn = whole.area > 0 ? 1 : -1;
  PolygonMoments kept;
  const auto first = [](double v) { return static_cast<std::int64_t>(std::floor(v)); };
  for (std::int64_t y = first(low.y); static_cast<double>(y) < high.y; ++y) {
    const auto top = static_cast<double>(y);
    const ConvexPolygon row = clip(all, &Vec2d::y, top, top + 1);
    if (row.empty()) continue;
    const auto [row_low, row_high] = extent(row);
    const auto [whole_low, whole_high] = across(row, top);
    const std::int64_t begin = wrapped(y, height_, wrap_v_) * width_;
    for (std::int64_t x = first(row_low.x); static_cast<double>(x) < row_high.x; ++x) {
      const auto left = static_cast<double>(x);
      if (x >= 0 && left >= whole_low && left + 1 <= whole_high) {
        const auto end = std::min<std::int64_t>(width_, first(whole_high));
        if (x < end) {
          kept += whole_texels(std::span(kept_).subspan(static_cast<std::size_t>(begin + x),
                                                        static_cast<std::size_t>(end - x)),
                               left, top, turn);
          x = end - 1;
          continue;
        }
      }
      const std::int64_t column = wrapped(x, width_, wrap_u_);
      if (kept_[static_cast<std::size_t>(begin + column)] == 0) continue;
      kept += moments_of(clip(row, &Vec2d::x, left, left + 1));
    }
  }
  if (kept.area == 0) return {0, middle};
  return {std::min(1.0, std::abs(kept.area) / texels),
          {kept.first.x / kept.area / width_, kept.first.y / kept.area / height_}};
}

std::optional<TextureEllipse> AlphaMask::ellipse(const UvBox& box) {
  const auto [left, right] = texel_range(box.low.x, box.high.x, width_);
  const auto [top, bottom] = texel_range(box.low.y, box.high.y, height_);
  const double width = right - left + 1;
  const double height = bottom - top + 1;
  constexpr double kFarthest = 1e15;
  const bool fits = width >= 1 && height >= 1 && width * height <= kMostTexels &&
                    std::abs(left) < kFarthest && std::abs(top) < kFarthest;
  if (!fits) return {};

  const auto texel = [](double index) { return static_cast<std::int64_t>(index); };
  const Texels texels{texel(left), texel(right), texel(top), texel(bottom)};
  const auto known = ellipses_.find(texels);
  return known != ellipses_.end() ? known->second
                                  : ellipses_.emplace(texels, moments(texels)).first->second;
}

std::optional<TextureEllipse> AlphaMask::moments(const Texels& texels) const {
  const Eigen::Array2d size(width_, height_);
  const Eigen::Array2d middle(0.5 * static_cast<double>(texels.left + texels.right),
                              0.5 * static_cast<double>(texels.top + texels.bottom));
  const bool wraps = texels.left < 0 || texels.right >= width_;
  // Relative to the middle all coordinates are multiples of a half, so the sums are exact.
  double count = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (std::int64_t y = texels.top; y <= texels.bottom; ++y) {
    const std::int64_t row = wrapped(y, height_, wrap_v_) * width_;
    double in_row = 0, sum_x = 0, sum_xx = 0;
    for (std::int64_t x = texels.left; x <= texels.right; ++x) {
      const std::int64_t column = wraps ? wrapped(x, width_, wrap_u_) : x;
      if (!kept_[static_cast<std::size_t>(row + column)]) continue;
      const double px = static_cast<double>(x) - middle[0];
      ++in_row;
      sum_x += px;
      sum_xx += px * px;
    }
    const double py = static_cast<double>(y) - middle[1];
    count += in_row;
    sum += Eigen::Vector2d(sum_x, in_row * py);
    squares(0, 0) += sum_xx;
    squares(0, 1) += sum_x * py;
    squares(1, 1) += in_row * py * py;
  }
  squares(1, 0) = squares(0, 1);
  if (count == 0) return {};

  const Eigen::Vector2d mean = sum / count;
  // A texel is not a point but a unit square, with a variance of 1/12.
  const Eigen::Matrix2d in_texels =
      squares / count - mean * mean.transpose() + Eigen::Matrix2d::Identity() / 12;
  const Eigen::Matrix2d to_uv = size.inverse().matrix().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(to_uv * in_texels * to_uv);
  const Eigen::Vector2d centre = to_uv * (mean + middle.matrix() + Eigen::Vector2d(0.5, 0.5));
  const auto half_axis = [&](int i) {
    const Eigen::Vector2d axis =
        2 * std::sqrt(principal.eigenvalues()[i]) * principal.eigenvectors().col(i);
    return Vec2d{axis.x(), axis.y()};
  };
  return TextureEllipse{{centre.x(), centre.y()}, half_axis(1), half_axis(0)};
}

}  // namespace leafhull
