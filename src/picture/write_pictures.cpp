// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "leafhull/error.h"
#include "leafhull/output.h"
#include "leafhull/render.h"
#include "picture/artist.h"
#include "picture/check_picture.h"
#include "picture/files.h"
#include "picture/film.h"
#include "picture/side_by_side.h"
#include "pipeline/stopwatch.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

/// A turn takes six seconds if it has enough frames.
double frames_per_second(int frames) { return std::clamp(frames / 6.0, 12.0, 30.0); }

void write_bytes(const fs::path& file, const std::vector<std::uint8_t>& bytes) {
  write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// The films of a turntable. If a film was not asked for by name, its failure is only a warning.
class Films {
 public:
  Films(const FilePlan& plan, int width, int height, int frames, std::vector<std::string>& warnings)
      : asked_for_(plan.film_was_asked_for), warnings_(warnings) {
    for (const fs::path& file : plan.films) {
      attempt([&] {
        films_.push_back(std::make_unique<Film>(file, width, height, frames_per_second(frames)));
      });
    }
    if (plan.film_is_missing) {
      warnings_.emplace_back("frames are written, but no film: ffmpeg is not on the PATH");
    }
  }

  void add(const Picture& frame) {
    attempt([&] {
      for (const auto& film : films_) film->add(frame);
    });
  }

  /// Finishes the films. Returns whether there are any.
  bool finish() {
    attempt([&] {
      for (const auto& film : films_) film->finish();
    });
    return !films_.empty();
  }

 private:
  template <class Work>
  void attempt(Work&& work) {
    try {
      work();
    } catch (const Error& error) {
      if (asked_for_) throw;
      warnings_.emplace_back(std::string("frames are written, but no film: ") + error.what());
      films_.clear();
    }
  }

  bool asked_for_;
  std::vector<std::string>& warnings_;
  std::vector<std::unique_ptr<Film>> films_;
};

/// Warns of frames from an earlier, longer turntable: they look like this one's.
void warn_of_older_frames(const FilePlan& plan, int frames, std::vector<std::string>& warnings) {
  for (const auto* pictures : {&plan.png, &plan.exr}) {
    for (const fs::path& file : *pictures) {
      const fs::path next = numbered(file, frames + 1);
      std::error_code unreadable;
      if (!fs::exists(next, unreadable)) continue;
      warnings.push_back(next.string() +
                         " is from an earlier run and does not belong to this turntable");
    }
  }
}

std::vector<fs::path> first_files(const FilePlan& plan, int frames, bool with_films) {
  std::vector<fs::path> files;
  for (const auto* pictures : {&plan.png, &plan.exr}) {
    for (const fs::path& file : *pictures) {
      files.push_back(frames > 0 ? numbered(file, 1) : file);
    }
  }
  if (with_films) files.insert(files.end(), plan.films.begin(), plan.films.end());
  return files;
}

void add_times(std::vector<StageTime>& sums, const std::vector<StageTime>& times) {
  for (const auto& [stage, seconds] : times) {
    const auto sum =
        std::ranges::find_if(sums, [&](const StageTime& other) { return other.stage == stage; });
    if (sum == sums.end()) {
      sums.push_back({stage, seconds});
    } else {
      sum->seconds += seconds;
    }
  }
}

/// Draws one subject, or several in one picture, which then has no buffers.
Rendering draw_row(Artist& artist, std::span<const Subject> subjects, const PictureOptions& options,
                   const Progress& progress) {
  if (subjects.size() == 1) return artist.draw(subjects.front(), options, progress);
  Rendering row;
  row.blank = true;
  std::vector<Picture> pictures;
  for (const Subject& subject : subjects) {
    const auto before = static_cast<double>(pictures.size());
    Rendering one = artist.draw(subject, options, [&](std::string_view stage, double share) {
      progress(stage, (before + share) / static_cast<double>(subjects.size()));
    });
    pictures.push_back(std::move(one.picture));
    row.blank = row.blank && one.blank;
    add_times(row.seconds, one.seconds);
  }
  row.picture = side_by_side(pictures);
  return row;
}

}  // namespace

PictureSummary write_pictures(std::span<const Subject> subjects, const PicturePlan& plan,
                              Device& device, const Progress& progress) {
  const FilePlan& files = plan.files;
  if (subjects.empty()) throw Error(ErrorCode::usage, "there is no subject to draw");
  if (subjects.size() > 1 && !files.exr.empty()) refuse_buffers(files.exr.front());
  PictureOptions options = plan.picture;
  check_picture(options, &device.info());
  PictureSummary summary;
  Films films(files, row_width(options.width, subjects.size()), options.height, files.frames,
              summary.warnings);
  Artist artist(device);
  const int pictures = std::max(files.frames, 1);
  options.turntable = files.frames > 0;
  const Progress untold;
  for (int i = 0; i < pictures; ++i) {
    const auto tell = [&](std::string_view stage, double share) {
      if (progress) progress(stage, (i + share) / pictures);
    };
    options.turn = static_cast<double>(i) / pictures;
    const Rendering rendering = draw_row(artist, subjects, options, tell);
    summary.blank += rendering.blank;
    add_times(summary.seconds, rendering.seconds);

    tell("write", 1);
    Stopwatch watch(untold);
    watch.start("write");
    const auto name = [&](const fs::path& file) {
      return files.frames > 0 ? numbered(file, i + 1) : file;
    };
    if (!files.png.empty()) {
      const std::vector<std::uint8_t> png = encode_png(rendering.picture);
      for (const fs::path& file : files.png) write_bytes(name(file), png);
    }
    if (!files.exr.empty()) {
      const std::vector<std::uint8_t> exr = encode_exr(rendering);
      for (const fs::path& file : files.exr) write_bytes(name(file), exr);
    }
    films.add(rendering.picture);
    add_times(summary.seconds, watch.finish());
  }
  const bool with_films = films.finish();
  if (progress) progress("write", 1);
  if (files.frames > 0) warn_of_older_frames(files, files.frames, summary.warnings);
  if (summary.blank > 0) {
    summary.warnings.push_back(pictures == 1
                                   ? "nothing is in view: the picture is white paper"
                                   : "nothing is in view in " + std::to_string(summary.blank) +
                                         " of " + std::to_string(pictures) + " frames");
  }
  summary.files = first_files(files, files.frames, with_films);
  return summary;
}

}  // namespace leafhull
