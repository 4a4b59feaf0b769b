// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "output_sample.h"

namespace leafhull::test {

/// Expects the Khronos validator to find neither errors nor warnings; its output goes to `log`.
/// Skips the test with a message if the validator is missing, so call it last.
inline void expect_valid_gltf(const std::vector<std::filesystem::path>& files,
                              const std::filesystem::path& log) {
  std::string command = "'" LEAFHULL_NODE "' '" LEAFHULL_VALIDATE_GLB "' '" LEAFHULL_VALIDATOR "'";
  for (const std::filesystem::path& file : files) command += " '" + file.string() + "'";
  const int status = std::system((command + " >'" + log.string() + "' 2>&1").c_str());
  const std::string said = read_file(log);
  if (WEXITSTATUS(status) == 77 || WEXITSTATUS(status) == 127) {
    GTEST_SKIP() << "NOT CHECKED against the Khronos validator; to have it: "
                    "cmake --build BUILD --target test_packages (needs Node.js and npm)\n"
                 << said;
  }
  EXPECT_EQ(WEXITSTATUS(status), 0) << said;
}

}  // namespace leafhull::test
