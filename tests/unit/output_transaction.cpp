// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "leafhull/error.h"
#include "leafhull/output.h"
#include "output/file_stream.h"
#include "output/transaction.h"
#include "output_sample.h"

namespace leafhull::test {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

void write_text(Transaction& transaction, const fs::path& file, const std::string& text) {
  transaction.write(file, [&](std::ostream& stream) { stream << text; });
}

TEST(Transaction, ShowsNothingBeforeItsCommit) {
  const TemporaryFolder folder;
  Transaction transaction;
  write_text(transaction, folder / "a", "one");
  write_text(transaction, folder / "b", "two");
  for (const std::string& name : folder.names()) {
    EXPECT_TRUE(name.starts_with(".") && name.ends_with(".tmp")) << name;
    EXPECT_NE(name.find(std::to_string(::getpid())), std::string::npos) << name;
  }
  transaction.commit();
  EXPECT_EQ(folder.names(), (Names{"a", "b"}));
  EXPECT_EQ(read_file(folder / "a"), "one");
  EXPECT_EQ(read_file(folder / "b"), "two");
}

TEST(Transaction, LeavesNothingWithoutACommit) {
  const TemporaryFolder folder;
  write_file(folder / "old", "old");
  {
    Transaction transaction;
    write_text(transaction, folder / "old", "new");
    EXPECT_THROW(transaction.write(folder / "b",
                                   [](std::ostream& stream) {
                                     stream << "half";
                                     throw std::runtime_error("broken");
                                   }),
                 std::runtime_error);
  }
  EXPECT_EQ(folder.names(), Names{"old"});
  EXPECT_EQ(read_file(folder / "old"), "old");
}

// The last rename fails because its temporary file is gone; all files are complete by then.
TEST(Transaction, PutsBackWhatItHadReplaced) {
  const TemporaryFolder folder;
  write_file(folder / "old", "old");
  try {
    Transaction transaction;
    write_text(transaction, folder / "old", "new");
    write_text(transaction, folder / "fresh", "new");
    write_text(transaction, folder / "last", "new");
    for (const std::string& name : folder.names()) {
      if (name.starts_with(".last.")) fs::remove(folder / name);
    }
    transaction.commit();
    FAIL() << "committed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output);
    EXPECT_NE(std::string(error.what()).find("last"), std::string::npos) << error.what();
  }
  EXPECT_EQ(folder.names(), Names{"old"});
  EXPECT_EQ(read_file(folder / "old"), "old");
}

TEST(Transaction, KeepsPermissions) {
  const TemporaryFolder folder;
  write_file(folder / "old", "old");
  fs::permissions(folder / "old", fs::perms(0640));
  const mode_t umask = ::umask(0022);
  Transaction transaction;
  write_text(transaction, folder / "old", "new");
  write_text(transaction, folder / "fresh", "new");
  transaction.commit();
  ::umask(umask);
  EXPECT_EQ(read_file(folder / "old"), "new");
  EXPECT_EQ(fs::status(folder / "old").permissions(), fs::perms(0640));
  EXPECT_EQ(fs::status(folder / "fresh").permissions(), fs::perms(0644));
}

TEST(Transaction, WritesThroughSymbolicLinks) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "far");
  write_file(folder / "far" / "old", "old");
  fs::create_symlink("far/old", folder / "link");
  fs::create_symlink("link", folder / "link to the link");
  fs::create_symlink("far/missing", folder / "dangling");
  Transaction transaction;
  write_text(transaction, folder / "link to the link", "new");
  write_text(transaction, folder / "dangling", "fresh");
  transaction.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_TRUE(fs::is_symlink(folder / "link to the link"));
  EXPECT_TRUE(fs::is_symlink(folder / "dangling"));
  EXPECT_EQ(read_file(folder / "far" / "old"), "new");
  EXPECT_EQ(read_file(folder / "far" / "missing"), "fresh");
}

TEST(Transaction, TakesTheLongestNames) {
  const TemporaryFolder folder;
  const std::string longest(255, 'n');
  Transaction transaction;
  write_text(transaction, folder / longest, "long");
  transaction.commit();
  EXPECT_EQ(folder.names(), Names{longest});
}

TEST(Transaction, IsDiscardedByAnInterrupt) {
  const TemporaryFolder folder;
  write_file(folder / "old", "old");
  Transaction transaction;
  write_text(transaction, folder / "old", "new");
  transaction.write(folder / "b", [&](std::ostream& stream) {
    stream << "half" << std::flush;
    EXPECT_EQ(folder.names().size(), 3u);
    discard_unfinished_outputs();
    EXPECT_EQ(folder.names(), Names{"old"});
  });
  EXPECT_THROW(transaction.commit(), Error);
  EXPECT_EQ(folder.names(), Names{"old"});
  EXPECT_EQ(read_file(folder / "old"), "old");
}

volatile std::sig_atomic_t interrupts = 0;

TEST(UninterruptedSection, HoldsBackSignalsAndDiscarding) {
  const TemporaryFolder folder;
  const TemporaryFile file(folder / "a");
  const auto previous = std::signal(SIGUSR1, [](int) { interrupts = interrupts + 1; });
  interrupts = 0;
  std::thread other;
  {
    const UninterruptedSection section;
    ::raise(SIGUSR1);
    other = std::thread(discard_unfinished_outputs);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(interrupts, 0);
    EXPECT_TRUE(fs::exists(file.path()));
  }
  other.join();
  std::signal(SIGUSR1, previous);
  EXPECT_EQ(interrupts, 1);
  EXPECT_FALSE(fs::exists(file.path()));
}

