// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <string_view>

namespace leafhull {

/// The index of `text`, the value of an option, among `valid`.
/// @throws Error usage: it is none of them; the nearest is suggested.
std::size_t choice(std::string_view flag, std::string_view text,
                   std::span<const std::string_view> valid);

/// The one of `valid` that `text` was probably meant to be; empty where none is near.
std::string_view nearest(std::string_view text, std::span<const std::string_view> valid);

/// The words with `separator` between them; empty ones are left out.
/// @param word gives the word of an item.
template <class Each, class Word = std::identity>
std::string joined(const Each& all, std::string_view separator, Word word = {}) {
  std::string text;
  for (const auto& each : all) {
    const auto& part = std::invoke(word, each);
    if (std::empty(part)) continue;
    if (!text.empty()) text += separator;
    text += part;
  }
  return text;
}

}  // namespace leafhull
