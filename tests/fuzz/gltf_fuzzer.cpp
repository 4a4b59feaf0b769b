// SPDX-License-Identifier: Apache-2.0
// Any bytes are either a tree that keeps what tree.h promises, or an Error input.
#include <cstddef>
#include <cstdint>

#include "input/gltf.h"
#include "promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return leafhull::fuzz::read_or_refuse([&] {
    leafhull::fuzz::check(leafhull::read_gltf({data, size}, "fuzz", {}));
  });
}
