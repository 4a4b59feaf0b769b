// SPDX-License-Identifier: Apache-2.0
#include "chart/gnuplot.h"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "leafhull/error.h"

namespace leafhull {
namespace {

[[noreturn]] void fail(const std::string& reason, const std::string& remedy = {}) {
  throw Error(ErrorCode::output, "charts cannot be drawn: " + reason, remedy);
}

/// A file in memory, without a name: unlike a pipe it is never full.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("leafhull-chart", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail(std::strerror(errno));
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }

  void write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t count = ::write(descriptor_, text.data(), text.size());
      if (count < 0 && errno != EINTR) fail(std::strerror(errno));
      if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
    }
    ::lseek(descriptor_, 0, SEEK_SET);
  }

  std::string read() const {
    std::string text(static_cast<std::size_t>(::lseek(descriptor_, 0, SEEK_END)), '\0');
    std::size_t done = 0;
    while (done < text.size()) {
      const auto at = static_cast<off_t>(done);
      const ssize_t count = ::pread(descriptor_, &text[done], text.size() - done, at);
      if (count < 0 && errno != EINTR) fail(std::strerror(errno));
      if (count > 0) done += static_cast<std::size_t>(count);
    }
    return text;
  }

 private:
  int descriptor_;
};

/// The process, once it runs; its standard streams are the three files.
pid_t start(const std::array<const MemoryFile*, 3>& streams) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (int i = 0; i < 3; ++i) {
    ::posix_spawn_file_actions_adddup2(&actions, streams[i]->descriptor(), i);
  }
  std::array<std::string, 2> words{"gnuplot", "-d"};
  std::string locale = "LC_ALL=C.UTF-8";
  const std::array<char*, 3> arguments{words[0].data(), words[1].data(), nullptr};
  const std::array<char*, 2> environment{locale.data(), nullptr};
  pid_t process = 0;
  const int reason = ::posix_spawnp(&process, words[0].c_str(), &actions, nullptr, arguments.data(),
                                    environment.data());
  ::posix_spawn_file_actions_destroy(&actions);
  if (reason != 0) {
    fail(std::string("gnuplot does not start (") + std::strerror(reason) + ")",
         "Install gnuplot 5 where PATH finds it; on Debian: apt-get install gnuplot-nox");
  }
  return process;
}

std::string one_line(std::string text) {
  for (char& c : text) c = c == '\n' || c == '\t' ? ' ' : c;
  while (text.find("  ") != std::string::npos) text.erase(text.find("  "), 1);
  return text;
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const MemoryFile input, output, messages;
  input.write(script);
  const pid_t process = start({&input, &output, &messages});
  int status = 0;
  while (::waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) fail(std::strerror(errno));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    fail("gnuplot says" + one_line(' ' + messages.read()));
  }
  return output.read();
}

}  // namespace leafhull
