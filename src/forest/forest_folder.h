// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "forest/record.h"
#include "forest/sealed_json.h"

namespace leafhull {

inline constexpr std::string_view kManifestSchema = "leafhull-forest/1";
inline constexpr std::string_view kPlanSchema = "leafhull-forest-plan/1";
inline constexpr std::string_view kControlSchema = "leafhull-forest-control/1";
inline constexpr std::string_view kFilesSchema = "leafhull-forest-files/1";

/// LEVEL/X_Y_Z, as messages and names of files have it.
std::string name_of(const TileId& tile);

/// What is where in a forest's folder, for one of its writers.
class ForestFolder {
 public:
  ForestFolder(std::filesystem::path folder, std::string writer)
      : folder_(std::move(folder)), writer_(std::move(writer)) {}

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path manifest() const { return folder_ / "manifest.json"; }
  std::filesystem::path tiles() const { return folder_ / "tiles"; }
  std::filesystem::path tile(const TileId& id) const { return tiles() / (name_of(id) + ".glb"); }

  // Gone when the forest is finished.
  std::filesystem::path work() const { return folder_ / "work"; }
  std::filesystem::path plan() const { return work() / "plan.json"; }
  std::filesystem::path control() const { return work() / "control.json"; }
  std::filesystem::path journal() const { return work() / ("journal-" + writer_ + ".jsonl"); }
  std::vector<std::filesystem::path> journals() const;
  std::filesystem::path mesh(const TileId& id) const { return work() / (name_of(id) + ".glb"); }
  std::filesystem::path seam(const TileId& id) const { return work() / (name_of(id) + ".seam"); }
  /// The seam of what is left of a tile that has lost pieces.
  std::filesystem::path kept_seam(const TileId& id) const {
    return work() / (name_of(id) + ".kept");
  }
  /// Files that may lie outside of the folder.
  std::filesystem::path files() const { return work() / "files.json"; }
  /// The manifest of a forest that is being removed.
  std::filesystem::path removed() const { return work() / "removed.json"; }

  /// Writes `file`, whose folder is made: under a temporary name in work/, where nothing outlives
  /// the forest (beside the file on another file system), then synced and renamed;
  /// its name is for the caller to sync.
  /// @param before called before the rename.
  /// @throws Error output.
  FileRecord write(const std::filesystem::path& file,
                   const std::function<void(std::ostream&)>& writer,
                   const std::function<void(const FileRecord&)>& before = {}) const;
  /// Gives `file` a second name, or copies it where the file system knows but one.
  void link(const std::filesystem::path& file, const std::filesystem::path& name) const;
  /// Writes `file` unless it is there.
  void write_once(const std::filesystem::path& file, const std::string& text) const;

  /// Refuses a folder whose files of a forest's names are of no forest of ours.
  void check_ours() const;
  /// Removes the forest and nothing else. @throws Error usage: another process is at it.
  void remove_forest() const;
  /// Removes work/; what is not ours stays.
  void remove_work() const;
  /// Removes what this writer has left half-written.
  void remove_temporary() const;

 private:
  void clear_work() const;

  std::filesystem::path folder_;
  std::string writer_;
};

/// Removes a file, or a folder where it is empty. @throws Error output.
void remove_path(const std::filesystem::path& path);

/// A file of ours, whole. @throws Error input: it cannot be read.
std::string content_of(const std::filesystem::path& file);

}  // namespace leafhull
