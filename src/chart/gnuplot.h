// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace leafhull {

/// The output of gnuplot for a script. Gnuplot ignores the user's settings and locale.
/// @throws Error output: gnuplot is missing, or says why it fails.
std::string run_gnuplot(const std::string& script);

}  // namespace leafhull
