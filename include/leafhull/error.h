// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "leafhull/api.h"

namespace leafhull {

/// The kind of failure; the value is the command's exit code.
enum class ErrorCode {
  internal = 1,  ///< a defect of leafhull
  usage = 2,     ///< an option or a combination of options that makes no sense
  input = 3,     ///< a file that cannot be read, or that holds no usable leaves
  device = 4,    ///< no OpenCL device, or a kernel that does not build
  output = 5,    ///< a result that could not be written
  empty = 6,     ///< the surface is empty
};

/// The one exception of the library: what happened and where (`what`), and what to do (`remedy`).
class LEAFHULL_API Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message, std::string remedy = {})
      : std::runtime_error(message), code_(code), remedy_(std::move(remedy)) {}

  ErrorCode code() const { return code_; }
  /// One sentence that says what to do; it may be empty.
  const std::string& remedy() const { return remedy_; }

 private:
  ErrorCode code_;
  std::string remedy_;
};

}  // namespace leafhull
