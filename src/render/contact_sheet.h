// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "leafhull/picture.h"

namespace leafhull::render {

struct SheetSize {
  int width = 0, height = 0;
};

/// The size of contact_sheet()'s picture; of the pictures' pixels nothing is read.
SheetSize contact_sheet_size(std::string_view title, std::span<const LabelledPicture> pictures,
                             int columns);

}  // namespace leafhull::render
