// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/study.h"

namespace leafhull::test {

/// A hand-made study of two trees under two readings, with a claim of every outcome, a method
/// without a surface and a second tree whose name is markup.
Study sample_study();

inline constexpr const char* kMarkup = "<script>alert(\"1\")</script> & 'ash'";

}  // namespace leafhull::test