TEST(Transaction, RefusesMoreFilesThanItCanDiscard) {
  const TemporaryFolder folder;
  Transaction transaction;
  const auto write_many = [&] {
    for (int i = 0; i < 100; ++i) write_text(transaction, folder / std::to_string(i), "");
  };
  EXPECT_THROW(write_many(), Error);
}

/// The exit code and message of a write in a process whose files may not exceed 4 KiB.
std::string failure_with_small_files(const OutputFiles& files, const Shape& shape) {
  int channel[2];
  EXPECT_EQ(::pipe(channel), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::string message = "written";
    try {
      write_outputs(plan_outputs(files, "tree.glb"), shape, {});
    } catch (const Error& error) {
      message = std::to_string(static_cast<int>(error.code())) + " " + error.what();
    }
    const bool sent = ::write(channel[1], message.data(), message.size()) >= 0;
    ::_exit(sent ? 0 : 1);
  }
  ::close(channel[1]);
  std::string message(1000, '\0');
  message.resize(static_cast<std::size_t>(
      std::max<ssize_t>(0, ::read(channel[0], message.data(), message.size()))));
  ::close(channel[0]);
  ::waitpid(child, nullptr, 0);
  return message;
}

TEST(Outputs, AreAllWrittenOrNone) {
  const TemporaryFolder folder;
  write_file(folder / "kernels.ply", "old");
  const OutputFiles files{.shapes = {folder / "shape.glb", folder / "shape.obj"},
                          .kernels = folder / "kernels.ply",
                          .report = folder / "report.json"};
  // The GLB and the kernels would fit, but the OBJ does not.
  EXPECT_EQ(failure_with_small_files(files, sample_shape()),
            "5 cannot write " + (folder / "shape.obj").string() + ": File too large");
  EXPECT_EQ(folder.names(), Names{"kernels.ply"});
  EXPECT_EQ(read_file(folder / "kernels.ply"), "old");

  write_outputs(plan_outputs(files, "tree.glb"), sample_shape(), {});
  EXPECT_EQ(folder.names(), (Names{"kernels.ply", "report.json", "shape.glb", "shape.obj"}));
  EXPECT_NE(read_file(folder / "kernels.ply"), "old");
}

TEST(Outputs, FailOnEveryFormatThatDoesNotFit) {
  Shape shape = sample_shape();
  shape.mesh = sphere(20);
  for (const char* name : {"a.glb", "a.gltf", "a.obj", "a.ply", "a.stl", "a.vdb"}) {
    const TemporaryFolder folder;
    EXPECT_EQ(failure_with_small_files({.shapes = {folder / name}}, shape),
              "5 cannot write " + (folder / name).string() + ": File too large");
    EXPECT_TRUE(folder.names().empty());
  }
}

TEST(Outputs, RefuseWhatAShapeAloneLacks) {
  const TemporaryFolder folder;
  Shape shape = sample_shape();
  shape.report.detail = Detail::shape;
  shape.isotropic_density.clear();
  const auto write = [&](OutputFiles files) {
    files.shapes = {folder / "a.ply"};
    write_outputs(plan_outputs(files, "tree.glb"), shape, {});
  };
  EXPECT_THROW(write({.kernels = folder / "k.ply"}), Error);
  EXPECT_THROW(write({.report = folder / "r.json"}), Error);
  EXPECT_TRUE(folder.names().empty());
  write({});
  EXPECT_EQ(folder.names(), Names{"a.ply"});
}

TEST(Outputs, WriteTheReportToStandardOutput) {
  const TemporaryFolder folder;
  ::testing::internal::CaptureStdout();
  write_outputs(plan_outputs({.shapes = {folder / "a.stl"}, .report = "-"}, "tree.glb"),
                sample_shape(), {"tree.glb", {}});
  const auto report = nlohmann::json::parse(::testing::internal::GetCapturedStdout());
  EXPECT_EQ(report["input"], "tree.glb");
  EXPECT_EQ(folder.names(), Names{"a.stl"});
}

TEST(FileStream, SaysThatTheDiskIsFull) {
  const int full = ::open("/dev/full", O_WRONLY);
  if (full < 0) GTEST_SKIP() << "this system has no /dev/full";
  FileStream stream(full, "shape.glb");
  stream << "text";
  try {
    stream.flush();
    ADD_FAILURE() << "written";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "cannot write shape.glb: No space left on device");
    EXPECT_NE(error.remedy(), "");
  }
  stream.clear();
  EXPECT_THROW(stream.write(std::string(3 << 20, 'x').data(), 3 << 20), Error);
  ::close(full);
}

TEST(FileStream, SeeksAndMixesSmallAndLargeWrites) {
  const TemporaryFolder folder;
  const int descriptor = ::open((folder / "a").c_str(), O_WRONLY | O_CREAT, 0600);
  const std::string large(3 << 20, 'x');
  FileStream stream(descriptor, "a");
  stream << "head" << large << "tail";
  EXPECT_EQ(stream.tellp(), std::streamoff(8 + large.size()));
  stream.seekp(1).write("EA", 2);
  stream.seekp(0, std::ios_base::end) << '.' << std::flush;
  ::close(descriptor);
  EXPECT_TRUE(read_file(folder / "a") == "hEAd" + large + "tail.");
}

}  // namespace
}  // namespace leafhull::test
