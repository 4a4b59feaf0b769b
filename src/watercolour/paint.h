// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "leafhull/device.h"
#include "leafhull/picture.h"
#include "render/buffers.h"
#include "watercolour/strokes.h"
#include "watercolour/style.h"

namespace leafhull::watercolour {

/// Paints watercolours. Kernels stay built, and paper and planes are kept between pictures of one
/// size.
class Painter {
 public:
  explicit Painter(Device& device);
  ~Painter();
  Painter(Painter&&) noexcept;

  /// Paints what `buffers` show. Lengths in the style scale with the picture's height.
  /// @throws Error usage: no pixels, or more than the device's memory holds; device: a kernel that
  /// does not build, a failing driver.
  Picture paint(const render::Buffers& buffers, const Leaves& leaves, const Style& style);

  /// Bytes of device memory: memory() is what it holds, memory_of() the most a picture needs.
  std::size_t memory() const;
  static std::size_t memory_of(int width, int height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace leafhull::watercolour
