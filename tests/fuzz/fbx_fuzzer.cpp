// SPDX-License-Identifier: Apache-2.0
// As gltf_fuzzer.cpp, for FBX. Images inside the file are read, others are not.
#include <cstddef>
#include <cstdint>

#include "input/fbx.h"
#include "promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using leafhull::Axes;
  return leafhull::fuzz::read_or_refuse([&] {
    const Axes axes = size % 2 == 0 ? Axes::as_it_says : Axes::as_they_are;
    leafhull::fuzz::check(leafhull::read_fbx({data, size}, "fuzz", {}, axes));
  });
}
