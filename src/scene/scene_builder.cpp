// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "leafhull/error.h"
#include "text/text.h"

namespace leafhull {
namespace {

/// The ratio of a volume to the product of the edges that span it, below which they lie in one
/// plane, as far as floats can tell.
constexpr double kFlat = 1e-6;

constexpr const char* kWhySkipped = "scale is zero or a value is not finite";

std::string printable_path(const std::filesystem::path& path) {
  return printable(path.string(), 1000);
}

}  // namespace

std::uint32_t SceneBuilder::add_model(SceneModel model, const std::string& name) {
  model.name = name;
  for (int copy = 2; !names_.insert(model.name).second; ++copy) {
    model.name = name + '-' + std::to_string(copy);
  }
  scene_.models.push_back(std::move(model));
  return static_cast<std::uint32_t>(scene_.models.size() - 1);
}

void SceneBuilder::warn(const std::string& what) {
  scene_.warnings.push_back(printable_path(scene_.path) + ": " + what);
}

Scene SceneBuilder::finish() {
  if (scene_.trees.empty()) {
    const std::string& file = printable_path(scene_.path);
    if (scene_.skipped == 0) {
      throw Error(ErrorCode::input, file + " holds no trees",
                  "Give a scene with one tree or more.");
    }
    throw Error(ErrorCode::input,
                file + " holds no tree that can be placed: of all " +
                    std::to_string(scene_.skipped) + " the " + kWhySkipped + ", the first at " +
                    first_skipped_,
                "Check its scales and rotations.");
  }
  if (scene_.skipped == 1) {
    warn("1 tree was skipped, at " + first_skipped_ + ": its " + kWhySkipped);
  } else if (scene_.skipped > 1) {
    warn(std::to_string(scene_.skipped) + " trees were skipped, the first at " + first_skipped_ +
         ": their " + kWhySkipped);
  }
  return std::move(scene_);
}

bool SceneBuilder::can_stand(const PlacedTree& tree) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  const Vec3d p = tree.position;
  if (!is_finite(p.x) || !is_finite(p.y) || !is_finite(p.z)) return false;
  if (!std::ranges::all_of(tree.linear, is_finite)) return false;
  const auto column = [&](int i) {
    return Vec3d(tree.linear[i], tree.linear[i + 3], tree.linear[i + 6]);
  };
  const Vec3d a = column(0), b = column(1), c = column(2);
  return std::abs(dot(a, cross(b, c))) > kFlat * length(a) * length(b) * length(c);
}

void SceneBuilder::check_count() const {
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (scene_.trees.size() < kMost) return;
  throw Error(ErrorCode::input,
              printable_path(scene_.path) + " holds more than " + std::to_string(kMost) + " trees",
              "Divide the scene.");
}

}  // namespace leafhull
