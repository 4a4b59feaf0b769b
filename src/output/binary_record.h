// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstring>
#include <ostream>
#include <type_traits>

namespace leafhull {

static_assert(std::endian::native == std::endian::little, "files are little-endian, as memory is");

/// Writes the values' bytes one after the other, without padding between them.
template <class... Values>
void write_record(std::ostream& stream, const Values&... values) {
  static_assert((std::is_trivially_copyable_v<Values> && ...));
  std::array<char, (sizeof(Values) + ...)> record;
  char* end = record.data();
  ((std::memcpy(end, &values, sizeof values), end += sizeof values), ...);
  stream.write(record.data(), static_cast<std::streamsize>(record.size()));
}

}  // namespace leafhull
