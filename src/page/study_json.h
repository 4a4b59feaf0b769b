// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "leafhull/study.h"

namespace leafhull {

/// A study without its pictures and meshes as one JSON object, schema "leafhull-study/1".
std::string study_json(const Study& study);

}  // namespace leafhull
