// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "leafhull/shape.h"
#include "study/study_plan.h"

namespace leafhull {

/// Fills in the metrics of a plan's rows; `each` is told of every extraction.
/// @throws Error as extract does, but for an empty surface.
void measure(const Plan& plan, const LeafSet& leaves, Device& device,
             const std::function<void(const Report&)>& each);

}  // namespace leafhull
