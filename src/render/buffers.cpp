// SPDX-License-Identifier: Apache-2.0
#include "render/buffers.h"

namespace leafhull::render {

void Buffers::resize(int new_width, int new_height) {
  width = new_width, height = new_height;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  object.assign(pixels, Object::paper);
  foliage.assign(pixels, 0), wood.assign(pixels, 0);
  depth.assign(pixels, HUGE_VALF);
  normal.assign(pixels, {}), position.assign(pixels, {}), color.assign(pixels, {});
  key.assign(pixels, 1), open.assign(pixels, 1);
  edges.clear(), samples.clear();
}

}  // namespace leafhull::render
