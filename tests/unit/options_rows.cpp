// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <stdexcept>
#include <string>

#include "leafhull/device.h"
#include "leafhull/error.h"
#include "leafhull/forest.h"
#include "leafhull/output.h"
#include "leafhull/render.h"
#include "leafhull/scene.h"

namespace leafhull {
namespace {

template <class Rows>
const OptionLine& line_of(const Rows& rows, std::string_view name) {
  for (const OptionLine& line : rows) {
    if (line.name == name) return line;
  }
  throw std::out_of_range(std::string(name));
}

template <class Rows>
void expect_complete(const Rows& rows) {
  std::set<std::string_view> names;
  for (const OptionLine& line : rows) {
    SCOPED_TRACE(line.name);
    EXPECT_TRUE(names.insert(line.name).second) << "it stands twice";
    EXPECT_FALSE(line.group.empty() || line.help.empty() || line.default_value.empty());
    EXPECT_TRUE(line.spelling.ends_with("--" + std::string(line.name)));
  }
}

TEST(OptionRows, TellAllOfEachOption) {
  expect_complete(forest_table());
  expect_complete(scatter_table());
  expect_complete(render_table());
  expect_complete(device_table());
  expect_complete(output_table());
}

TEST(OptionRows, NumbersMakeTheRange) {
  EXPECT_EQ(line_of(forest_table(), "levels").range, "[1, 8]");
  EXPECT_EQ(line_of(forest_table(), "tile").range, "32 to 512, a multiple of 32");
  EXPECT_EQ(line_of(forest_table(), "memory").range, ">= 512M");
  EXPECT_EQ(line_of(scatter_table(), "seed").range, "[0, 2147483647]");
  EXPECT_EQ(line_of(render_table(), "detail").range, "[0, 1]");
  EXPECT_EQ(line_of(option_table(), "falloff").range, "1, 2, 3");
  EXPECT_EQ(line_of(option_table(), "erosion").range, "(0, 1)");
  EXPECT_EQ(line_of(option_table(), "coverage").range, "(0, 1]");
  EXPECT_EQ(line_of(option_table(), "radius-max").range, "> 0");
  EXPECT_EQ(line_of(option_table(), "band-low").range, "any number");
}

TEST(OptionRows, NamesMakeTheRange) {
  EXPECT_EQ(line_of(forest_table(), "merge").range, "none, canopy");
  EXPECT_EQ(line_of(device_table(), "variant").range, "vector, work-item");
  EXPECT_EQ(line_of(render_table(), "as").range, "tree, shape");
}

TEST(OptionRows, AStructMakesTheDefaults) {
  EXPECT_EQ(line_of(forest_table(), "memory").default_value, "4G");
  EXPECT_EQ(line_of(forest_table(), "levels").default_value, "1");
  EXPECT_EQ(line_of(forest_table(), "merge").default_value, "canopy");
  EXPECT_EQ(line_of(forest_table(), "resume").default_value, "off");
  EXPECT_EQ(line_of(scatter_table(), "spacing").default_value, "0.8");
  EXPECT_EQ(line_of(render_table(), "camera").default_value, "three-quarter");
  EXPECT_EQ(line_of(output_table(), "save-field").default_value, "none");
}

TEST(OptionRows, SpellTheFlags) {
  EXPECT_EQ(line_of(output_table(), "output").spelling, "-o,--output");
  EXPECT_TRUE(line_of(output_table(), "output").repeatable);
  EXPECT_EQ(line_of(option_table(), "snap").spelling, "--no-snap");
  EXPECT_EQ(line_of(option_table(), "dense").spelling, "--dense");
  EXPECT_EQ(line_of(forest_table(), "tile-range").value, "I/N");
  EXPECT_EQ(line_of(render_table(), "figure17").value, "") << "a flag that a word may follow";
}

/// The usage error that `change` of the options causes; empty if they are accepted.
std::string forest_refusal(const std::function<void(ForestOptions&)>& change) {
  ForestOptions options;
  change(options);
  try {
    check_forest(options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_FALSE(error.remedy().empty());
    return std::string(error.what()) + ". " + error.remedy();
  }
  return {};
}

TEST(ForestOptions, BoundsOfTheTableAreKept) {
  for (const int levels : {1, 8}) {
    EXPECT_EQ(forest_refusal([=](auto& o) { o.levels = levels; }), "");
  }
  for (const int levels : {-1, 0, 9}) {
    EXPECT_EQ(forest_refusal([=](auto& o) { o.levels = levels; }),
              "--levels " + std::to_string(levels) + " is out of range. Its range is [1, 8].");
  }
  for (const int tile : {32, 96, 512}) {
    EXPECT_EQ(forest_refusal([=](auto& o) { o.tile = tile; }), "");
  }
  EXPECT_EQ(forest_refusal([](auto& o) { o.tile = 100; }),
            "--tile 100 is not a multiple of 32. Give 96 or 128.");
  EXPECT_NE(forest_refusal([](auto& o) { o.tile = 544; }), "");
  EXPECT_NE(forest_refusal([](auto& o) { o.memory = {1 << 20}; }), "");
  EXPECT_EQ(forest_refusal([](auto& o) { o.memory = {512 << 20}; }), "");
  EXPECT_EQ(forest_refusal([](auto& o) { o.range = {4, 4}; }), "");
  EXPECT_NE(forest_refusal([](auto& o) {
              o.range = {5, 4};
            }).find("give 1/4 to 4/4"),
            std::string::npos);
  EXPECT_NE(forest_refusal([](auto& o) { o.range = {0, 4}; }), "");
  EXPECT_NE(forest_refusal([](auto& o) { o.range = {1, 1'000'001}; }), "");
  EXPECT_NE(forest_refusal([](auto& o) { o.merge = Merge(7); }).find("none, canopy"),
            std::string::npos);
  EXPECT_NE(forest_refusal([](auto& o) { o.shape.coverage = 2; }).find("--coverage 2"),
            std::string::npos);
}

TEST(ForestOptions, ContradictionsAreTheLibrarys) {
  EXPECT_NE(forest_refusal([](auto& o) {
              o.resume = o.restart = true;
            }).find("--resume and --restart contradict each other"),
            std::string::npos);
  const auto apart = [](auto change) {
    return forest_refusal([=](ForestOptions& o) {
      o.merge = Merge::none;
      change(o);
    });
  };
  EXPECT_EQ(apart([](ForestOptions&) {}), "");
  EXPECT_NE(apart([](ForestOptions& o) { o.tile = 64; }), "");
  EXPECT_NE(apart([](ForestOptions& o) { o.levels = 2; }), "");
  EXPECT_NE(apart([](ForestOptions& o) { o.control_scope = ControlScope::scene; }), "");
  EXPECT_NE(forest_refusal([](auto& o) { o.shape.hollows = Hollows::fill; }), "");
  EXPECT_EQ(apart([](ForestOptions& o) { o.shape.hollows = Hollows::fill; }), "");
}

TEST(RenderOptions, AreCheckedBeforeAnyWork) {
  const auto refusal = [](auto change) -> std::string {
    RenderOptions options;
    options.files = {"picture.png"};
    change(options);
    try {
      plan_pictures(options, "tree.glb");
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(refusal([](RenderOptions&) {}), "");
  EXPECT_EQ(refusal([](auto& o) { o.detail = 2; }), "--detail 2 is out of range");
  EXPECT_EQ(refusal([](auto& o) { o.frames = 0; }), "--turntable 0 is out of range");
  EXPECT_EQ(refusal([](auto& o) { o.camera_name = "frnt"; }), "--camera 'frnt' is unknown");
  EXPECT_NE(refusal([](auto& o) {
              o.figure17 = Plate::own, o.frames = 3;
            }).find("--figure17 and --turntable"),
            std::string::npos);
  RenderOptions options;
  options.files = {"picture.png"};
  options.camera_name = "top";
  const PicturePlan plan = plan_pictures(options, "tree.glb");
  EXPECT_EQ(std::get<Viewpoint>(plan.picture.camera), Viewpoint::top);
}

}  // namespace
}  // namespace leafhull
