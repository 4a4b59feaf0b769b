// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "leafhull/device.h"
#include "leafhull/picture.h"
#include "render/buffers.h"
#include "watercolour/strokes.h"
#include "watercolour/style.h"

namespace leafhull::watercolour {

/// Paints watercolours. Its kernels are built, and its paper and planes kept, between pictures of
/// one size.
class Painter {
 public:
  explicit Painter(Device& device);
  ~Painter();
  Painter(Painter&&) noexcept;

  /// What `buffers` see, in watercolour. Lengths of the style scale with the picture's height.
  /// @throws Error usage: no pixels, or more than the device's memory holds; device: a kernel that
  /// does not build, a failing driver.
  Picture paint(const render::Buffers& buffers, const Leaves& leaves, const Style& style);

  /// Bytes of the device's memory that it holds, and that a picture needs at most.
  std::size_t memory() const;
  static std::size_t memory_of(int width, int height);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace leafhull::watercolour
