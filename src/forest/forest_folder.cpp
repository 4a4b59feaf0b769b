// SPDX-License-Identifier: Apache-2.0
#include "forest/forest_folder.h"

#include <cstdio>
#include <system_error>

#include "leafhull/error.h"
#include "output/write_error.h"
#include "runs/read_file.h"
#include "runs/sealed_json.h"
#include "runs/sealed_lines.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNameAnother = "Name another folder, or move it away.";

bool is_journal(const std::string& name) {
  return name.starts_with("journal-") && name.ends_with(".jsonl");
}

/// Whether a file is a tile's: LEVEL/X_Y_Z with a suffix.
bool is_tile_file(const fs::path& file) {
  const std::string name = file.parent_path().filename().string() + "/" + file.stem().string();
  const std::string extension = file.extension().string();
  TileId id;
  return (extension == ".glb" || extension == ".seam" || extension == ".kept") &&
         std::sscanf(name.c_str(), "%d/%d_%d_%d", &id.level, &id.at.x, &id.at.y, &id.at.z) == 4 &&
         name_of(id) == name;
}

bool is_level(const std::string& name) {
  return !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
}

/// Removes LEVEL/X_Y_Z.* and the folders that are then empty.
void remove_tiles(const fs::path& folder) {
  for (const fs::path& level : entries_of(folder)) {
    if (!is_level(level.filename().string())) continue;
    for (const fs::path& file : entries_of(level)) {
      if (is_tile_file(file)) remove_path(file);
    }
    remove_path(level);
  }
}

/// Refuses a file of another program; even a damaged file of ours holds its schema's name.
void check_schema(const fs::path& file, std::string_view schema) {
  if (!fs::exists(file) || content_of(file).find(schema) != std::string::npos) return;
  throw Error(ErrorCode::usage, file.string() + " does not belong to a forest", kNameAnother);
}

/// Removes the shapes beside the tiles that `list` names, where they are still as written.
void remove_listed(const fs::path& list, std::string_view schema, const fs::path& folder) {
  Json files;
  try {
    files = unsealed_file(list, schema, "").at("files");
  } catch (const Error&) {
    return;  // missing or damaged: nothing tells what is ours
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

void check_name(const fs::path& file, std::string_view what, const fs::path& folder) {
  std::error_code unreadable;  // its reader or writer reports this too
  const auto place = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path, unreadable), unreadable);
  };
  for (const fs::path& found :
       {place(fs::absolute(file, unreadable).parent_path()) / file.filename(), place(file)}) {
    const fs::path within = found.lexically_relative(place(folder));
    for (const char* name : {"manifest.json", "tileset.json", "forest.glb", "tiles", "work"}) {
      if (within.empty() || *within.begin() != name) continue;
      throw Error(ErrorCode::usage,
                  std::string(what) + " " + file.string() +
                      " has the name of one of the forest's files: " + (folder / name).string() +
                      " would be overwritten or removed",
                  "Name another file, or another folder with -o.");
    }
  }
}

std::vector<fs::path> ForestFolder::journals() const {
  std::vector<fs::path> journals;
  for (const fs::path& entry : entries_of(work())) {
    if (is_journal(entry.filename().string())) journals.push_back(entry);
  }
  return journals;
}

void ForestFolder::check_ours() const {
  if (fs::exists(manifest())) return;  // a manifest is checked when it is read
  if (!fs::exists(work())) {
    for (const char* name : {"tiles", "tileset.json", "forest.glb"}) {
      if (!fs::exists(folder_ / name)) continue;
      throw Error(ErrorCode::usage, (folder_ / name).string() + " already exists", kNameAnother);
    }
  }
  for (const fs::path& entry : entries_of(work())) {
    // Another rank writes its plan before all else, so look for a plan after listing.
    if (is_unfinished(entry.filename().string()) || fs::exists(plan())) continue;
    throw Error(ErrorCode::usage, entry.string() + " does not belong to a forest", kNameAnother);
  }
}

void ForestFolder::remove_forest() const {
  check_schema(manifest(), kManifestSchema);
  check_schema(plan(), kPlanSchema);
  if (!fs::exists(manifest()) && !fs::exists(plan()) && !fs::exists(removed())) return;
  for (const fs::path& journal : journals()) SealedLines(journal, "another process");

  if (fs::exists(manifest())) {  // first, so that no manifest lists missing files
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
    if (is_unfinished(entry.filename().string())) remove_path(entry);
  }
  // The plan goes last: without it, work/ is not ours.
  for (const fs::path& file : {files(), removed(), control(), plan()}) remove_path(file);
}

}  // namespace leafhull
