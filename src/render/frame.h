// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/picture.h"

namespace leafhull::render {

/// The box of a frame's points, grown by their reach.
Box box_of(const Frame& frame);

}  // namespace leafhull::render
