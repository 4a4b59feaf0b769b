// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ufbx.h>

#include <string>

namespace leafhull {

inline std::string text_of(const ufbx_string& text) { return {text.data, text.length}; }

}  // namespace leafhull
