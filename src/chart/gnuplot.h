// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace leafhull {

/// What gnuplot prints for a script. It reads no settings of the user's, and knows the locale of
/// nobody.
/// @throws Error output: gnuplot is missing, or says why it fails.
std::string run_gnuplot(const std::string& script);

}  // namespace leafhull
