// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "input/file_bytes.h"

namespace leafhull {

/// A format of tree files that leafhull does not read.
struct ForeignFormat {
  std::string name;
  std::string remedy;  ///< the command that converts it, or the next step
};

/// Recognises such a format by the file's first bytes or its extension.
std::optional<ForeignFormat> foreign_format(ByteSpan bytes, const std::filesystem::path& path);

}  // namespace leafhull
