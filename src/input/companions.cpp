// SPDX-License-Identifier: Apache-2.0
#include "input/companions.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <vector>

#include "input/input_error.h"
#include "text/text.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> kTextureFolders{"textures", "texture", "tex",
                                                          "maps",     "images",  "materials"};

/// The number of names at the end of a path that are searched for.
constexpr std::size_t kMostParts = 6;

bool has_drive(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return name.size() > 2 && is_letter(name[0]) && name[1] == ':' && name[2] == '/';
}

/// A normalised path with slashes, without a scheme or a drive.
fs::path path_of(std::string_view written) {
  std::string name(written);
  std::ranges::replace(name, '\\', '/');
  for (const std::string_view scheme : {"file:///", "file://"}) {
    if (!name.starts_with(scheme)) continue;
    name = "/" + name.substr(scheme.size());
    if (has_drive(std::string_view(name).substr(1))) name.erase(0, 1);
    break;
  }
  if (has_drive(name)) name.erase(0, 2);
  return fs::path(name).lexically_normal();
}

bool is_outside(const fs::path& path) {
  return path.is_absolute() || (!path.empty() && *path.begin() == "..");
}

bool is_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return !error && fs::exists(status) && !fs::is_directory(status);
}

/// The entry of that name in upper or lower case: the exact one, else the first by name.
std::optional<fs::path> entry_of(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  const std::string wanted = in_lower_case(name);
  std::optional<fs::path> found;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const bool fits = in_lower_case(entry->path().filename().string()) == wanted;
    if (fits && (!found || entry->path() < *found)) found = entry->path();
  }
  return found;
}

std::optional<fs::path> file_of(fs::path folder, std::span<const std::string> names) {
  for (const std::string& name : names) {
    const std::optional<fs::path> entry = entry_of(folder.empty() ? fs::path(".") : folder, name);
    if (!entry) return std::nullopt;
    folder = *entry;
  }
  return is_file(folder) ? std::optional(folder) : std::nullopt;
}

}  // namespace

Companions::Companions(fs::path tree_file, bool allow_outside)
    : tree_file_(std::move(tree_file)), allow_outside_(allow_outside) {}

std::optional<fs::path> Companions::beside(const fs::path& written) const {
  std::vector<std::string> names;
  for (const fs::path& part : written.relative_path()) {
    if (part != "." && part != ".." && !part.empty()) names.push_back(part.string());
  }
  if (names.empty()) return std::nullopt;
  const fs::path folder = tree_file_->parent_path();
  const std::size_t whole = names.size() > kMostParts ? names.size() - kMostParts : 0;
  for (std::size_t first = whole; first < names.size(); ++first) {
    if (auto found = file_of(folder, std::span(names).subspan(first))) return found;
  }
  std::vector<std::string> folders(kTextureFolders.begin(), kTextureFolders.end());
  folders.push_back(tree_file_->stem().string() + ".fbm");  // of FBX files with media
  for (const std::string& textures : folders) {
    if (auto found = file_of(folder, std::array{textures, names.back()})) return found;
  }
  return std::nullopt;
}

void Companions::require_inside(const fs::path& file) const {
  if (allow_outside_) return;
  std::error_code error;
  const fs::path folder = tree_file_->parent_path();
  const fs::path home = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
  const fs::path way = fs::weakly_canonical(file, error).lexically_relative(home);
  if (error || way.empty() || *way.begin() == "..") {
    throw FileError("it leads out of the file's folder, which only --allow-outside permits");
  }
}

Companions::Found Companions::find(std::string_view written) const {
  if (!tree_file_) throw FileError("files beside this one are not read");
  const fs::path path = path_of(written);
  const bool outside = is_outside(path);
  const fs::path as_written = tree_file_->parent_path() / path;
  if ((!outside || allow_outside_) && is_file(as_written)) {
    require_inside(as_written);
    return {as_written, {}};
  }
  if (const auto found = beside(path)) {
    require_inside(*found);
    return {*found, in_quotes(written) +
                        (outside ? " is taken from the file's own folder: "
                                 : " does not exist; used instead is ") +
                        in_quotes(found->string())};
  }
  if (outside && !allow_outside_) {
    throw FileError(
        "it lies outside the file's folder, which only --allow-outside permits, and the folder has "
        "no file of that name");
  }
  throw FileError(std::make_error_code(std::errc::no_such_file_or_directory).message());
}

Bytes read_companion(const Companions& companions, std::string_view written,
                     std::vector<std::string>& warnings) {
  const Companions::Found found = companions.find(written);
  Bytes bytes = read_file(found.path);
  if (!found.note.empty()) warnings.push_back(found.note);
  return bytes;
}

}  // namespace leafhull
