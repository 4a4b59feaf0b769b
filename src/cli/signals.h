// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace leafhull::cli {

/// From here on a signal that ends the command first removes its unfinished files, and a full disk
/// or a closed pipe is an error of writing instead of a signal.
void catch_signals();

}  // namespace leafhull::cli
