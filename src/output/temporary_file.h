// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <filesystem>

namespace leafhull {

/// A new file beside `destination`. discard_unfinished_outputs() knows it from before it exists
/// until it is removed with the object.
class TemporaryFile {
 public:
  /// @throws Error output, naming `destination`.
  explicit TemporaryFile(const std::filesystem::path& destination);
  ~TemporaryFile();
  TemporaryFile(TemporaryFile&& other) noexcept;
  TemporaryFile& operator=(TemporaryFile&&) = delete;

  const char* path() const;
  int descriptor() const { return descriptor_; }

  /// Gives the file the permissions and, where allowed, the owner of `existing`, if that exists.
  void copy_permissions(const std::filesystem::path& existing);

  /// Flushes the content to disk and closes the descriptor. @throws Error output.
  void finish(const std::filesystem::path& destination);

 private:
  int slot_ = -1;
  int descriptor_ = -1;
};

/// Flushes the names in a folder to disk: only then does a rename survive a power cut.
/// @throws Error output.
void sync_folder(const std::filesystem::path& folder);

/// While one exists, the calling thread takes no signals and discard_unfinished_outputs(), called
/// from another thread's handler, waits: an interrupt falls before or after the renames.
class UninterruptedSection {
 public:
  UninterruptedSection();
  ~UninterruptedSection();
  UninterruptedSection(const UninterruptedSection&) = delete;
  UninterruptedSection& operator=(const UninterruptedSection&) = delete;

 private:
  sigset_t previous_signals_;
};

}  // namespace leafhull
