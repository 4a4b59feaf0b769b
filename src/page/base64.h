// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace leafhull {

std::string base64(std::span<const std::uint8_t> bytes);

/// A data URI, which replaces the address in an `src`. Source: RFC 2397.
std::string data_uri(std::string_view media_type, std::span<const std::uint8_t> bytes);

}  // namespace leafhull
