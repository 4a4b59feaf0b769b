// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "chart/chart.h"
#include "leafhull/sweep.h"
#include "runs/sealed_json.h"

namespace leafhull {

/// A chart and the file it goes to.
struct Plot {
  std::string file;
  Chart chart;
};

/// Charts of dilated voxels and off-site vertices over every swept number: a line for each
/// combination of the other swept options, or for some where there are more than a dozen, as the
/// title then says. Source: Figures 11, 13 and 15.
std::vector<Plot> plots(const SweepPlan& plan, const std::map<std::size_t, Json>& rows,
                        std::string_view tree);

/// The files that `plots` would name.
std::vector<std::string> plot_files(const SweepPlan& plan);

}  // namespace leafhull
