// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <system_error>

#include "forest/forest_folder.h"
#include "forest/store.h"
#include "leafhull/error.h"
#include "output/line_file.h"
#include "output/write_error.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNameAnother = "Name another folder, or move it away.";

bool is_temporary(const std::string& name) {
  return name.starts_with(".") && name.ends_with(".tmp");
}

bool is_journal(const std::string& name) {
  return name.starts_with("journal-") && name.ends_with(".jsonl");
}

/// X_Y_Z.
bool is_tile(const std::string& stem) {
  const char* at = stem.data();
  const char* const end = at + stem.size();
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0 && (at == end || *at++ != '_')) return false;
    std::int32_t number = 0;
    const auto [behind, fault] = std::from_chars(at, end, number);
    if (fault != std::errc()) return false;
    at = behind;
  }
  return at == end;
}

bool is_tile_file(const fs::path& file) {
  const std::string extension = file.extension().string();
  return is_tile(file.stem().string()) &&
         (extension == ".glb" || extension == ".seam" || extension == ".kept");
}

bool is_level(const std::string& name) {
  return !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code missing;
  for (fs::directory_iterator at(folder, missing), end; !missing && at != end;
       at.increment(missing)) {
    entries.push_back(at->path());
  }
  return entries;
}

/// LEVEL/X_Y_Z.* and the folders that are then empty.
void remove_tiles(const fs::path& folder) {
  for (const fs::path& level : entries_of(folder)) {
    if (!is_level(level.filename().string())) continue;
    for (const fs::path& file : entries_of(level)) {
      if (is_tile_file(file)) remove_path(file);
    }
    remove_path(level);
  }
}

/// Even a damaged file says whose it is.
void check_schema(const fs::path& file, std::string_view schema) {
  if (!fs::exists(file) || content_of(file).find(schema) != std::string::npos) return;
  throw Error(ErrorCode::usage, file.string() + " is of no forest", kNameAnother);
}

/// Of what `list` names, the shapes beside the tiles, as long as they are what was written.
void remove_listed(const fs::path& list, std::string_view schema, const fs::path& folder) {
  Json files;
  try {
    files = unsealed(content_of(list), schema, list.string(), "").at("files");
  } catch (const Error&) {
    return;  // missing or damaged: then nothing tells what is ours
  }
  for (const auto& [name, record] : files.items()) {
    const fs::path file = folder / name;
    const std::string extension = lower_extension(file);
    if ((extension == ".glb" || extension == ".ply") && fs::is_regular_file(file) &&
        record_of_file(file).sha256 == record.at("sha256").get<std::string>()) {
      remove_path(file);
    }
  }
}

}  // namespace

void remove_path(const fs::path& path) {
  if (std::remove(path.c_str()) == 0) return;
  const int reason = errno;
  if (reason != ENOENT && reason != ENOTEMPTY && reason != EEXIST) throw write_error(path, reason);
}

std::vector<fs::path> ForestFolder::journals() const {
  std::vector<fs::path> journals;
  for (const fs::path& entry : entries_of(work())) {
    if (is_journal(entry.filename().string())) journals.push_back(entry);
  }
  std::sort(journals.begin(), journals.end());
  return journals;
}

void ForestFolder::check_ours() const {
  if (fs::exists(manifest())) return;  // which is checked when it is read
  if (!fs::exists(work())) {
    for (const char* name : {"tiles", "tileset.json", "forest.glb"}) {
      if (!fs::exists(folder_ / name)) continue;
      throw Error(ErrorCode::usage, (folder_ / name).string() + " is there already", kNameAnother);
    }
  }
  for (const fs::path& entry : entries_of(work())) {
    // A plan comes before all else, so it is looked for after.
    if (is_temporary(entry.filename().string()) || fs::exists(plan())) continue;
    throw Error(ErrorCode::usage, entry.string() + " is of no forest", kNameAnother);
  }
}

void ForestFolder::remove_forest() const {
  check_schema(manifest(), kManifestSchema);
  check_schema(plan(), kPlanSchema);
  if (!fs::exists(manifest()) && !fs::exists(plan()) && !fs::exists(removed())) return;
  for (const fs::path& journal : journals()) LineFile(journal, "another process");

  if (fs::exists(manifest())) {  // first, so that no manifest lists what is gone
    std::error_code error;
    fs::create_directories(work(), error);
    if (!error) fs::rename(manifest(), removed(), error);
    if (error) throw write_error(removed(), error.value());
  }
  remove_listed(removed(), kManifestSchema, folder_);
  remove_listed(files(), kFilesSchema, folder_);
  remove_tiles(tiles());
  for (const char* name : {"tiles", "tileset.json", "forest.glb"}) remove_path(folder_ / name);
  clear_work();  // work/ stays: what is left in tiles/ is known not to be in the way
}

void ForestFolder::remove_work() const {
  clear_work();
  remove_path(work());
}

void ForestFolder::clear_work() const {
  for (const fs::path& journal : journals()) remove_path(journal);
  remove_tiles(work());
  for (const fs::path& entry : entries_of(work())) {
    if (is_temporary(entry.filename().string())) remove_path(entry);
  }
  // The plan last: without it, work/ is not ours.
  for (const fs::path& file : {files(), removed(), control(), plan()}) remove_path(file);
}

void ForestFolder::remove_temporary() const {
  for (const fs::path& entry : entries_of(work())) {
    const std::string name = entry.filename().string();
    if (is_temporary(name) && name.starts_with("." + writer_ + ".")) remove_path(entry);
  }
}

}  // namespace leafhull
