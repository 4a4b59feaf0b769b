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

}  // namespace leafhull
