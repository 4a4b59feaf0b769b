// SPDX-License-Identifier: Apache-2.0
// Any bytes give either a tree that keeps the promises of tree.h, or an Error input.
#include <cstddef>
#include <cstdint>

#include "input/gltf.h"
#include "promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return leafhull::fuzz::read_or_refuse([&] {
    leafhull::fuzz::check(leafhull::read_gltf({data, size}, "fuzz", {}));
  });
}
