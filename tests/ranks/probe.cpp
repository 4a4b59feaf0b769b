// SPDX-License-Identifier: Apache-2.0
// A rank of test_ranks.py: does what its first argument says and writes the result to a file named
// after its rank in the folder of its second argument, because mpirun mixes what ranks print.
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <iostream>
#include <map>
#include <sstream>
#include <string_view>
#include <thread>

#include "leafhull/error.h"
#include "leafhull/ranks.h"

namespace {

using Clock = std::chrono::steady_clock;
using leafhull::Ranks;
using leafhull::Sum;

std::unique_ptr<Ranks> ranks;
int diary = -1;

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

void say(std::string_view text) {
  [[maybe_unused]] const auto written = write(diary, text.data(), text.size());
}

template <class... Words>
void say_line(const Words&... words) {
  std::ostringstream line;
  ((line << words << ' '), ...);
  line << '\n';
  say(line.str());
}

void compute(double seconds) {
  const auto begin = Clock::now();
  while (since(begin) < seconds) continue;
}

/// Takes numbers in two rounds.
void count() {
  constexpr std::uint64_t kBound = 100'000;
  for (int round = 0; round < 2; ++round) {
    ranks->barrier();  // all ranks begin at the same time
    std::string taken = std::to_string(round);
    for (std::uint64_t n = ranks->next(); n < kBound; n = ranks->next()) {
      taken += ' ' + std::to_string(n);
    }
    ranks->reset();
    say_line(taken);
  }
}

void sum() {
  for (int i = 0; i < 1000; ++i) {
    ranks->add(Sum::tiles, 1);
    ranks->add(Sum::leaf_vertices, std::uint64_t{1} << 32);
  }
  ranks->barrier();
  say_line(ranks->add(Sum::tiles, 0), ranks->add(Sum::leaf_vertices, 0), ranks->last(Sum::tiles));
}

/// Sums more numbers than fit into a message of the usual size.
void add_up() {
  std::vector<std::uint64_t> numbers(1 << 20);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = (std::uint64_t{1} << 40) * static_cast<std::uint64_t>(ranks->rank() + 1) + i;
  }
  ranks->sum(numbers);
  say_line(numbers.front() >> 40, numbers.front() & 0xff, numbers.back() & 0xffffffff);
}

void talk() {
  const auto mine = static_cast<std::size_t>(ranks->rank());
  for (const std::string& said :
       ranks->all(std::string(mine * 100'000, static_cast<char>('a' + mine)))) {
    say_line(said.size(), said.empty() ? ' ' : said.back());
  }
}

/// Measures how long the others wait for numbers while rank 0 computes.
void busy() {
  ranks->barrier();
  if (ranks->rank() == 0) return compute(1);
  double sum = 0, worst = 0;
  constexpr int kTimes = 100;
  for (int i = 0; i < kTimes; ++i) {
    const auto begin = Clock::now();
    ranks->next();
    worst = std::max(worst, since(begin));
    sum += since(begin);
  }
  say_line(sum / kTimes, worst);
}

/// Measures the CPU time that waiting costs.
void idle() {
  ranks->barrier();
  const double before = cpu_seconds();
  if (ranks->rank() == 0) std::this_thread::sleep_for(std::chrono::seconds(1));
  ranks->barrier();
  say_line(cpu_seconds() - before);
}

/// A short version of the handler that a rank of a run has.
extern "C" void tell(int signal) {
  say(ranks->leave() ? "first" : "later");
  for (int rank = 0; rank < ranks->size(); ++rank) {
    const std::array<char, 2> word = {' ', static_cast<char>('0' + rank)};
    if (ranks->is_lost(rank)) say({word.data(), word.size()});
  }
  say("\n");
  ranks->leave_together();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void lose(int victim) {
  std::signal(SIGTERM, tell);
  ranks->barrier();
  if (ranks->rank() == victim) std::raise(SIGKILL);
  ranks->barrier();
}

void give_up() {
  if (ranks->rank() == ranks->size() - 1) ranks->abort(5);
  ranks->barrier();
}

void introduce() {
  const leafhull::RankProcess& mine = ranks->processes()[static_cast<std::size_t>(ranks->rank())];
  say_line(ranks->size(), ranks->cores(), mine.pid == getpid(), mine.host);
}

}  // namespace

int main(int, char** words) {
  try {
    ranks = leafhull::open_ranks();
  } catch (const leafhull::Error& error) {
    std::cerr << error.what() << ". " << error.remedy() << '\n';
    return static_cast<int>(error.code());
  }
  const std::map<std::string, void (*)()> deeds = {
      {"count", count},
      {"sum", sum},
      {"talk", talk},
      {"add-up", add_up},
      {"busy", busy},
      {"idle", idle},
      {"lose-first", [] { lose(0); }},
      {"lose-second", [] { lose(1); }},
      {"give-up", give_up},
      {"introduce", introduce},
  };
  const std::string file = std::string(words[2]) + "/" + std::to_string(ranks->rank());
  diary = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  deeds.at(words[1])();
  ranks.reset();
}
