// SPDX-License-Identifier: Apache-2.0
#include "process/process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <system_error>

#include "process/memory_file.h"

namespace leafhull::test {
namespace {

/// Runs a shell script whose three standard streams and descriptor 3 are files.
struct Script {
  explicit Script(const std::string& script) {
    input.write("from the input\n");
    Process process({"sh", "-c", script}, {input.descriptor(), output.descriptor(),
                                           messages.descriptor(), fourth.descriptor()});
    good = process.wait();
  }
  MemoryFile input, output, messages, fourth;
  bool good = false;
};

TEST(Process, HasItsStreams) {
  const Script run("cat; echo problems >&2; echo more >&3");
  EXPECT_TRUE(run.good);
  EXPECT_EQ(run.output.read(), "from the input\n");
  EXPECT_EQ(run.messages.read(), "problems\n");
  EXPECT_EQ(run.fourth.read(), "more\n");
}

TEST(Process, SaysWhetherItDidItsWork) {
  EXPECT_FALSE(Script("exit 3").good);
  EXPECT_FALSE(Script("kill -TERM $$").good);
  EXPECT_THROW(Process({"no-such-program"}, {0, 1, 2}), std::system_error);
}

TEST(Process, KnowsNobodysSettings) {
  setenv("LEAFHULL_SECRET", "1", 1);
  const Script run("echo $LEAFHULL_SECRET$LC_ALL");
  EXPECT_EQ(run.output.read(), "C.UTF-8\n");
}

TEST(Process, TakesFilesInAnyOrder) {
  const MemoryFile a, b;  // take the lowest free descriptors, which the program's may overlap
  Process process({"sh", "-c", "echo third >&3; echo fourth >&4; echo fifth >&5"},
                  {0, 1, 2, b.descriptor(), a.descriptor(), b.descriptor()});
  EXPECT_TRUE(process.wait());
  EXPECT_EQ(a.read(), "fourth\n");
  EXPECT_EQ(b.read(), "third\nfifth\n");
}

TEST(Process, EndsWithItsObject) {
  const auto begin = std::chrono::steady_clock::now();
  { const Process process({"sleep", "60"}, {0, 1, 2}); }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(Programs, AreOnThePath) {
  EXPECT_TRUE(finds_program("sh"));
  EXPECT_FALSE(finds_program("no-such-program"));
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  EXPECT_FALSE(finds_program("sh"));
  unsetenv("PATH");
  EXPECT_FALSE(finds_program("sh"));
  setenv("PATH", path.c_str(), 1);
}

TEST(OneLine, HasNoBreaks) { EXPECT_EQ(one_line("a\nb\t\tc  d\r\n"), "a b c d "); }

}  // namespace
}  // namespace leafhull::test
