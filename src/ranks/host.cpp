// SPDX-License-Identifier: Apache-2.0
#include "ranks/host.h"

#include <unistd.h>

#include <array>

namespace leafhull {

RankProcess this_process() {
  std::array<char, 256> host{};  // POSIX: at most 255 bytes
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  return {host.data(), getpid()};
}

}  // namespace leafhull
