// SPDX-License-Identifier: Apache-2.0
#include "picture/film.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "output/destination.h"
#include "output/transaction.h"
#include "output/write_error.h"
#include "picture/files.h"

namespace leafhull {
namespace {

/// H.264 halves its colours' size, so both sides must be even: paper where they are not. Whole
/// pictures follow the head of the file, so that it plays while it loads.
const std::vector<std::string> kMp4 = {
    "-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p",
    "-c:v",      "libx264",
    "-preset",   "medium",
    "-crf",      "18",
    "-movflags", "+faststart",
    "-f",        "mp4"};
const std::vector<std::string> kWebp = {"-c:v", "libwebp_anim", "-quality", "85", "-loop",
                                        "0",    "-f",           "webp"};

std::vector<std::string> command(const std::filesystem::path& name, const char* file, int width,
                                 int height, double frames_per_second) {
  std::vector<std::string> words = {"ffmpeg",
                                    "-nostdin",
                                    "-hide_banner",
                                    "-loglevel",
                                    "error",
                                    "-f",
                                    "rawvideo",
                                    "-pixel_format",
                                    "rgb24",
                                    "-video_size",
                                    std::to_string(width) + "x" + std::to_string(height),
                                    "-framerate",
                                    std::to_string(frames_per_second),
                                    "-i",
                                    "pipe:0"};
  const std::vector<std::string>& format = lower_extension(name) == ".webp" ? kWebp : kMp4;
  words.insert(words.end(), format.begin(), format.end());
  // The same frames make the same film.
  for (const char* word : {"-fflags", "+bitexact", "-flags:v", "+bitexact", "-y"}) {
    words.emplace_back(word);
  }
  words.push_back("file:" + std::string(file));
  return words;
}

}  // namespace

bool can_make_films() { return finds_program("ffmpeg"); }

Film::Film(std::filesystem::path file, int width, int height, double frames_per_second)
    : name_(std::move(file)), file_(resolve_destination(name_)) {
  std::array<int, 2> ends;  // unlike a pipe's, a socket's closing raises no signal here
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw write_error(name_, errno);
  }
  frames_ = ends[0];
  try {
    ffmpeg_.emplace(command(name_, file_.path(), width, height, frames_per_second),
                    std::array{ends[1], messages_.descriptor(), messages_.descriptor()});
  } catch (const std::system_error& error) {
    ::close(ends[0]), ::close(ends[1]);
    throw Error(ErrorCode::output,
                "cannot write " + name_.string() + ": ffmpeg does not start (" +
                    error.code().message() + ")",
                "Install ffmpeg where PATH finds it.");
  }
  ::close(ends[1]);
}

Film::~Film() {
  if (frames_ >= 0) ::close(frames_);
}

void Film::add(const Picture& frame) {
  const auto* bytes = reinterpret_cast<const char*>(frame.rgb.data());
  for (std::size_t done = 0; done < frame.rgb.size();) {
    const ssize_t sent = ::send(frames_, bytes + done, frame.rgb.size() - done, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) {
      ::close(std::exchange(frames_, -1));
      ffmpeg_->wait();
      fail();
    }
    done += static_cast<std::size_t>(sent);
  }
}

void Film::finish() {
  ::close(std::exchange(frames_, -1));
  if (!ffmpeg_->wait()) fail();
  Transaction transaction;
  transaction.add(name_, std::move(file_));
  transaction.commit();
}

void Film::fail() {
  std::string words = messages_.read();
  constexpr std::size_t kMost = 300;
  if (words.size() > kMost) words.resize(kMost);
  throw Error(ErrorCode::output,
              "cannot write " + name_.string() + ": ffmpeg says " + one_line(std::move(words)),
              "See that ffmpeg has libx264 and libwebp (ffmpeg -encoders), and look at the disk.");
}

}  // namespace leafhull
