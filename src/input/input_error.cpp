// SPDX-License-Identifier: Apache-2.0
#include "input/input_error.h"

#include "leafhull/error.h"

namespace leafhull {

void input_error(std::string_view file, std::string_view place, std::string_view what,
                 std::string_view remedy) {
  std::string message = printable(file, 1000) + ": ";
  if (!place.empty()) message += std::string(place) + ": ";
  throw Error(ErrorCode::input, message + std::string(what), std::string(remedy));
}

std::string printable(std::string_view text, std::size_t longest) {
  const bool cut = text.size() > longest;
  std::string line(text.substr(0, longest));
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return cut ? line + "..." : line;
}

std::string in_quotes(std::string_view text) {
  std::string quoted = "\"";
  quoted += printable(text);
  return quoted += '"';
}

}  // namespace leafhull
