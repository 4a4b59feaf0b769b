// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "leafhull/render.h"

namespace leafhull {

/// The file names of one run's pictures, by format.
struct FilePlan {
  std::vector<std::filesystem::path> png, exr;  ///< of a turntable without numbers
  std::vector<std::filesystem::path> films;
  bool film_was_asked_for = false;  ///< by name; otherwise films come along with the frames
  bool film_is_missing = false;     ///< a film would come along, but there is no ffmpeg
};

/// @throws Error usage, as check_pictures.
FilePlan plan_files(const PictureFiles& files);

/// The name of frame `number`, from 1: picture-0001.png for picture.png.
std::filesystem::path numbered(const std::filesystem::path& file, int number);

}  // namespace leafhull
