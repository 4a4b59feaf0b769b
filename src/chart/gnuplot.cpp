// SPDX-License-Identifier: Apache-2.0
#include "chart/gnuplot.h"

#include <string_view>
#include <system_error>

#include "leafhull/error.h"
#include "process/memory_file.h"
#include "process/process.h"

namespace leafhull {
namespace {

[[noreturn]] void fail(const std::string& reason, const std::string& remedy = {}) {
  throw Error(ErrorCode::output, "charts cannot be drawn: " + reason, remedy);
}

void start_and_wait(const MemoryFile& input, const MemoryFile& output, const MemoryFile& messages) {
  const auto start = [&]() -> Process {
    try {
      return Process({"gnuplot", "-d"},
                     {input.descriptor(), output.descriptor(), messages.descriptor()});
    } catch (const std::system_error& error) {
      fail("gnuplot does not start (" + error.code().message() + ")",
           "Install gnuplot 5 on the PATH; on Debian: apt-get install gnuplot-nox");
    }
  };
  if (!start().wait()) fail("gnuplot says" + one_line(' ' + messages.read()));
}

}  // namespace

std::string run_gnuplot(const std::string& script) try {
  const MemoryFile input, output, messages;
  input.write(script);
  start_and_wait(input, output, messages);
  return output.read();
} catch (const std::system_error& error) {
  fail(error.code().message());
}

}  // namespace leafhull
