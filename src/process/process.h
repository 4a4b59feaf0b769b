// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace leafhull {

/// Whether PATH finds a program of that name.
bool finds_program(const std::string& name);

/// A running program that PATH found. It ignores the user's locale, and is killed with the object
/// unless it has been waited for.
class Process {
 public:
  /// @param words the program's name, then its arguments.
  /// @param files descriptors that become its own 0, 1, 2, ..., which begin with its standard
  ///        streams.
  /// @throws std::system_error where it does not start.
  Process(std::vector<std::string> words, const std::vector<int>& files);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits until it ends. Returns whether it reports success.
  /// @throws std::system_error.
  bool wait();

 private:
  pid_t id_ = 0;
};

/// Text for a message of one line.
std::string one_line(std::string text);

}  // namespace leafhull
