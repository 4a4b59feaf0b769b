// SPDX-License-Identifier: Apache-2.0
#include "runs/run_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "output/file_stream.h"
#include "output/write_error.h"
#include "runs/read_file.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

/// Whether a file can be renamed from one folder to the other: two mounts of one disk are apart.
bool on_one_mount(const fs::path& a, const fs::path& b) {
  constexpr unsigned kWanted = STATX_BASIC_STATS | STATX_MNT_ID;
  struct statx at_a {
  }, at_b{};
  return ::statx(AT_FDCWD, a.c_str(), 0, kWanted, &at_a) == 0 &&
         ::statx(AT_FDCWD, b.c_str(), 0, kWanted, &at_b) == 0 &&
         at_a.stx_dev_major == at_b.stx_dev_major && at_a.stx_dev_minor == at_b.stx_dev_minor &&
         at_a.stx_mnt_id == at_b.stx_mnt_id;  // both 0 where the kernel does not know
}

/// The folder without a final slash, with which its parent would be the folder itself.
fs::path whole_name(const fs::path& folder) {
  fs::path name = fs::absolute(folder).lexically_normal();
  return name.has_filename() ? name : name.parent_path();
}

void rename(const char* from, const fs::path& to) {
  if (std::rename(from, to.c_str()) != 0) throw write_error(to, errno);
}

}  // namespace

void RunFolder::make_folder(const fs::path& folder) {
  const std::lock_guard alone(mutex_);
  if (!made_.insert(folder).second) return;
  std::error_code error;
  fs::path above = whole_name(folder).parent_path();
  unsynced_.insert(above);
  for (; above.has_relative_path() && !fs::exists(above, error); above = above.parent_path()) {
    unsynced_.insert(above.parent_path());
  }
  fs::create_directories(folder, error);
  if (error) throw write_error(folder, error.value());
}

TemporaryFile RunFolder::filled(const fs::path& file, const Fill& fill) {
  make_folder(file.parent_path());
  make_folder(unfinished_);
  const bool near = on_one_mount(unfinished_, file.parent_path());
  TemporaryFile temporary(near ? unfinished_ / (writer_ + "." + file.filename().string()) : file);
  temporary.copy_permissions(file);
  FileStream stream(temporary.descriptor(), file);
  fill(stream);
  stream.flush();
  temporary.finish(file);
  return temporary;
}

void RunFolder::named(const fs::path& file) {
  const std::lock_guard alone(mutex_);
  unsynced_.insert(file.parent_path());
}

FileRecord RunFolder::write(const fs::path& file, const Fill& fill,
                            const std::function<void(const FileRecord&)>& before) {
  const TemporaryFile temporary = filled(file, fill);
  FileRecord record = record_of_file(temporary.path());
  if (before) before(record);
  rename(temporary.path(), file);
  named(file);
  return record;
}

FileRecord RunFolder::write(const fs::path& file, std::string_view bytes) {
  return write(file, [&](std::ostream& stream) { stream << bytes; });
}

void RunFolder::write_once(const fs::path& file, std::string_view bytes) {
  const TemporaryFile temporary = filled(file, [&](std::ostream& stream) { stream << bytes; });
  int reason = ::link(temporary.path(), file.c_str()) == 0 ? 0 : errno;
  if (reason != 0 && reason != EEXIST) {  // no hard links on this file system
    const int renamed =
        ::renameat2(AT_FDCWD, temporary.path(), AT_FDCWD, file.c_str(), RENAME_NOREPLACE);
    reason = renamed == 0 ? 0 : errno;
  }
  if (reason != 0 && reason != EEXIST) throw write_error(file, reason);
  named(file);
  sync();
}

void RunFolder::link(const fs::path& file, const fs::path& name) {
  make_folder(name.parent_path());
  static std::atomic<unsigned> count{0};
  const fs::path temporary = unfinished_ / ("." + writer_ + "." + std::to_string(count++) + ".tmp");
  ::unlink(temporary.c_str());  // left by a process that was killed
  if (::link(file.c_str(), temporary.c_str()) != 0) {
    write(name, content_of(file));
    return;
  }
  const int reason = std::rename(temporary.c_str(), name.c_str()) == 0 ? 0 : errno;
  ::unlink(temporary.c_str());  // where both were one file already, the rename has left it
  if (reason != 0) throw write_error(name, reason);
  named(name);
}

void RunFolder::sync() {
  const std::lock_guard one_at_a_time(syncing_);  // whoever comes second finds all of it done
  std::set<fs::path> folders;
  {
    const std::lock_guard alone(mutex_);
    folders = unsynced_;
  }
  for (const fs::path& folder : folders) {
    sync_folder(folder);
    const std::lock_guard alone(mutex_);
    unsynced_.erase(folder);
  }
}

void RunFolder::remove_unfinished() const {
  for (const fs::path& entry : entries_of(unfinished_)) {
    const std::string name = entry.filename().string();
    if (is_unfinished(name) && name.starts_with("." + writer_ + ".")) remove_path(entry);
  }
}

bool is_unfinished(const std::string& name) {
  return name.starts_with(".") && name.ends_with(".tmp");
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code missing;
  for (fs::directory_iterator at(folder, missing), end; !missing && at != end;
       at.increment(missing)) {
    entries.push_back(at->path());
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

void remove_path(const fs::path& path) {
  if (std::remove(path.c_str()) == 0) return;
  const int reason = errno;
  if (reason != ENOENT && reason != ENOTEMPTY && reason != EEXIST) throw write_error(path, reason);
}

}  // namespace leafhull
