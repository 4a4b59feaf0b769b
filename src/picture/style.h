// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/render.h"
#include "watercolour/style.h"

namespace leafhull {

struct WatercolourStyle::Keys : watercolour::Style {};

}  // namespace leafhull
