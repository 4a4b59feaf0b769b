// SPDX-License-Identifier: Apache-2.0
#include "forest/forest_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <system_error>

#include "forest/checksum.h"
#include "leafhull/error.h"
#include "output/file_stream.h"
#include "output/temporary_file.h"
#include "output/write_error.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw write_error(folder, error.value());
}

bool on_one_file_system(const fs::path& a, const fs::path& b) {
  struct stat status_a {
  }, status_b{};
  return ::stat(a.c_str(), &status_a) == 0 && ::stat(b.c_str(), &status_b) == 0 &&
         status_a.st_dev == status_b.st_dev;
}

}  // namespace

std::string name_of(const TileId& tile) {
  const auto& [x, y, z] = tile.at;
  return std::to_string(tile.level) + "/" + std::to_string(x) + "_" + std::to_string(y) + "_" +
         std::to_string(z);
}

FileRecord ForestFolder::write(const fs::path& file,
                               const std::function<void(std::ostream&)>& writer,
                               const std::function<void(const FileRecord&)>& before) const {
  make_folder(file.parent_path());
  make_folder(work());
  TemporaryFile temporary(on_one_file_system(work(), file.parent_path())
                              ? work() / (writer_ + "." + file.filename().string())
                              : file);
  temporary.copy_permissions(file);
  FileStream stream(temporary.descriptor(), file);
  ChecksumStream checked(stream);
  writer(checked);
  stream.flush();
  temporary.finish(file);
  FileRecord record = checked.record();
  if (before) before(record);
  if (std::rename(temporary.path(), file.c_str()) != 0) throw write_error(file, errno);
  return record;
}

void ForestFolder::link(const fs::path& file, const fs::path& name) const {
  make_folder(name.parent_path());
  static std::atomic<unsigned> count{0};  // several threads put tiles in place
  const fs::path temporary = work() / ("." + writer_ + "." + std::to_string(count++) + ".tmp");
  ::unlink(temporary.c_str());  // of a process that was killed
  if (::link(file.c_str(), temporary.c_str()) != 0) {
    write(name, [&](std::ostream& stream) { stream << content_of(file); });
    return;
  }
  const int reason = std::rename(temporary.c_str(), name.c_str()) == 0 ? 0 : errno;
  ::unlink(temporary.c_str());  // where both were one file already, the rename has left it
  if (reason != 0) throw write_error(name, reason);
}

void ForestFolder::write_once(const fs::path& file, const std::string& text) const {
  make_folder(file.parent_path());
  TemporaryFile temporary(file.parent_path() / (writer_ + "." + file.filename().string()));
  FileStream stream(temporary.descriptor(), file);
  stream << text << std::flush;
  temporary.finish(file);
  int reason = ::link(temporary.path(), file.c_str()) == 0 ? 0 : errno;
  if (reason != 0 && reason != EEXIST) {  // no second names on this file system
    const int renamed =
        ::renameat2(AT_FDCWD, temporary.path(), AT_FDCWD, file.c_str(), RENAME_NOREPLACE);
    reason = renamed == 0 ? 0 : errno;
  }
  if (reason != 0 && reason != EEXIST) throw write_error(file, reason);
  sync_folder(file.parent_path());
}

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  errno = 0;
  if (stream) content << stream.rdbuf();
  if (!stream || stream.bad()) {
    throw Error(ErrorCode::input,
                "cannot read " + file.string() + ": " +
                    std::generic_category().message(errno != 0 ? errno : EIO),
                "Check the disk and the file's permissions.");
  }
  return std::move(content).str();
}

}  // namespace leafhull
