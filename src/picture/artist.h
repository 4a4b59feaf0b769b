// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "leafhull/render.h"
#include "render/buffers.h"
#include "render/camera.h"
#include "watercolour/paint.h"

namespace leafhull {

struct Rendering::Buffers : render::Buffers {};

/// Draws pictures one after the other and keeps the data that they share.
class Artist {
 public:
  /// `device` must outlive the artist.
  explicit Artist(Device& device) : device_(device) {}

  /// As leafhull::draw, for options that are already checked.
  Rendering draw(const Subject& subject, const PictureOptions& options,
                 const Progress& progress = {});

 private:
  Picture shade(const Subject::Parts& parts, const render::Buffers& buffers,
                const render::Camera& camera, const PictureOptions& options);

  Device& device_;
  std::optional<watercolour::Painter> painter_;
};

/// Where a picture is taken from, in the subject's scene.
render::Camera camera_of(const Subject::Parts& parts, const PictureOptions& options);

/// The leaves in front of the camera, including hidden ones.
std::vector<watercolour::Stroke> strokes_of(const Subject::Parts& parts,
                                            const render::Camera& camera, int width, int height);

}  // namespace leafhull
