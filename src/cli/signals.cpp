// SPDX-License-Identifier: Apache-2.0
#include "cli/signals.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>

#include "cli/console.h"
#include "leafhull/output.h"

namespace leafhull::cli {
namespace {

std::array<char, 4096> words;
std::atomic<std::size_t> words_size = 0;
static_assert(std::atomic<std::size_t>::is_always_lock_free);

void say_words() noexcept {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words_size);
}

std::atomic<void (*)() noexcept> say_at_the_end = say_words;
static_assert(decltype(say_at_the_end)::is_always_lock_free);

extern "C" void clean_up_and_die(int signal) {
  discard_unfinished_outputs();
  clear_progress();
  say_at_the_end.load()();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void catch_signals(std::string_view last_words) {
  words_size = last_words.copy(words.data(), words.size());
  catch_signals(say_words);
}

void catch_signals(void (*say)() noexcept) {
  say_at_the_end = say;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // What the parent has ignored (nohup, a background job) stays ignored.
    if (std::signal(signal, clean_up_and_die) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace leafhull::cli
