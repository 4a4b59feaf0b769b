// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "leafhull/shape.h"
#include "study/study_plan.h"

namespace leafhull {

/// Fills in the metrics of a plan's rows; calls `each` with the report of every extraction.
/// @throws Error as extract does, except for an empty surface.
void measure(const Plan& plan, const LeafSet& leaves, Device& device,
             const std::function<void(const Report&)>& each);

}  // namespace leafhull
