// SPDX-License-Identifier: Apache-2.0
#include <stb/stb_image.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "input/file_bytes.h"
#include "leafhull/error.h"
#include "leafhull/output.h"
#include "leafhull/scene.h"
#include "scene/csv.h"
#include "scene/poisson_disk.h"
#include "text/numbers.h"
#include "text/text.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr double kMostTrees = 1e6, kMostSeed = 2'147'483'647, kWidest = 1e9;
constexpr double kMostAspect = 1e6;

void require(bool holds, const std::string& what, const char* remedy) {
  if (!holds) throw Error(ErrorCode::usage, what, remedy);
}

bool is_positive(double value) { return value > 0 && std::isfinite(value); }

void check(const ScatterOptions& options) {
  require(!options.trees.empty(), "no tree is given", "Name one tree file or more.");
  if (options.area) {
    const auto [x, y] = *options.area;
    require(is_positive(x) && is_positive(y), "--area has a side that is not a positive number",
            "Give its sides along x and z, such as 200x100.");
    require(std::max(x, y) / std::min(x, y) <= kMostAspect, "--area is a line",
            "Give sides that are less than a million times as long as each other.");
  }
  require(is_positive(options.spacing), "--spacing is not a positive number",
          "Give the distance between neighbours in widths of a crown, such as 0.8.");
  require(is_positive(options.scale_low) && options.scale_low <= options.scale_high &&
              std::isfinite(options.scale_high),
          "--scale is not a range of positive numbers", "Give LOW:HIGH, such as 0.8:1.2.");
  if (options.ground) {
    require(!options.ground->picture.empty(), "--height is given without a height map",
            "Name one with --height-map.");
    require(std::isfinite(options.ground->height), "--height is not a number",
            "Give the height of white above black.");
  }
  check_rows(scatter_table(), options);
}

constexpr std::int64_t kMostPixels = 16384 * 16384;  // 512 MiB

[[noreturn]] void fail_at(const fs::path& picture, const std::string& what) {
  throw Error(ErrorCode::input, "the height map " + printable(picture.string(), 1000) + ' ' + what,
              "Give a grey PNG of 8 or 16 bits, of up to 16384 x 16384 pixels.");
}

Bytes read_picture(const fs::path& picture) try {
  return read_file(picture, Pipes::read);
} catch (const FileError& error) {
  fail_at(picture, std::string("cannot be read: ") + error.what());
}

/// Heights, interpolated between the pixels of a picture that covers the area.
class HeightField {
 public:
  /// @throws Error input: the picture cannot be read.
  explicit HeightField(const HeightMap& map);

  /// @param u, v from 0 to 1, to the right and down the picture.
  double at(double u, double v) const;

 private:
  double height_;
  int width_ = 0, rows_ = 0;
  std::vector<std::uint16_t> grey_;
};

HeightField::HeightField(const HeightMap& map) : height_(map.height) {
  const Bytes bytes = read_picture(map.picture);
  if (!text_of(bytes).starts_with("\x89PNG")) fail_at(map.picture, "is not a PNG picture");
  const int size = bytes.size() > INT_MAX ? 0 : static_cast<int>(bytes.size());
  if (stbi_info_from_memory(bytes.data(), size, &width_, &rows_, nullptr) == 0 ||
      std::int64_t{width_} * rows_ > kMostPixels) {
    fail_at(map.picture, "is damaged or too large");
  }
  const std::unique_ptr<stbi_us, void (*)(void*)> pixels(
      stbi_load_16_from_memory(bytes.data(), size, &width_, &rows_, nullptr, 1), &stbi_image_free);
  if (!pixels) fail_at(map.picture, "is damaged: " + printable(stbi_failure_reason()));
  grey_.assign(pixels.get(), pixels.get() + static_cast<std::size_t>(width_) * rows_);
}

double HeightField::at(double u, double v) const {
  const double x = u * (width_ - 1), y = v * (rows_ - 1);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, width_ - 1), bottom = std::min(top + 1, rows_ - 1);
  const auto grey = [&](int column, int row) {
    return static_cast<double>(grey_[static_cast<std::size_t>(row) * width_ + column]);
  };
  const double upper = std::lerp(grey(left, top), grey(right, top), x - left);
  const double lower = std::lerp(grey(left, bottom), grey(right, bottom), x - left);
  return height_ * std::lerp(upper, lower, y - top) / 65535;
}

/// The mean width of the leaves along x and z, over all trees.
double mean_crown_width(const ScatterOptions& options) {
  double sum = 0;
  for (const fs::path& tree : options.trees) {
    const Vec3d size = find_leaves(read_tree(tree, options.reading), options.leaves).crown.size();
    sum += (size.x + size.z) / 2;
  }
  return sum / static_cast<double>(options.trees.size());
}

