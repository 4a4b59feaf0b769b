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

Bytes read_named_file(const std::filesystem::path& path, std::string_view remedy) try {
  return read_file(path, Pipes::read);
} catch (const FileError& error) {
  input_error(path.string(), "", std::string("cannot be read: ") + error.what(), remedy);
}

std::string hidden_meshes(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " hidden mesh is" : " hidden meshes are") +
         " passed over";
}

std::string in_quotes(std::string_view text) {
  std::string quoted = "\"";
  quoted += printable(text);
  return quoted += '"';
}

}  // namespace leafhull
