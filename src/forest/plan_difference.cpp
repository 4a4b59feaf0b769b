// SPDX-License-Identifier: Apache-2.0
#include "forest/plan_difference.h"

#include "text/text.h"

namespace leafhull {
namespace {

std::string shown(const Json& value) {
  return value.is_discarded() ? "missing" : printable(dumped(value));
}

/// A member of an object or an element of a list; discarded where there is none.
Json member(const Json& of, const std::string& key) {
  const Json none(Json::value_t::discarded);
  if (of.is_object()) return of.value(key, none);
  const std::size_t index = std::stoul(key);
  return index < of.size() ? of[index] : none;
}

std::string inner_path(std::string path, const std::string& key) {
  if (!path.empty()) path += '.';
  return path += key;
}

std::optional<std::string> first_difference(const Json& there, const Json& here,
                                            const std::string& path) {
  if (there == here && there.is_discarded() == here.is_discarded()) return {};
  if (there.type() == here.type() && there.is_structured()) {
    for (const Json* keys : {&here, &there}) {
      for (const auto& [key, value] : keys->items()) {
        const std::string inner = inner_path(path, key);
        if (auto found = first_difference(member(there, key), member(here, key), inner)) {
          return found;
        }
      }
    }
  }
  return (path.empty() ? "the plan" : path) + " is " + shown(there) + " there and " + shown(here) +
         " here";
}

}  // namespace

std::optional<std::string> difference(const Json& there, const Json& here) {
  return first_difference(there, here, "");
}

}  // namespace leafhull
