// SPDX-License-Identifier: Apache-2.0
#include "process/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

namespace leafhull {
namespace {

/// Duplicates of descriptors, numbered above all those that they will become.
class OutOfTheWay {
 public:
  explicit OutOfTheWay(const std::vector<int>& files) {
    for (const int file : files) {
      copies_.push_back(::fcntl(file, F_DUPFD_CLOEXEC, static_cast<int>(files.size())));
    }
  }
  ~OutOfTheWay() {
    for (const int copy : copies_) ::close(copy);
  }
  OutOfTheWay(const OutOfTheWay&) = delete;
  OutOfTheWay& operator=(const OutOfTheWay&) = delete;

  int operator[](std::size_t i) const { return copies_[i]; }

 private:
  std::vector<int> copies_;
};

}  // namespace

bool finds_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path program = std::filesystem::path(folder) / name;
    std::error_code missing;
    if (std::filesystem::is_regular_file(program, missing) &&
        ::access(program.c_str(), X_OK) == 0) {
      return true;
    }
  }
  return false;
}

Process::Process(std::vector<std::string> words, const std::vector<int>& files) {
  const OutOfTheWay sources(files);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (std::size_t i = 0; i < files.size(); ++i) {
    ::posix_spawn_file_actions_adddup2(&actions, sources[i], static_cast<int>(i));
  }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::string locale = "LC_ALL=C.UTF-8";
  const std::array<char*, 2> environment{locale.data(), nullptr};
  const int reason = ::posix_spawnp(&id_, words.front().c_str(), &actions, nullptr,
                                    arguments.data(), environment.data());
  ::posix_spawn_file_actions_destroy(&actions);
  if (reason != 0) throw std::system_error(reason, std::generic_category());
}

Process::~Process() {
  if (id_ == 0) return;
  ::kill(id_, SIGKILL);
  ::waitpid(id_, nullptr, 0);
}

bool Process::wait() {
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category());
  }
  id_ = 0;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  while (text.find("  ") != std::string::npos) text.erase(text.find("  "), 1);
  return text;
}

}  // namespace leafhull
