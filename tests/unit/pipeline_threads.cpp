// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "leafhull/device.h"

namespace leafhull {
namespace {

std::size_t most_threads() {
  return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

TEST(ThreadLimit, BoundsForAsLongAsItLives) {
  const std::size_t before = most_threads();
  {
    const ThreadLimit none(0);
    EXPECT_EQ(most_threads(), before);
    const ThreadLimit one(1);
    EXPECT_EQ(most_threads(), 1u);
    const ThreadLimit more(4);
    EXPECT_EQ(most_threads(), 1u) << "the least counts";
  }
  EXPECT_EQ(most_threads(), before);
}

}  // namespace
}  // namespace leafhull
