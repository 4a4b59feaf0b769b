// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <ostream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "output/temporary_file.h"
#include "runs/checksum.h"

namespace leafhull {

/// Puts a run's files into its folder: each appears whole or not at all, and its content is on the
/// disk before it has its name. Folders are made where they are missing. Any thread may call.
class RunFolder {
 public:
  /// @param unfinished the folder that files are written in before they get their names.
  /// @param writer     tells the unfinished files of this process from those of others.
  RunFolder(std::filesystem::path unfinished, std::string writer)
      : unfinished_(std::move(unfinished)), writer_(std::move(writer)) {}

  const std::string& writer() const { return writer_; }

  using Fill = std::function<void(std::ostream&)>;

  /// Writes `file`, whose permissions stay where it exists. Where it is on another file system than
  /// the unfinished files, it is written beside its place.
  /// @param before called once the content is on the disk.
  /// @throws Error output; the file is then as before.
  FileRecord write(const std::filesystem::path& file, const Fill& fill,
                   const std::function<void(const FileRecord&)>& before = {});
  FileRecord write(const std::filesystem::path& file, std::string_view bytes);
  /// Writes `file` unless it exists; either way its name is then on the disk. @throws Error output.
  void write_once(const std::filesystem::path& file, std::string_view bytes);
  /// Gives the whole file `file` a second name, or copies it where the file system has no hard
  /// links. @throws Error output, or input: it cannot be read.
  void link(const std::filesystem::path& file, const std::filesystem::path& name);

  /// Makes a folder where it is missing. @throws Error output.
  void make_folder(const std::filesystem::path& folder);

  /// Flushes the names of all files so far to the disk, so that a journal may list them.
  /// @throws Error output.
  void sync();

  /// Removes what an earlier process of this writer's name has left in the folder of unfinished
  /// files.
  void remove_unfinished() const;

 private:
  TemporaryFile filled(const std::filesystem::path& file, const Fill& fill);
  void named(const std::filesystem::path& file);

  std::filesystem::path unfinished_;
  std::string writer_;
  std::mutex mutex_, syncing_;
  std::set<std::filesystem::path> made_, unsynced_;  ///< folders
};

/// Whether RunFolder gives such names to files that are being written.
bool is_unfinished(const std::string& name);

/// A folder's entries, ascending; none where it does not exist.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

/// Removes a file or an empty folder. @throws Error output.
void remove_path(const std::filesystem::path& path);

}  // namespace leafhull
