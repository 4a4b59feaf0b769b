// SPDX-License-Identifier: Apache-2.0
#include "runs/identity.h"

#include "runs/checksum.h"

namespace leafhull {

std::string checksum_of(const LeafSet& leaves) {
  std::string bytes;
  for (const LeafVertex& leaf : leaves.vertices) {
    add_bytes(bytes, leaf.position, leaf.normal, leaf.major, leaf.radius_major, leaf.radius_minor);
  }
  return record_of(bytes).sha256;
}

}  // namespace leafhull
