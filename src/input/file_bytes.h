// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace leafhull {

using Bytes = std::vector<std::uint8_t>;
using ByteSpan = std::span<const std::uint8_t>;

/// The whole of a file.
/// @throws std::system_error: why it cannot be read, in the system's words.
Bytes read_file(const std::filesystem::path& path);

inline std::string_view text_of(ByteSpan bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A URI with its %20 and the like replaced.
std::string percent_decoded(std::string_view uri);

}  // namespace leafhull
