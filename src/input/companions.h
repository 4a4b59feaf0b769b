// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/file_bytes.h"

namespace leafhull {

/// The files that a tree file names: textures, buffers, material libraries. Tree files come from
/// the net and should not reach other files of this machine, so by default only those in the tree
/// file's folder and below are read.
class Companions {
 public:
  /// No companion is read.
  Companions() = default;
  Companions(std::filesystem::path tree_file, bool allow_outside);

  bool any() const { return tree_file_.has_value(); }

  struct Found {
    std::filesystem::path path;
    std::string note;  ///< how it was found, where that is a guess
  };
  /// Finds the file of a name as the tree file has it, with slashes of either kind. If it is not
  /// there, it is searched for by the end of its path and in the usual folders for textures,
  /// ignoring case: paths of other machines and wrong capitals are common.
  /// @throws FileError: it is not there, or lies outside.
  Found find(std::string_view written) const;

 private:
  /// @throws FileError: a link leads out of the folder, and may not.
  void require_inside(const std::filesystem::path& file) const;
  std::optional<std::filesystem::path> beside(const std::filesystem::path& written) const;

  std::optional<std::filesystem::path> tree_file_;
  bool allow_outside_ = false;
};

/// The bytes of a companion; `warnings` get a line where finding it was a guess.
/// @throws FileError.
Bytes read_companion(const Companions& companions, std::string_view written,
                     std::vector<std::string>& warnings);

}  // namespace leafhull
