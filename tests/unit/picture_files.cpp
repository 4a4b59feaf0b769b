// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "leafhull/error.h"
#include "picture/files.h"
#include "picture/film.h"
#include "process/process.h"
#include "temporary_folder.h"

namespace leafhull::test {
namespace {

namespace fs = std::filesystem;

using Paths = std::vector<fs::path>;

/// Hides all programs while it lives.
class NoPrograms {
 public:
  NoPrograms() { setenv("PATH", "/nonexistent", 1); }
  ~NoPrograms() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_ = std::getenv("PATH");
};

class PictureFileNames : public testing::Test {
 protected:
  void expect_error(ErrorCode code, const std::string& part, const PictureFiles& files) {
    try {
      checked_files(files, input_);
      ADD_FAILURE() << "no error with " << part;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(error.code(), code) << message;
      EXPECT_NE(message.find(part), std::string::npos) << message << " lacks " << part;
      EXPECT_FALSE(error.remedy().empty());
    }
  }
  fs::path out(const std::string& name) const { return folder_ / name; }

  TemporaryFolder folder_;
  fs::path input_ = folder_ / "tree.glb";
};

TEST(FrameNumbers, HaveFourDigitsOrMore) {
  EXPECT_EQ(numbered("a/picture.png", 1), "a/picture-0001.png");
  EXPECT_EQ(numbered("picture.tar.exr", 123), "picture.tar-0123.exr");
  EXPECT_EQ(numbered("p.png", 12345), "p-12345.png");
}

TEST_F(PictureFileNames, OfSubjectsInARow) {
  EXPECT_NO_THROW(checked_files({{out("a.png")}, 0}, input_, 2));
  EXPECT_NO_THROW(checked_files({{out("a.exr")}, 0}, input_, 1));
  try {
    checked_files({{out("a.png"), out("b.exr")}, 0}, input_, 2);
    FAIL() << "the buffers of which?";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(std::string(error.what()).find("b.exr"), std::string::npos) << error.what();
  }
}

TEST_F(PictureFileNames, OfOnePicture) {
  EXPECT_NO_THROW(checked_files({{out("a.png"), out("b.exr"), out("c.PNG")}, 0}, input_));
  expect_error(ErrorCode::usage, "no output", {});
  expect_error(ErrorCode::usage, "a.jpg", {{out("a.jpg")}, 0});
  expect_error(ErrorCode::usage, "no extension", {{out("picture")}, 0});
  expect_error(ErrorCode::usage, "film", {{out("a.mp4")}, 0});
  expect_error(ErrorCode::usage, "same file", {{out("a.png"), folder_ / "./a.png"}, 0});
  expect_error(ErrorCode::output, "missing", {{folder_ / "missing/a.png"}, 0});
  fs::create_directory(out("folder.png"));
  expect_error(ErrorCode::output, "folder.png", {{out("folder.png")}, 0});
  input_ = out("tree.png");
  std::ofstream(input_) << "glTF";
  expect_error(ErrorCode::usage, "input itself", {{out("tree.png")}, 0});
}

TEST_F(PictureFileNames, OfATurntable) {
  input_ = out("a-0002.png");
  std::ofstream(input_) << "glTF";
  expect_error(ErrorCode::usage, "input itself", {{out("a.png")}, 3});
  EXPECT_NO_THROW(checked_files({{out("a.png")}, 1}, input_));
  expect_error(ErrorCode::usage, "same file", {{out("b.png"), folder_ / "./b.png"}, 2});
}

TEST_F(PictureFileNames, AFilmComesWithFramesWhereItCan) {
  if (!can_make_films()) GTEST_SKIP() << "ffmpeg is missing";
  const FilePlan frames = plan_files({{"a/b.png", "c.exr"}, 3});
  EXPECT_EQ(frames.png, Paths{"a/b.png"});
  EXPECT_EQ(frames.exr, Paths{"c.exr"});
  EXPECT_EQ(frames.films, Paths{"a/b.mp4"});
  EXPECT_FALSE(frames.film_was_asked_for);
  EXPECT_TRUE(plan_files({{"b.png"}, 0}).films.empty());
  EXPECT_TRUE(plan_files({{"c.exr"}, 3}).films.empty());
  const FilePlan named = plan_files({{"b.png", "c.webp"}, 3});
  EXPECT_EQ(named.films, Paths{"c.webp"});
  EXPECT_TRUE(named.film_was_asked_for);
}

TEST_F(PictureFileNames, WithoutFfmpegOnlyANamedFilmIsRefused) {
  const NoPrograms none;
  const FilePlan frames = plan_files({{"b.png"}, 3});
  EXPECT_TRUE(frames.films.empty());
  EXPECT_TRUE(frames.film_is_missing);
  EXPECT_NO_THROW(checked_files({{out("b.png")}, 3}, input_));
  expect_error(ErrorCode::output, "ffmpeg", {{out("b.mp4")}, 3});
}

class Films : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_make_films()) GTEST_SKIP() << "ffmpeg is missing";
  }
  static Picture frame(int width, int height, std::uint8_t grey) {
    return {width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, grey)};
  }
  std::string make(const std::string& name) {
    Film film(folder_ / name, 33, 17, 12);
    for (const std::uint8_t grey : {20, 120, 220}) film.add(frame(33, 17, grey));
    EXPECT_FALSE(fs::exists(folder_ / name)) << "it is not done yet";
    film.finish();
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

  TemporaryFolder folder_;
};

TEST_F(Films, AreMadeOfFrames) {
  const std::string mp4 = make("a.mp4");
  EXPECT_EQ(mp4.substr(4, 4), "ftyp");
  EXPECT_NE(mp4.find("avc1"), std::string::npos);
  EXPECT_LT(mp4.find("moov"), mp4.find("mdat")) << "plays only once all of it is there";
  EXPECT_EQ(make("b.mp4"), mp4);
  const std::string webp = make("a.webp");
  EXPECT_EQ(webp.substr(0, 4), "RIFF");
  std::size_t frames = 0;
  for (std::size_t at = webp.find("ANMF"); at != std::string::npos;
       at = webp.find("ANMF", at + 4)) {
    ++frames;
  }
  EXPECT_EQ(frames, 3u);
  EXPECT_EQ(files(), 3u);
}

TEST_F(Films, LeaveNothingUnlessFinished) {
  std::ofstream(folder_ / "a.mp4") << "before";
  {
    Film film(folder_ / "a.mp4", 32, 16, 12);
    film.add(frame(32, 16, 9));
  }
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(fs::file_size(folder_ / "a.mp4"), 6u);
}

TEST_F(Films, SayWhyTheyFail) {
  Film film(folder_ / "a.mp4", 0, 0, 12);  // a video cannot have this size
  try {
    for (int i = 0; i < 1000; ++i) film.add(frame(64, 64, 9));
    film.finish();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output);
    const std::string message = error.what();
    EXPECT_NE(message.find("a.mp4: ffmpeg says"), std::string::npos) << message;
    EXPECT_NE(message.find("0x0"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST_F(Films, DoNotStartWithoutFfmpeg) {
  const NoPrograms none;
  EXPECT_THROW(Film(folder_ / "a.mp4", 32, 16, 12), Error);
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace leafhull::test
