// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "leafhull/leaves.h"

namespace leafhull {

// What tells a run from any other.

/// Appends the bytes of values; a struct that has padding is given member by member.
template <class... Values>
void add_bytes(std::string& bytes, const Values&... values) {
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
}

/// SHA-256 of all leaf vertices, hexadecimal.
std::string checksum_of(const LeafSet& leaves);

}  // namespace leafhull