Vec2d area_of(const ScatterOptions& options) {
  const double width = mean_crown_width(options);
  if (options.area) return *options.area;
  const double scale = (options.scale_low + options.scale_high) / 2;
  const double side =
      options.spacing * width * scale * std::sqrt(static_cast<double>(options.count));
  if (!is_positive(side)) {
    throw Error(ErrorCode::input, "the leaves of the trees have no width",
                "Give the sides of the rectangle with --area.");
  }
  return {side, side};
}

/// A model's name in the scatter file: its path relative to that file.
std::string model_name(const fs::path& tree, const fs::path& scatter_file) {
  // Links on the way are followed, so that .. leads back; the tree keeps its name.
  const auto real_folder = [](const fs::path& file) {
    std::error_code error;
    const fs::path folder = file.parent_path();
    return fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
  };
  const std::string name =
      (real_folder(tree) / tree.filename()).lexically_proximate(real_folder(scatter_file)).string();
  require(name.find_first_of("\r\n") == std::string::npos,
          "the name of " + printable(tree.string(), 1000) + " has a line break",
          "Give the file another name.");
  return csv_field(name);
}

/// The number of decimals that resolve a ten-thousandth of `size`.
int decimals_for(double size) {
  return std::clamp(4 - static_cast<int>(std::floor(std::log10(size))), 0, 15);
}

double rounded(double value, int decimals) {
  const double power = std::pow(10.0, decimals);
  const double scaled = std::round(value * power);
  return std::abs(scaled) < 0x1p53 ? scaled / power + 0.0 : value;  // + 0.0: no -0
}

}  // namespace

std::span<const ScatterOptionRow> scatter_table() {
  using Row = ScatterOptionRow;
  constexpr auto kGround = &ScatterOptions::ground;
  static const Row rows[] = {
      Row("Trees", "count", &ScatterOptions::count, {1, kMostTrees}, "number of trees",
          {.default_value = "none"}),
      Row("Trees", "seed", &ScatterOptions::seed, {0, kMostSeed}, "random seed"),
      Row("Trees", "scale", std::pair(&ScatterOptions::scale_low, &ScatterOptions::scale_high),
          {0, kWidest}, "range of sizes, drawn evenly",
          {.range = "> 0", .default_value = "0.8:1.2", .value = "LOW:HIGH"}),
      Row("Ground", "spacing", &ScatterOptions::spacing, {.high = kWidest, .low_open = true},
          "least distance between trees", {.unit = "crown widths", .range = "> 0"}),
      Row("Ground", "area", &ScatterOptions::area, {0, kWidest},
          "sides of the rectangle along x and z, about the origin",
          {.unit = "model units", .range = "> 0 each", .default_value = "as --spacing asks"}),
      Row("Ground", "height-map", std::pair(kGround, &HeightMap::picture),
          "the ground from above, white the highest; +x is right, +z is down",
          {.range = ".png, grey, 8 or 16 bits", .default_value = "flat", .value = "FILE"}),
      Row("Ground", "height", std::pair(kGround, &HeightMap::height), {-kWidest, kWidest},
          "height of white above black in the height map",
          {.unit = "model units", .default_value = "10", .value = "X"}),
  };
  return rows;
}

void write_scatter(const ScatterOptions& options, const fs::path& file) {
  check(options);
  const OutputFile scatter(file, ".csv", options.trees);
  std::vector<std::string> names;
  for (const fs::path& tree : options.trees) names.push_back(model_name(tree, file));
  const std::optional<HeightField> ground =
      options.ground ? std::optional<HeightField>(*options.ground) : std::nullopt;
  const Vec2d area = area_of(options);

  Random random(options.seed);
  const Disks disks = poisson_disks(area, options.count, random);
  const int decimals = decimals_for(disks.distance);
  const int scale_decimals = decimals_for(options.scale_low);
  std::string text = "model,x,y,z,yaw,scale\n";
  for (const Vec2d& centre : disks.centres) {
    const double u = centre.x / area.x, v = centre.y / area.y;
    const double height = ground ? ground->at(u, v) : 0;
    text += names[random.index(names.size())];
    for (const double coordinate : {centre.x - area.x / 2, height, centre.y - area.y / 2}) {
      text += ',' + shortest(rounded(coordinate, decimals));
    }
    text += ',' + shortest(rounded(random.number(0, 360), 2));
    const double scale = random.number(options.scale_low, options.scale_high);
    text += ',' +
            shortest(
                std::clamp(rounded(scale, scale_decimals), options.scale_low, options.scale_high)) +
            '\n';
  }
  scatter.write(text);
}

}  // namespace leafhull
