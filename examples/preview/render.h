// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "camera.h"
#include "scene.h"

namespace leafhull::preview {

/// Pixels of 8-bit sRGB, rows from the top.
struct Picture {
  Picture(int width, int height)
      : width(width), height(height), rgb(3 * static_cast<std::size_t>(width) * height) {}
  int width, height;
  std::vector<std::uint8_t> rgb;
};

/// Draws `scene` on white paper into the columns [left, left + width) of `picture`, its rows in
/// parallel. The ground is y = 0 and the scene stands around the origin.
/// @param samples rays per pixel, each followed by rays to the sun and to the sky
void draw(const Scene& scene, const Camera& camera, int samples, int left, int width,
          Picture& picture);

/// Writes a PNG under a temporary name, then renames it.
/// @throws Error output: the file and why.
void write_png(const Picture& picture, const std::filesystem::path& path);

}  // namespace leafhull::preview
