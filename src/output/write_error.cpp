// SPDX-License-Identifier: Apache-2.0
#include "output/write_error.h"

#include <cerrno>
#include <string>
#include <system_error>

namespace leafhull {
namespace {

std::string remedy_for(int reason) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
      return "Free some space there, or write to another disk.";
    case EFBIG:
      return "Raise the limit on file sizes (ulimit -f), or choose a lower resolution.";
    case EACCES:
    case EPERM:
    case EROFS:
      return "Change its permissions, or name a file in a folder that can be written to.";
    case ENAMETOOLONG:
      return "Choose a shorter name.";
    case EISDIR:
      return "Name a file in it.";
    case EPIPE:
      return "Keep the program that reads the output running until the end.";
    default:
      return "Check the disk, or write to another folder.";
  }
}

}  // namespace

Error write_error(const std::filesystem::path& file, int reason) {
  return {ErrorCode::output,
          "cannot write " + file.string() + ": " + std::generic_category().message(reason),
          remedy_for(reason)};
}

}  // namespace leafhull
