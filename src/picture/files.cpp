// SPDX-License-Identifier: Apache-2.0
#include "picture/files.h"

#include <algorithm>
#include <map>
#include <system_error>

#include "leafhull/error.h"
#include "output/destination.h"
#include "picture/film.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kDigits = 4;

void refuse_input(const fs::path& file, const fs::path& destination, const fs::path& input) {
  std::error_code unreadable;
  if (destination != fs::weakly_canonical(input, unreadable)) return;
  throw Error(ErrorCode::usage, "the output " + file.string() + " is the input itself",
              "Name another file.");
}

[[noreturn]] void refuse_extension(const fs::path& file) {
  const std::string extension = file.extension().string();
  throw Error(ErrorCode::usage,
              extension.empty() ? "the output " + file.string() + " has no extension"
                                : "unknown extension " + extension + " of " + file.string(),
              "Use .png or .exr, or for a turntable .mp4 or .webp.");
}

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
      refuse_extension(file);
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
  std::map<fs::path, fs::path> name_of_destination;
  const auto check = [&](const fs::path& file) {
    const fs::path destination = resolve_destination(file);
    refuse_input(file, destination, input);
    const auto [first, is_new] = name_of_destination.emplace(destination, file);
    if (is_new) return;
    throw Error(
        ErrorCode::usage,
        "the outputs " + first->second.string() + " and " + file.string() + " are the same file",
        "Name each output differently.");
  };
  for (const auto* pictures : {&plan.png, &plan.exr}) {
    for (const fs::path& file : *pictures) {
      if (files.frames == 0) check(file);
      for (int frame = 1; frame <= files.frames; ++frame) check(numbered(file, frame));
    }
  }
  for (const fs::path& film : plan.films) check(film);
  return plan;
}

}  // namespace leafhull
