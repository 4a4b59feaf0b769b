// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ufbx.h>

#include <map>

#include "input/companions.h"
#include "input/image_table.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Turns the materials of an FBX file into a tree's when they are first used.
class FbxMaterials {
 public:
  FbxMaterials(const Companions& companions, TreeModel& tree)
      : companions_(companions), tree_(tree) {}

  /// The index of a material in the tree; -1 for none.
  int use(const ufbx_material* material);

  /// Decodes the images of the materials that are used.
  void decode_images();

  /// The texture that colours a material, or null.
  static const ufbx_texture* colour_texture(const ufbx_material* material);

 private:
  Material read(const ufbx_material& material);
  ImageSource load(const ufbx_texture& texture);

  const Companions& companions_;
  TreeModel& tree_;
  std::map<const ufbx_material*, int> numbers_;
  ImageTable images_;
};

}  // namespace leafhull
