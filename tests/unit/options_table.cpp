// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "leafhull/options.h"

namespace leafhull {
namespace {

const OptionRow& row(std::string_view name) {
  for (const OptionRow& row : option_table()) {
    if (row.name == name) return row;
  }
  throw std::out_of_range(std::string(name));
}

TEST(OptionTable, HasEveryOptionOnce) {
  const std::set<std::string_view> expected = {"leaves",
                                               "ellipse",
                                               "leaf-scale",
                                               "style",
                                               "method",
                                               "threshold",
                                               "coverage",
                                               "radius-max",
                                               "radius-unit",
                                               "threshold-percent",
                                               "flatness",
                                               "falloff",
                                               "spread",
                                               "density",
                                               "band-low",
                                               "band-high",
                                               "min-component",
                                               "preset",
                                               "resolution",
                                               "voxel-size",
                                               "dense",
                                               "snap",
                                               "mesher",
                                               "adaptivity",
                                               "hollows",
                                               "points",
                                               "point-spacing",
                                               "band-low-percent",
                                               "band-high-percent",
                                               "erosion",
                                               "dilation",
                                               "not-leaves",
                                               "leaves-colour",
                                               "leaf-colour",
                                               "up",
                                               "allow-outside"};
  std::set<std::string_view> found;
  for (const OptionRow& row : option_table()) {
    EXPECT_TRUE(found.insert(row.name).second) << row.name << " stands twice";
    EXPECT_FALSE(row.help.empty() || row.group.empty() || row.default_value.empty()) << row.name;
  }
  EXPECT_EQ(found, expected);
}

TEST(OptionTable, GroupsAreContiguous) {
  std::set<std::string_view> closed;
  std::string_view group;
  for (const OptionRow& row : option_table()) {
    if (row.group == group) continue;
    EXPECT_TRUE(closed.insert(row.group).second) << row.group;
    group = row.group;
  }
}

TEST(OptionTable, DefaultsAreThoseOfOptions) {
  const Options defaults;
  for (const OptionRow& row : option_table()) {
    std::visit(
        [&](auto member) {
          using Value = std::remove_cvref_t<decltype(defaults.*member)>;
          if constexpr (std::is_enum_v<Value>) {
            EXPECT_EQ(row.default_value, name(defaults.*member)) << row.name;
          } else if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>) {
            EXPECT_EQ(std::stod(std::string(row.default_value)), defaults.*member) << row.name;
          }
        },
        row.member);
  }
  EXPECT_EQ(row("preset").default_value, name(*resolve({}).preset));
}

TEST(OptionTable, RangesOfEnumerationsAreTheirNames) {
  EXPECT_EQ(row("style").range,
            "painterly, thin, fat, previous, paper-thin, paper-fat, paper-previous");
  EXPECT_EQ(row("method").range, "isotropic, uncontrolled, controlled");
  EXPECT_EQ(row("radius-unit").range, "crown, leaf, model");
  EXPECT_EQ(row("spread").range, "stddev, variance");
  EXPECT_EQ(row("density").range, "exact, grid");
  EXPECT_EQ(row("hollows").range, "fill, keep");
  EXPECT_EQ(row("preset").range,
            "paper-32, paper-64, paper-128, draft, standard, fine, ultra, film");
}

TEST(OptionTable, MembersAreTheNamedOnes) {
  EXPECT_EQ(std::get<std::optional<double> Options::*>(row("coverage").member), &Options::coverage);
  EXPECT_EQ(std::get<std::optional<double> Options::*>(row("threshold-percent").member),
            &Options::threshold_percent);
  EXPECT_EQ(std::get<std::optional<double> Options::*>(row("voxel-size").member),
            &Options::voxel_size);
  EXPECT_EQ(std::get<std::optional<double> Options::*>(row("band-low").member), &Options::band_low);
  EXPECT_EQ(std::get<std::optional<double> Options::*>(row("band-high").member),
            &Options::band_high);
  EXPECT_EQ(std::get<double Options::*>(row("leaf-scale").member), &Options::leaf_scale);
  EXPECT_EQ(std::get<bool Options::*>(row("dense").member), &Options::dense);
  EXPECT_EQ(std::get<bool Options::*>(row("snap").member), &Options::snap);
}

TEST(Names, FollowTheEnumerations) {
  EXPECT_EQ(name(Style::paper_previous), "paper-previous");
  EXPECT_EQ(name(Method::uncontrolled), "uncontrolled");
  EXPECT_EQ(name(RadiusUnit::model), "model");
  EXPECT_EQ(name(Spread::variance), "variance");
  EXPECT_EQ(name(Mesher::bricks), "bricks");
  EXPECT_EQ(name(DensitySource::grid), "grid");
  EXPECT_EQ(name(Preset::paper_128), "paper-128");
  EXPECT_EQ(name(Preset::film), "film");
  EXPECT_EQ(name(Up::y), "y");
  EXPECT_EQ(name(Up::z), "z");
  EXPECT_EQ(name(Hollows::fill), "fill");
  EXPECT_EQ(name(Hollows::keep), "keep");
}

}  // namespace
}  // namespace leafhull
