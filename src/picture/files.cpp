// SPDX-License-Identifier: Apache-2.0
#include "picture/files.h"

#include <algorithm>

#include "leafhull/error.h"
#include "output/destination.h"
#include "picture/film.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigits = 4;

void add_film(const PictureFiles& files, FilePlan& plan) {
  plan.film_was_asked_for = !plan.films.empty();
  if (files.frames == 0 || plan.png.empty() || plan.film_was_asked_for) return;
  plan.film_is_missing = !can_make_films();
  if (plan.film_is_missing) return;
  plan.films.push_back(plan.png.front());
  plan.films.back().replace_extension(".mp4");
}

}  // namespace

void refuse_buffers(const fs::path& file) {
  throw Error(ErrorCode::usage,
              file.string() + " holds the buffers of one picture, but there are two",
              "Name a .png file, or leave --beside out.");
}

fs::path numbered(const fs::path& file, int number) {
  std::string digits = std::to_string(number);
  digits.insert(0, kDigits - std::min(kDigits, digits.size()), '0');
  fs::path name = file;
  name.replace_filename(file.stem().string() + "-" + digits + file.extension().string());
  return name;
}

FilePlan plan_files(const PictureFiles& files) {
  FilePlan plan;
  plan.frames = files.frames;
  for (const fs::path& file : files.files) {
    const std::string extension = lower_extension(file);
    if (extension == ".png") {
      plan.png.push_back(file);
    } else if (extension == ".exr") {
      plan.exr.push_back(file);
    } else if (extension != ".mp4" && extension != ".webp") {
      refuse_extension(file, file.extension().string(),
                       "Use .png or .exr, or for a turntable .mp4 or .webp.");
    } else if (files.frames == 0) {
      throw Error(ErrorCode::usage, file.string() + " is a film, but there is only one picture",
                  "Give --turntable N, or name a .png file.");
    } else {
      plan.films.push_back(file);
    }
  }
  add_film(files, plan);
  return plan;
}

FilePlan checked_files(const PictureFiles& files, const fs::path& input, std::size_t subjects) {
  if (files.files.empty()) {
    throw Error(ErrorCode::usage, "no output is named", "Name one, such as -o picture.png.");
  }
  FilePlan plan = plan_files(files);
  if (subjects > 1 && !plan.exr.empty()) refuse_buffers(plan.exr.front());
  if (plan.film_was_asked_for && !can_make_films()) {
    throw Error(ErrorCode::output,
                "cannot write " + plan.films.front().string() + ": ffmpeg is missing",
                "Install ffmpeg on the PATH, or name a .png file for the frames.");
  }
  Destinations destinations(input);
  for (const auto* pictures : {&plan.png, &plan.exr}) {
    for (const fs::path& file : *pictures) {
      if (files.frames == 0) destinations.add(file);
      for (int frame = 1; frame <= files.frames; ++frame) {
        destinations.add(numbered(file, frame));
      }
    }
  }
  for (const fs::path& film : plan.films) destinations.add(film);
  return plan;
}

}  // namespace leafhull
