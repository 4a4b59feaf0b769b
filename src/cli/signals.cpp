// SPDX-License-Identifier: Apache-2.0
#include "cli/signals.h"

#include <csignal>

#include "cli/console.h"
#include "leafhull/output.h"

namespace leafhull::cli {
namespace {

extern "C" void clean_up_and_die(int signal) {
  discard_unfinished_outputs();
  clear_progress();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void catch_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // What the parent has ignored (nohup, a background job) stays ignored.
    if (std::signal(signal, clean_up_and_die) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace leafhull::cli
