// SPDX-License-Identifier: Apache-2.0
#include "output/destination.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "leafhull/output.h"
#include "output/write_error.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

/// The path where a chain of symbolic links ends; it may not exist.
fs::path follow_links(const fs::path& name) {
  constexpr int kMostLinks = 40;  // as Linux does
  fs::path place = name;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(place, error)); ++links) {
    if (links == kMostLinks) throw write_error(name, ELOOP);
    // An absolute target replaces the whole path.
    place = place.parent_path() / fs::read_symlink(place, error);
    if (error) throw write_error(name, error.value());
  }
  return place;
}

fs::path existing_folder(const fs::path& folder, const fs::path& name) {
  std::error_code error;
  fs::path real = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
  if (error == std::errc::no_such_file_or_directory) {
    throw Error(
        ErrorCode::output,
        "cannot write " + name.string() + ": the folder " + folder.string() + " does not exist",
        "Create it first (mkdir -p), or name another folder.");
  }
  if (error) throw write_error(name, error.value());
  return real;
}

bool may_access(const fs::path& path, int mode) {
  return ::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) == 0;
}

}  // namespace

void check_output_folder(const fs::path& name) {
  std::error_code error;
  fs::path existing = fs::absolute(name, error);
  while (!error && !fs::exists(existing, error) && existing.has_relative_path()) {
    existing = existing.parent_path();
  }
  if (error) throw write_error(name, error.value());
  if (!fs::is_directory(existing)) {
    throw Error(ErrorCode::output,
                "cannot write into " + name.string() + ": " + existing.string() + " is a file",
                "Name a folder.");
  }
  if (!may_access(existing, W_OK | X_OK)) {
    throw Error(
        ErrorCode::output,
        "cannot write into " + name.string() + ": " + existing.string() + " may not be written to",
        "Name another folder.");
  }
}

fs::path resolve_destination(const fs::path& name) {
  const fs::path end = follow_links(name);
  const fs::path folder = existing_folder(end.parent_path(), name);
  fs::path place = folder / end.filename();

  std::error_code error;
  const fs::file_status status = fs::status(place, error);
  if (status.type() == fs::file_type::not_found) {
    if (!may_access(folder, W_OK | X_OK)) throw write_error(name, errno);
    return place;
  }
  if (error) throw write_error(name, error.value());
  if (fs::is_directory(status)) throw write_error(name, EISDIR);
  if (!fs::is_regular_file(status)) {
    throw Error(ErrorCode::output, "cannot write " + name.string() + ": it is not a regular file",
                "Name a regular file.");
  }
  if (!may_access(place, W_OK) || !may_access(folder, W_OK | X_OK)) throw write_error(name, errno);
  return place;
}

void Destinations::add(const fs::path& file) {
  const fs::path destination = resolve_destination(file);
  std::error_code unreadable;
  if (destination == fs::weakly_canonical(input_, unreadable)) {
    throw Error(ErrorCode::usage, "the output " + file.string() + " is the input itself",
                "Name another file.");
  }
  const auto [first, is_new] = names_.emplace(destination, file);
  if (is_new) return;
  throw Error(
      ErrorCode::usage,
      "the outputs " + first->second.string() + " and " + file.string() + " are the same file",
      "Name each output differently.");
}

void refuse_extension(const fs::path& file, const std::string& extension,
                      const std::string& remedy) {
  throw Error(ErrorCode::usage,
              extension.empty() ? "the output " + file.string() + " has no extension"
                                : "unknown extension " + extension + " of " + file.string(),
              remedy);
}

}  // namespace leafhull
