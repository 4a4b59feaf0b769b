// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "leafhull/scene.h"

namespace leafhull {

/// Collects a scene, and what is wrong with it.
class SceneBuilder {
 public:
  explicit SceneBuilder(const std::filesystem::path& file) { scene_.path = file; }

  /// Adds a tree of the model that `model` numbers; skips and counts it where its map is not finite
  /// or flattens it. `place` says where it is in the file. Both are called only where needed.
  /// @throws Error input: more trees than an int counts.
  template <class Model, class Place>
  void add(PlacedTree tree, const Model& model, const Place& place) {
    if (!can_stand(tree)) {
      if (scene_.skipped++ == 0) first_skipped_ = place();
      return;
    }
    tree.model = model();
    check_count();
    scene_.trees.push_back(tree);
  }

  /// Gives the model a name that no other has, made from `name`. @returns its number.
  std::uint32_t add_model(SceneModel model, const std::string& name);

  /// Adds a warning, after the file's name.
  void warn(const std::string& what);

  /// @throws Error input: no tree is left.
  Scene finish();

  Scene& scene() { return scene_; }

 private:
  static bool can_stand(const PlacedTree& tree);
  void check_count() const;

  Scene scene_;
  std::string first_skipped_;
  std::set<std::string> names_;
};

}  // namespace leafhull
