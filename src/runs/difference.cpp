// SPDX-License-Identifier: Apache-2.0
#include "runs/difference.h"

#include "text/choice.h"
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

}  // namespace

std::string Difference::text() const {
  const std::string place = joined(path, ".");
  return (place.empty() ? "the plan" : place) + " is " + shown(there) + " there and " +
         shown(here) + " here";
}

std::optional<Difference> first_difference(const Json& there, const Json& here) {
  if (there == here && there.is_discarded() == here.is_discarded()) return {};
  if (there.type() == here.type() && there.is_structured()) {
    for (const Json* keys : {&here, &there}) {
      for (const auto& [key, value] : keys->items()) {
        if (auto found = first_difference(member(there, key), member(here, key))) {
          found->path.insert(found->path.begin(), key);
          return found;
        }
      }
    }
  }
  return Difference{{}, there, here};
}

}  // namespace leafhull
