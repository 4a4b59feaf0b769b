// SPDX-License-Identifier: Apache-2.0
#include "picture/film.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "output/destination.h"
#include "output/transaction.h"
#include "output/write_error.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

/// Frames come from descriptor 0. The film goes to descriptor 3: unlike a name, it cannot create a
/// new file if the old one was removed meanwhile. The same frames make the same film.
constexpr std::string_view kInput =
    "ffmpeg -nostdin -hide_banner -loglevel error -xerror -f rawvideo -pixel_format rgb24";
constexpr std::string_view kOutput = "-fflags +bitexact -flags:v +bitexact -y file:/proc/self/fd/3";

/// H.264 stores colours at half the size, so both sides must be even; odd sides are padded with
/// white paper.
constexpr std::string_view kMp4 =
    "-vf pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p "
    "-c:v libx264 -preset medium -crf 18 -movflags +faststart -f mp4";
constexpr std::string_view kWebp = "-c:v libwebp_anim -quality 85 -loop 0 -f webp";

std::vector<std::string> command(const std::filesystem::path& name, int width, int height,
                                 double frames_per_second) {
  std::ostringstream line;
  line << kInput << " -video_size " << width << 'x' << height << " -framerate " << frames_per_second
       << " -i pipe:0 " << (lower_extension(name) == ".webp" ? kWebp : kMp4) << ' ' << kOutput;
  std::istringstream words(line.str());
  return {std::istream_iterator<std::string>(words), {}};
}

}  // namespace

bool can_make_films() { return finds_program("ffmpeg"); }

Film::Film(std::filesystem::path file, int width, int height, double frames_per_second)
    : name_(std::move(file)), file_(resolve_destination(name_)) {
  std::array<int, 2> ends;  // unlike a pipe, a closed socket raises no signal here
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw write_error(name_, errno);
  }
  frames_ = ends[0];
  try {
    ffmpeg_.emplace(
        command(name_, width, height, frames_per_second),
        std::vector{ends[1], messages_.descriptor(), messages_.descriptor(), file_.descriptor()});
  } catch (const std::system_error& error) {
    ::close(ends[0]), ::close(ends[1]);
    throw Error(ErrorCode::output,
                "cannot write " + name_.string() + ": ffmpeg does not start (" +
                    error.code().message() + ")",
                "Install ffmpeg on the PATH.");
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
              "Check that ffmpeg has libx264 and libwebp (ffmpeg -encoders), and check the disk.");
}

}  // namespace leafhull
