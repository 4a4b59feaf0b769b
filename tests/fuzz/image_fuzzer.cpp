// SPDX-License-Identifier: Apache-2.0
// Any bytes give either an image or a reason of one line.
#include <cstddef>
#include <cstdint>
#include <string>

#include "input/images.h"
#include "promises.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace leafhull::fuzz;
  for (const char* name : {"x.tga", "x.png"}) {  // only the name marks a TGA
    std::string reason;
    const leafhull::Image image = leafhull::decode_image({data, size}, name, reason);
    check(image);
    require(image.empty() != reason.empty());
    require_one_line(reason);
  }
  return 0;
}
