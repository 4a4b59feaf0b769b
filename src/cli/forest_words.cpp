// SPDX-License-Identifier: Apache-2.0
#include "cli/forest_words.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <string_view>
#include <vector>

#include "cli/signals.h"
#include "leafhull/ranks.h"

namespace leafhull::cli {
namespace {

// State for the signal handler; all but `tiles` is set before the handler is installed.
struct {
  Ranks* ranks = nullptr;
  std::vector<std::string> names;  ///< by rank
  std::string how_to_go_on;
  bool tells_stop = false;
  bool has_other_hosts = false;  ///< their ranks may be lost unseen
  std::atomic<std::size_t> tiles = 0;
} this_run;

/// A line in its own buffer, because a signal handler may not allocate.
class Line {
 public:
  void add(std::string_view text) {
    const std::size_t size = std::min(text.size(), text_.size() - size_);
    std::copy_n(text.begin(), size, text_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += size;
  }

  void add(std::size_t number) {
    std::array<char, 20> digits{};
    const auto end = std::to_chars(digits.begin(), digits.end(), number).ptr;
    add({digits.data(), static_cast<std::size_t>(end - digits.data())});
  }

  void print() {
    text_[std::min(size_++, text_.size() - 1)] = '\n';
    [[maybe_unused]] const auto written =
        write(STDERR_FILENO, text_.data(), std::min(size_, text_.size()));
  }

 private:
  std::array<char, 4096> text_{};
  std::size_t size_ = 0;
};

std::size_t tiles_left() noexcept {
  const std::size_t tiles = this_run.tiles;
  return tiles - std::min<std::size_t>(tiles, this_run.ranks->last(Sum::tiles));
}

void tell_why() noexcept {
  Line line;
  line.add("leafhull: ");
  int lost = 0;
  for (int rank = 0; rank < this_run.ranks->size(); ++rank) {
    if (!this_run.ranks->is_lost(rank)) continue;
    if (lost++ > 0) line.add(", ");
    line.add(this_run.names[static_cast<std::size_t>(rank)]);
  }
  if (lost == 0 && !this_run.tells_stop) return;
  line.add(lost > 0 ? " died" : "stopped");
  if (lost == 0 && this_run.has_other_hosts) line.add(", perhaps by a rank on another host");
  line.add("; ");
  if (this_run.tiles > 0) {
    line.add("still to do: ");
    line.add(tiles_left());
    line.add(" of ");
    line.add(this_run.tiles);
    line.add(" tiles; ");
  }
  line.add(this_run.how_to_go_on);
  line.print();
}

void say_last_words() noexcept {
  if (this_run.ranks->leave()) tell_why();
  this_run.ranks->leave_together();
}

}  // namespace

ForestWords::ForestWords(Ranks& ranks, bool quiet, const std::string& how_to_go_on) {
  const std::vector<RankProcess>& processes = ranks.processes();
  const auto& mine = processes[static_cast<std::size_t>(ranks.rank())];
  this_run.ranks = &ranks;
  this_run.names.clear();
  for (const RankProcess& process : processes) {
    this_run.names.push_back("rank " + std::to_string(this_run.names.size()) + " (" + process.host +
                             ", process " + std::to_string(process.pid) + ")");
  }
  this_run.how_to_go_on = how_to_go_on;
  this_run.tells_stop = !quiet && mine.host == processes.front().host;  // one host is enough
  this_run.has_other_hosts =
      std::any_of(processes.begin(), processes.end(),
                  [&](const RankProcess& other) { return other.host != mine.host; });
  this_run.tiles = 0;
  catch_signals(say_last_words);
}

ForestWords::~ForestWords() { catch_signals(); }

void ForestWords::set_tiles(std::size_t tiles) { this_run.tiles = tiles; }

std::string ForestWords::still_to_do() const {
  if (this_run.tiles == 0) return {};
  return std::to_string(tiles_left()) + " of " + std::to_string(this_run.tiles) +
         " tiles are still to do; " + this_run.how_to_go_on + ".";
}

}  // namespace leafhull::cli
