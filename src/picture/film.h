// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "leafhull/picture.h"
#include "output/temporary_file.h"
#include "process/memory_file.h"
#include "process/process.h"

namespace leafhull {

/// Whether ffmpeg, which makes films, is installed.
bool can_make_films();

/// An .mp4 (H.264) or .webp that ffmpeg makes from frames as they are drawn. It has a temporary
/// name until finish(); without finish() nothing remains.
class Film {
 public:
  /// @throws Error output: ffmpeg does not start, or the file cannot be made.
  Film(std::filesystem::path file, int width, int height, double frames_per_second);
  ~Film();

  /// Adds the next frame, which has the film's size.
  /// @throws Error output: ffmpeg has stopped, and what it says.
  void add(const Picture& frame);

  /// @throws Error output.
  void finish();

 private:
  [[noreturn]] void fail();

  std::filesystem::path name_;
  TemporaryFile file_;
  MemoryFile messages_;
  int frames_ = -1;  ///< descriptor of ffmpeg's standard input
  std::optional<Process> ffmpeg_;
};

}  // namespace leafhull
