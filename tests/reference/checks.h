// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "density.h"
#include "ply.h"
#include "table.h"

namespace recount {

/// The files of one extraction.
struct Extraction {
  nlohmann::json report;
  Ply kernels;
  std::optional<Ply> mesh;
  std::optional<Ply> leaf_kernels;  ///< from an `uncontrolled` run, for R_u and R_v

  const nlohmann::json& parameter(const std::string& name) const {
    return report.at("parameters").at(name);
  }
  /// Whether kernels represent leaf area instead of leaf vertices.
  bool by_area() const { return word("points") == "area"; }
  double number(const std::string& name) const { return parameter(name).get<double>(); }
  std::string word(const std::string& name) const { return parameter(name).get<std::string>(); }
};

/// Checks frames, lengths, N_iso, its statistics and the radii of Eq. (8).
void check_kernels(const Extraction& extraction, Table& table);

/// Checks the threshold, the voxels, the off-site vertices and, if there is one, the mesh.
void check_shape(const Extraction& extraction, Table& table);

}  // namespace recount
