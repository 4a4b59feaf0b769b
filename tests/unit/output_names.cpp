// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <fstream>
#include <functional>

#include "leafhull/error.h"
#include "leafhull/output.h"
#include "output_sample.h"

namespace leafhull::test {
namespace {

namespace fs = std::filesystem;

class OutputNames : public ::testing::Test {
 protected:
  /// The error that the names cause; empty if they are accepted.
  std::string complaint(const OutputFiles& files, ErrorCode code) {
    try {
      plan_outputs(files, input_);
      return "";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      EXPECT_NE(error.remedy(), "") << error.what();
      return std::string(error.what()) + " " + error.remedy();
    }
  }

  TemporaryFolder folder_;
  fs::path input_ = folder_ / "tree.glb";
};

TEST_F(OutputNames, TakesEveryKnownExtension) {
  OutputFiles files;
  for (const char* name : {"a.glb", "a.gltf", "a.obj", "a.ply", "a.stl", "a.vdb", "b.GLB"}) {
    files.shapes.push_back(folder_ / name);
  }
  files.kernels = folder_ / "kernels.ply";
  files.field = folder_ / "field.vdb";
  files.report = "-";
  EXPECT_EQ(complaint(files, ErrorCode::usage), "");
  EXPECT_TRUE(folder_.names().empty()) << "only looks";
}

TEST_F(OutputNames, ListsTheKnownExtensions) {
  for (const char* name : {"shape.fbx", "shape", ".glb", "shape.glb/"}) {
    EXPECT_NE(complaint({.shapes = {folder_ / name}}, ErrorCode::usage)
                  .find(".glb, .gltf, .obj, .ply, .stl, .vdb"),
              std::string::npos)
        << name;
  }
}

TEST_F(OutputNames, WantsTheRightExtensionOfTheOtherFiles) {
  EXPECT_NE(complaint({.kernels = folder_ / "k.obj"}, ErrorCode::usage).find(".ply"),
            std::string::npos);
  EXPECT_NE(complaint({.field = folder_ / "f.ply"}, ErrorCode::usage).find(".vdb"),
            std::string::npos);
  EXPECT_NE(complaint({.report = folder_ / "r.txt"}, ErrorCode::usage).find(".json"),
            std::string::npos);
}

TEST_F(OutputNames, RefusesOneFileTwice) {
  fs::create_directory(folder_ / "sub");
  write_file(folder_ / "real.ply", "old");
  fs::create_symlink("../real.ply", folder_ / "sub" / "link.ply");
  EXPECT_NE(
      complaint({.shapes = {folder_ / "a.glb", folder_ / "sub" / ".." / "a.glb"}}, ErrorCode::usage)
          .find("are the same file"),
      std::string::npos);
  EXPECT_NE(complaint({.shapes = {folder_ / "sub" / "link.ply"}, .kernels = folder_ / "real.ply"},
                      ErrorCode::usage)
                .find("are the same file"),
            std::string::npos);
}

TEST_F(OutputNames, RefusesTheInput) {
  write_file(input_, "a tree");
  fs::create_symlink("tree.glb", folder_ / "link.glb");
  for (const char* name : {"tree.glb", "link.glb"}) {
    EXPECT_NE(complaint({.shapes = {folder_ / name}}, ErrorCode::usage).find("is the input"),
              std::string::npos);
  }
}

TEST_F(OutputNames, SaysThatAFolderIsMissing) {
  const std::string text = complaint({.shapes = {folder_ / "none" / "a.glb"}}, ErrorCode::output);
  EXPECT_NE(text.find((folder_ / "none").string() + " does not exist"), std::string::npos) << text;
}

TEST_F(OutputNames, RefusesWhatIsNoRegularFile) {
  fs::create_directory(folder_ / "folder.glb");
  fs::create_symlink("/dev/null", folder_ / "null.glb");
  fs::create_symlink("circle.glb", folder_ / "circle.glb");
  EXPECT_NE(complaint({.shapes = {folder_ / "folder.glb"}}, ErrorCode::output).find("directory"),
            std::string::npos);
  EXPECT_NE(complaint({.shapes = {folder_ / "null.glb"}}, ErrorCode::output).find("regular"),
            std::string::npos);
  EXPECT_NE(complaint({.shapes = {folder_ / "circle.glb"}}, ErrorCode::output), "");
  EXPECT_NE(complaint({.shapes = {folder_ / (std::string(300, 'a') + ".glb")}}, ErrorCode::output)
                .find("too long"),
            std::string::npos);
}

/// Whether `condition` holds in a process without root's rights.
bool holds_unprivileged(const std::function<bool()>& condition) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::geteuid() == 0 && (::setgid(65534) != 0 || ::setuid(65534) != 0)) ::_exit(2);
    ::_exit(condition() ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST_F(OutputNames, SaysThatAFolderOrFileIsReadOnly) {
  fs::permissions(folder_.path(), fs::perms(0777));
  fs::create_directory(folder_ / "locked");
  fs::permissions(folder_ / "locked", fs::perms(0555));
  write_file(folder_ / "old.glb", "old");
  fs::permissions(folder_ / "old.glb", fs::perms(0444));
  const auto is_denied = [&](const fs::path& file) {
    return complaint({.shapes = {file}}, ErrorCode::output).find("Permission denied") !=
           std::string::npos;
  };
  EXPECT_TRUE(holds_unprivileged([&] { return is_denied(folder_ / "locked" / "a.glb"); }));
  EXPECT_TRUE(holds_unprivileged([&] { return is_denied(folder_ / "old.glb"); }));
  EXPECT_FALSE(holds_unprivileged([&] { return is_denied(folder_ / "new.glb"); }));
}

/// The error that a folder for results causes; empty if it is accepted.
std::string complaint_of(const fs::path& folder) {
  try {
    EXPECT_EQ(OutputFolder(folder).path(), folder);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output) << error.what();
    return error.what();
  }
}

TEST(OutputFolder, MayBeMissing) {
  const TemporaryFolder folder;
  EXPECT_EQ(complaint_of(folder.path()), "");
  EXPECT_EQ(complaint_of(folder / "new"), "");
  EXPECT_EQ(complaint_of(folder / "new/"), "");
  EXPECT_FALSE(fs::exists(folder / "new")) << "only looks";
  EXPECT_EQ(complaint_of(folder / "missing" / "new"), "");
  std::ofstream(folder / "file") << "precious";
  EXPECT_NE(complaint_of(folder / "file").find("is a file"), std::string::npos);
  EXPECT_NE(complaint_of(folder / "file" / "new").find("file"), std::string::npos);
}

TEST(OutputFolder, HasFilesBeforeItIsMade) {
  const TemporaryFolder folder;
  const auto code_of = [&](const fs::path& within, const fs::path& file) {
    try {
      (void)OutputFolder(within).file(file, ".json", {folder / "tree.glb", folder / "tree.json"});
      return ErrorCode{};
    } catch (const Error& error) {
      return error.code();
    }
  };
  EXPECT_EQ(code_of(folder / "new", folder / "new" / "a.json"), ErrorCode{});
  EXPECT_EQ(code_of(folder / "new", folder / "new" / "a.txt"), ErrorCode::usage);
  EXPECT_EQ(code_of(folder / "new", folder / "new" / "newer" / "a.json"), ErrorCode::output);
  EXPECT_EQ(code_of(folder / "new", folder / "other" / "a.json"), ErrorCode::output);
  EXPECT_EQ(code_of(folder.path(), folder / "a.json"), ErrorCode{});
  EXPECT_EQ(code_of(folder.path(), folder / "tree.json"), ErrorCode::usage) << "the second input";
  fs::create_symlink("loop", folder / "loop");
  EXPECT_EQ(code_of(folder / "new", folder / "loop" / "a.json"), ErrorCode::output);
}

TEST(OutputFolder, IsMadeForItsFiles) {
  const TemporaryFolder folder;
  const fs::path within = folder / "new" / "newer", name = within / "a.json";
  const OutputFile file = OutputFolder(within).file(name, ".json", {});
  EXPECT_EQ(file.path(), name);
  EXPECT_FALSE(fs::exists(folder / "new"));
  file.write("{}");
  EXPECT_EQ(fs::file_size(name), 2u);
}

}  // namespace
}  // namespace leafhull::test
