// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "leafhull/render.h"

namespace leafhull {

/// "WIDTHxHEIGHT", as --size takes it.
std::string size_text(int width, int height);

/// @throws Error usage: a side out of range.
void check_sides(const PictureOptions& options);

/// @param kept bytes of the host's memory per pixel, besides those that drawing takes.
/// @throws Error usage, as check_picture.
void check_memory(const PictureOptions& options, const DeviceInfo* device, double kept);

/// Looks at what a picture would take, before any work is done. Without a device the host's memory
/// alone is asked.
/// @throws Error usage: a side out of range, or more memory than there is: how much is needed and
/// the largest size that fits.
void check_picture(const PictureOptions& options, const DeviceInfo* device = nullptr);

/// The same for what figure17() would take.
/// @throws Error usage, as check_picture; or a sheet that is too large for a PNG file.
void check_figure17(const PictureOptions& picture, const DeviceInfo* device = nullptr);

}  // namespace leafhull
