// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/study.h"

namespace leafhull {

/// The outcome of claim 2b for a CTRLED between the ends of a band study.
Outcome intermediate(const BandStudy& band, const StudyRow& controlled);

}  // namespace leafhull
