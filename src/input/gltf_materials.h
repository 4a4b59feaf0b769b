// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "input/gltf_file.h"
#include "input/image_table.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Maps a material's texture coordinates to those of its image, as KHR_texture_transform says.
struct TextureMapping {
  int set = 0;  ///< n of TEXCOORD_n
  Vec2d offset{}, scale{1, 1};
  double rotation = 0;  ///< radians, counter-clockwise as seen

  bool is_identity() const { return offset == Vec2d{} && scale == Vec2d{1, 1} && rotation == 0; }
  void apply(std::vector<Vec2f>& uvs) const;
};

/// Turns the materials of a file into a tree's, including the images of base colours.
class MaterialReader {
 public:
  MaterialReader(GltfFile& file, TreeModel& tree) : file_(file), tree_(tree) {}

  /// Reads every material into the tree, without its image.
  void read_all();

  /// Returns a material's mapping. The first call for a material also searches for its image.
  /// @throws Error input at `user`: no such material.
  TextureMapping use(int material, const std::string& user);

  /// Decodes the images of the materials that are used.
  void decode_images() { images_.decode(tree_); }

 private:
  struct BaseColor {
    int texture = -1;
    TextureMapping mapping;
  };

  BaseColor read_base_color(const tinygltf::Material& from, Material& to) const;
  int image_of(int texture, Material& material, const std::string& place);
  int image_number(int image, const std::string& texture);
  ImageSource load_image(int image, const std::string& place);

  GltfFile& file_;
  TreeModel& tree_;
  std::vector<BaseColor> base_colors_;
  ImageTable images_;
};

}  // namespace leafhull
