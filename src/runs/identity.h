// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "leafhull/device.h"
#include "leafhull/leaves.h"

namespace leafhull {

// What makes a run this one and no other.

/// Adds the bytes of values to others; those of a struct with padding are for the caller to name.
template <class... Values>
void add_bytes(std::string& bytes, const Values&... values) {
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
}

/// A checksum of the leaves.
std::string checksum_of(const LeafSet& leaves);

/// "DEVICE (PLATFORM, VARIANT)".
std::string text_of(const DeviceInfo& device);

}  // namespace leafhull
