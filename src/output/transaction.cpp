// SPDX-License-Identifier: Apache-2.0
#include "output/transaction.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <set>
#include <utility>

#include "output/destination.h"
#include "output/file_stream.h"
#include "output/write_error.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

bool exchange(const char* a, const char* b) {
  return ::renameat2(AT_FDCWD, a, AT_FDCWD, b, RENAME_EXCHANGE) == 0;
}

}  // namespace

void Transaction::write(const fs::path& name, const std::function<void(std::ostream&)>& writer) {
  const fs::path destination = resolve_destination(name);
  TemporaryFile file(destination);
  file.copy_permissions(destination);  // before there is any content to read
  FileStream stream(file.descriptor(), name);
  writer(stream);
  stream.flush();
  add(name, std::move(file));
}

void Transaction::add(const fs::path& name, TemporaryFile file) {
  const fs::path destination = resolve_destination(name);
  file.copy_permissions(destination);
  file.finish(name);
  entries_.push_back({destination, std::move(file)});
}

void Transaction::commit() {
  const UninterruptedSection section;
  try {
    std::set<fs::path> folders;
    for (Entry& entry : entries_) {
      entry.put_in_place();
      folders.insert(entry.destination.parent_path());
    }
    for (const fs::path& folder : folders) sync_folder(folder);
  } catch (...) {
    for (Entry& entry : entries_) entry.take_back();
    throw;
  }
  entries_.clear();  // also removes the files that were replaced
}

void write_file(const std::filesystem::path& name, std::string_view bytes) {
  Transaction transaction;
  transaction.write(name, [&](std::ostream& stream) { stream << bytes; });
  transaction.commit();
}

void Transaction::Entry::put_in_place() {
  const bool exists = ::access(destination.c_str(), F_OK) == 0;
  if (exists && exchange(file.path(), destination.c_str())) {
    placement = Placement::exchanged;
    return;
  }
  if (std::rename(file.path(), destination.c_str()) != 0) throw write_error(destination, errno);
  placement = exists ? Placement::overwritten : Placement::created;
}

void Transaction::Entry::take_back() noexcept {
  if (placement == Placement::exchanged) exchange(file.path(), destination.c_str());
  if (placement == Placement::created) std::rename(destination.c_str(), file.path());
  if (placement != Placement::overwritten) placement = Placement::pending;
}

}  // namespace leafhull
