// SPDX-License-Identifier: Apache-2.0
#include "ranks/mpi/counter_service.h"

#include <array>
#include <chrono>
#include <mutex>

namespace leafhull {
namespace {

constexpr std::chrono::milliseconds kLook{1};
constexpr int kTag = 0;

using Request = std::array<std::uint64_t, 2>;  // counter, amount

}  // namespace

CounterService::CounterService(Session& session, HostBoard& board)
    : session_(session), board_(board) {
  MPI_Comm_dup(MPI_COMM_WORLD, &requests_);
  if (session.rank() == 0) {
    server_.emplace([this](const std::stop_token& stop) { serve(stop); });
  }
}

CounterService::~CounterService() {
  server_.reset();
  MPI_Comm_free(&requests_);
}

/// Except on rank 0, where the server's thread would not catch errors: there they end all ranks.
void CounterService::errors_return() {
  if (!server_) MPI_Comm_set_errhandler(requests_, MPI_ERRORS_RETURN);
}

std::uint64_t CounterService::add(Counter counter, std::uint64_t amount) {
  const Request request = {static_cast<std::uint64_t>(counter), amount};
  std::uint64_t sum = 0;
  check(MPI_Sendrecv(request.data(), request.size(), MPI_UINT64_T, 0, kTag, &sum, 1, MPI_UINT64_T,
                     0, kTag, requests_, MPI_STATUS_IGNORE),
        "MPI_Sendrecv");
  return sum;
}

void CounterService::serve(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    if (!answer_one()) std::this_thread::sleep_for(kLook);
  }
}

bool CounterService::answer_one() {
  const std::lock_guard lock(session_.turn);
  int arrived = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, kTag, requests_, &arrived, &status);
  if (arrived == 0) return false;
  Request request{};
  MPI_Recv(request.data(), request.size(), MPI_UINT64_T, status.MPI_SOURCE, kTag, requests_,
           MPI_STATUS_IGNORE);
  const std::uint64_t sum = board_.add(static_cast<Counter>(request[0]), request[1]);
  MPI_Send(&sum, 1, MPI_UINT64_T, status.MPI_SOURCE, kTag, requests_);
  return true;
}

}  // namespace leafhull
