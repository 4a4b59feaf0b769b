// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "leafhull/render.h"

namespace leafhull {

/// Where the pictures of one run go.
struct PictureFiles {
  std::vector<std::filesystem::path> files;  ///< .png and .exr; of a turntable .mp4 and .webp too
  int frames = 0;                            ///< of a turntable; 0: one picture
};

/// Sorts the names.
/// @throws Error usage: an extension that is unknown, or a film of one picture.
FilePlan plan_files(const PictureFiles& files);

/// The same, and looks where the files would go.
/// @param subjects how many stand in a picture.
/// @throws Error as plan_pictures.
FilePlan checked_files(const PictureFiles& files, const std::filesystem::path& input,
                       std::size_t subjects = 1);

/// @throws Error usage: the buffers of several subjects have no file.
[[noreturn]] void refuse_buffers(const std::filesystem::path& file);

/// The name of frame `number`, from 1: picture-0001.png for picture.png.
std::filesystem::path numbered(const std::filesystem::path& file, int number);

}  // namespace leafhull
