// SPDX-License-Identifier: Apache-2.0
#include "output/temporary_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <utility>

#include "leafhull/output.h"
#include "output/write_error.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

enum class SlotState { free, claimed, listed };

/// A path that a signal handler may read at any moment, so it lives outside the heap.
struct Slot {
  std::atomic<SlotState> state{SlotState::free};
  char path[PATH_MAX];
};
static_assert(std::atomic<SlotState>::is_always_lock_free);

std::array<Slot, 64> slots;

/// The number of running sections; -1 while temporary files are being discarded.
std::atomic<int> uninterrupted{0};
static_assert(std::atomic<int>::is_always_lock_free);

void wait_a_millisecond() noexcept { ::poll(nullptr, 0, 1); }

int claim_slot(const fs::path& destination) {
  for (std::size_t i = 0; i < slots.size(); ++i) {
    SlotState expected = SlotState::free;
    if (slots[i].state.compare_exchange_strong(expected, SlotState::claimed)) {
      return static_cast<int>(i);
    }
  }
  throw Error(ErrorCode::output,
              "cannot write " + destination.string() + ": more than " +
                  std::to_string(slots.size()) + " files are being written at once",
              "Write fewer files at once.");
}

/// .NAME.PID-COUNT.tmp; NAME is cut if the whole would be too long for a file name.
std::string temporary_name(const fs::path& destination) {
  static std::atomic<unsigned> count{0};
  const std::string number = std::to_string(::getpid()) + "-" + std::to_string(count++);
  const std::string suffix = "." + number + ".tmp";
  const std::string name = destination.filename().string().substr(0, NAME_MAX - 1 - suffix.size());
  return (destination.parent_path() / ("." + name + suffix)).string();
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& destination) : slot_(claim_slot(destination)) {
  Slot& slot = slots[static_cast<std::size_t>(slot_)];
  int reason = EEXIST;  // a file left by a killed process that had our process id
  while (descriptor_ < 0 && reason == EEXIST) {
    const std::string path = temporary_name(destination);
    slot.state = SlotState::claimed;
    if (path.size() >= sizeof slot.path) {
      reason = ENAMETOOLONG;
      break;
    }
    std::memcpy(slot.path, path.c_str(), path.size() + 1);
    slot.state = SlotState::listed;
    descriptor_ = ::open(slot.path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    reason = errno;
  }
  if (descriptor_ < 0) {
    slot.state = SlotState::free;
    throw write_error(destination, reason);
  }
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : slot_(std::exchange(other.slot_, -1)), descriptor_(std::exchange(other.descriptor_, -1)) {}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (slot_ < 0) return;
  ::unlink(path());
  slots[static_cast<std::size_t>(slot_)].state = SlotState::free;
}

const char* TemporaryFile::path() const { return slots[static_cast<std::size_t>(slot_)].path; }

void TemporaryFile::copy_permissions(const fs::path& existing) {
  struct stat status {};
  if (::stat(existing.c_str(), &status) != 0) return;
  // Change the owner first, as that may clear permission bits. Only a privileged user may do so.
  [[maybe_unused]] const int owned = ::fchown(descriptor_, status.st_uid, status.st_gid);
  [[maybe_unused]] const int permitted = ::fchmod(descriptor_, status.st_mode & 0777);
}

void TemporaryFile::finish(const fs::path& destination) {
  // Some file systems know no fsync and say EINVAL.
  if (::fsync(descriptor_) != 0 && errno != EINVAL) throw write_error(destination, errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) throw write_error(destination, errno);
}

void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // a folder may be writable and yet not readable
  const int reason = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (reason != 0 && reason != EINVAL) throw write_error(folder, reason);
}

UninterruptedSection::UninterruptedSection() {
  sigset_t every_signal;
  sigfillset(&every_signal);
  pthread_sigmask(SIG_SETMASK, &every_signal, &previous_signals_);
  for (int running = uninterrupted;;) {
    if (running < 0) {
      wait_a_millisecond();
      running = uninterrupted;
    } else if (uninterrupted.compare_exchange_weak(running, running + 1)) {
      return;
    }
  }
}

UninterruptedSection::~UninterruptedSection() {
  --uninterrupted;
  pthread_sigmask(SIG_SETMASK, &previous_signals_, nullptr);
}

void discard_unfinished_outputs() noexcept {
  const int reason = errno;
  int running = 0;
  while (!uninterrupted.compare_exchange_strong(running, -1)) {
    if (running < 0) break;  // this handler has interrupted itself
    wait_a_millisecond();
    running = 0;
  }
  for (Slot& slot : slots) {
    if (slot.state == SlotState::listed) ::unlink(slot.path);
  }
  uninterrupted = 0;
  errno = reason;
}

}  // namespace leafhull
