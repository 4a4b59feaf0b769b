// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace leafhull {

/// Leaves new bytes uninitialised, as a file is read into them.
template <class T>
struct LeftAsItIs : std::allocator<T> {
  template <class U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

using Bytes = std::vector<std::uint8_t, LeftAsItIs<std::uint8_t>>;
using ByteSpan = std::span<const std::uint8_t>;

/// Why a file cannot be read.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Pipes { refused, read };

/// The whole of a regular file, or of a pipe if those are allowed. Other files may never end.
/// @throws FileError.
Bytes read_file(const std::filesystem::path& path, Pipes pipes = Pipes::refused);

inline std::string_view text_of(ByteSpan bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A URI with its %20 and the like replaced.
std::string percent_decoded(std::string_view uri);

}  // namespace leafhull
