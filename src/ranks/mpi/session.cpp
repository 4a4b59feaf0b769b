// SPDX-License-Identifier: Apache-2.0
#include "ranks/mpi/session.h"

#include <array>
#include <chrono>
#include <string>
#include <thread>

#include "leafhull/error.h"

namespace leafhull {
namespace {

constexpr std::chrono::milliseconds kPoll{2};

/// "Open MPI v4.1.4", the first words of a long line.
std::string implementation() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int size = 0;
  MPI_Get_library_version(text.data(), &size);
  const std::string_view line(text.data());
  return std::string(line.substr(0, line.find_first_of(",\n")));
}

}  // namespace

Session::Session(int launched) {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  if (size_ == 1 || provided < MPI_THREAD_SERIALIZED) {
    const std::string library = implementation();
    MPI_Finalize();
    if (size_ > 1) throw Error(ErrorCode::usage, library + " was built without threads");
    throw Error(ErrorCode::usage,
                "leafhull was started as one of " + std::to_string(launched) +
                    " ranks that cannot find each other",
                "Use the mpirun of " + library +
                    ", which leafhull is built with; srun needs "
                    "--mpi=pmix there.");
  }
}

Session::~Session() { MPI_Finalize(); }

void Session::errors_return() { MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN); }

void check(int result, std::string_view what) {
  if (result == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int size = 0;
  MPI_Error_string(result, text.data(), &size);
  throw Error(ErrorCode::internal, std::string(what) + " failed: " + text.data(),
              "Read what mpirun says; --resume continues the run.");
}

void wait(MPI_Request request, std::mutex& turn) {
  const auto is_done = [&] {
    const std::lock_guard lock(turn);
    int done = 0;
    check(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "MPI_Test");
    return done != 0;
  };
  while (!is_done()) std::this_thread::sleep_for(kPoll);
}

}  // namespace leafhull
