// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "leafhull/study.h"

namespace leafhull {

/// Data for the three methods: a still picture, its label and the mesh that web/viewer.js shows.
nlohmann::json shapes_data(const TreeStudy& tree);

/// A contact sheet, or false if there are no pictures.
nlohmann::json sheet_data(const std::vector<LabelledPicture>& pictures, const std::string& tree);

nlohmann::json plot_data(const std::string& svg, const std::string& alt);

}  // namespace leafhull
