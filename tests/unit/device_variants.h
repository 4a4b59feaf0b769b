// SPDX-License-Identifier: Apache-2.0
// Runs tests on both variants of the kernels, for every falloff.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "leafhull/shape.h"

namespace leafhull::test {

inline Device& device(const std::string& variant) {
  static Device vector({.choice = "", .threads = 0, .variant = "vector"});
  static Device work_item({.choice = "", .threads = 0, .variant = "work-item"});
  return variant == "vector" ? vector : work_item;
}

class VariantTest : public testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  Device& chosen() { return device(std::get<0>(GetParam())); }
  int falloff() { return std::get<1>(GetParam()); }
};

inline std::string name_of(const testing::TestParamInfo<VariantTest::ParamType>& test) {
  const bool vector = std::string(std::get<0>(test.param)) == "vector";
  return (vector ? "VectorK" : "WorkItemK") + std::to_string(std::get<1>(test.param));
}

}  // namespace leafhull::test
