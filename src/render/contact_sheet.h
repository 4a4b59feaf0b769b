// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "leafhull/picture.h"

namespace leafhull::render {

struct SheetSize {
  int width = 0, height = 0;
};

/// The size of the picture that contact_sheet() makes; reads no pixels of the pictures.
SheetSize contact_sheet_size(std::string_view title, std::span<const LabelledPicture> pictures,
                             int columns);

}  // namespace leafhull::render
