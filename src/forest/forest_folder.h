// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "forest/tile_record.h"
#include "runs/run_folder.h"

namespace leafhull {

inline constexpr std::string_view kManifestSchema = "leafhull-forest/1";
inline constexpr std::string_view kPlanSchema = "leafhull-forest-plan/1";
inline constexpr std::string_view kControlSchema = "leafhull-forest-control/1";
inline constexpr std::string_view kFilesSchema = "leafhull-forest-files/1";

/// The layout of a forest's folder, for one of its writers.
class ForestFolder : public RunFolder {
 public:
  ForestFolder(const std::filesystem::path& folder, const std::string& writer)
      : RunFolder(folder / "work", writer), folder_(folder) {}

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path manifest() const { return folder_ / "manifest.json"; }
  std::filesystem::path tiles() const { return folder_ / "tiles"; }
  std::filesystem::path tile(const TileId& id) const { return folder_ / file_of(id); }

  // These are gone when the forest is finished.
  std::filesystem::path work() const { return folder_ / "work"; }
  std::filesystem::path plan() const { return work() / "plan.json"; }
  std::filesystem::path control() const { return work() / "control.json"; }
  std::filesystem::path journal() const { return work() / ("journal-" + writer() + ".jsonl"); }
  std::vector<std::filesystem::path> journals() const;
  std::filesystem::path mesh(const TileId& id) const { return work() / (name_of(id) + ".glb"); }
  std::filesystem::path seam(const TileId& id) const { return work() / (name_of(id) + ".seam"); }
  /// The seam of the rest of a tile that has lost pieces.
  std::filesystem::path kept_seam(const TileId& id) const {
    return work() / (name_of(id) + ".kept");
  }
  /// The list of files that may lie outside the folder.
  std::filesystem::path files() const { return work() / "files.json"; }
  /// The manifest of a forest that is being removed.
  std::filesystem::path removed() const { return work() / "removed.json"; }

  /// Refuses a folder whose files have a forest's names but belong to no forest of ours.
  void check_ours() const;
  /// Removes the forest and nothing else. @throws Error usage: another process is using it.
  void remove_forest() const;
  /// Removes work/; what is not ours stays.
  void remove_work() const;

 private:
  void clear_work() const;

  std::filesystem::path folder_;
};

/// Refuses a file with the name of one of the forest's own in `folder`: a run overwrites it, or
/// `restart` removes it.
/// @param what the file, in words, such as "the scene".
/// @throws Error usage.
void check_name(const std::filesystem::path& file, std::string_view what,
                const std::filesystem::path& folder);

}  // namespace leafhull
