// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace leafhull::cli {

/// From here on a signal that ends the command first removes its unfinished files, and a full disk
/// or a closed pipe is an error of writing instead of a signal. `last_words` is a line that the
/// dying command says.
void catch_signals(std::string_view last_words = {});

/// The same with last words that are composed when they are needed: `say_last_words` is
/// async-signal-safe.
void catch_signals(void (*say_last_words)() noexcept);

}  // namespace leafhull::cli
