// SPDX-License-Identifier: Apache-2.0
#include "ranks/mpi/host_board.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <memory>
#include <numeric>

namespace leafhull {
namespace {

constexpr timespec kLeavingStep = {.tv_sec = 0, .tv_nsec = 5'000'000};
constexpr int kLeavingSteps = 100;

bool is_gone(int pid) { return kill(pid, 0) != 0 && errno == ESRCH; }

/// The cores that any of the ranks may run on: each may be bound to its own.
int cores_of(MPI_Comm host) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  sched_getaffinity(0, sizeof cores, &cores);
  MPI_Allreduce(MPI_IN_PLACE, &cores, sizeof cores, MPI_BYTE, MPI_BOR, host);
  return std::max(1, CPU_COUNT(&cores));
}

/// The place of each of all ranks among those of `host`; -1: not there.
std::vector<int> places_in(MPI_Comm host) {
  MPI_Group world_group = MPI_GROUP_NULL, host_group = MPI_GROUP_NULL;
  MPI_Comm_group(MPI_COMM_WORLD, &world_group);
  MPI_Comm_group(host, &host_group);
  int size = 0;
  MPI_Group_size(world_group, &size);
  std::vector<int> ranks(static_cast<std::size_t>(size)), places(ranks.size());
  std::iota(ranks.begin(), ranks.end(), 0);
  MPI_Group_translate_ranks(world_group, size, ranks.data(), host_group, places.data());
  for (int& place : places) place = place == MPI_UNDEFINED ? -1 : place;
  MPI_Group_free(&world_group);
  MPI_Group_free(&host_group);
  return places;
}

}  // namespace

HostBoard::HostBoard() {
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host_);
  int ranks = 0;
  MPI_Comm_size(host_, &ranks);
  MPI_Comm_rank(host_, &place_);
  cores_ = cores_of(host_);
  places_ = places_in(host_);

  const std::size_t bytes = sizeof(Board) + static_cast<std::size_t>(ranks);
  void* memory = nullptr;
  MPI_Win_allocate_shared(place_ == 0 ? static_cast<MPI_Aint>(bytes) : 0, 1, MPI_INFO_NULL, host_,
                          &memory, &window_);
  MPI_Aint size = 0;
  int unit = 0;
  MPI_Win_shared_query(window_, 0, &size, &unit, &memory);
  board_ = static_cast<Board*>(memory);
  left_ = reinterpret_cast<std::atomic<bool>*>(board_ + 1);
  if (place_ == 0) {
    std::construct_at(board_);
    std::uninitialized_value_construct_n(left_, ranks);
  }
  MPI_Barrier(host_);

  const int pid = getpid();
  pids_.resize(static_cast<std::size_t>(ranks));
  MPI_Allgather(&pid, 1, MPI_INT, pids_.data(), 1, MPI_INT, host_);
  for (int& other : pids_) {
    if (is_gone(other)) other = 0;  // it is in a container of its own
  }
  MPI_Barrier(host_);
}

HostBoard::~HostBoard() {
  MPI_Win_free(&window_);
  MPI_Comm_free(&host_);
}

bool HostBoard::has(int rank) const { return places_[static_cast<std::size_t>(rank)] >= 0; }

std::uint64_t HostBoard::add(Counter counter, std::uint64_t amount) noexcept {
  return at(counter).fetch_add(amount) + amount;
}

void HostBoard::set(Counter counter, std::uint64_t value) noexcept { at(counter) = value; }

void HostBoard::note(Counter counter, std::uint64_t value) noexcept {
  std::uint64_t highest = at(counter);
  while (highest < value && !at(counter).compare_exchange_weak(highest, value)) continue;
}

std::uint64_t HostBoard::get(Counter counter) const noexcept { return at(counter); }

bool HostBoard::leave() noexcept {
  const bool is_new = !left_[place_].exchange(true);
  return is_new && board_->left_ranks.fetch_add(1) == 0;
}

void HostBoard::wait_for_leavers() const noexcept {
  const auto may_still_leave = [this](std::size_t place) {
    return !left_[place] && pids_[place] != 0 && !is_gone(pids_[place]);
  };
  int patience = kLeavingSteps;
  for (std::size_t place = 0; place < pids_.size(); ++place) {
    while (may_still_leave(place) && patience-- > 0) nanosleep(&kLeavingStep, nullptr);
  }
}

bool HostBoard::is_lost(int rank) const noexcept {
  const int place = places_[static_cast<std::size_t>(rank)];
  if (place < 0 || left_[place]) return false;
  const int pid = pids_[static_cast<std::size_t>(place)];
  return pid != 0 && is_gone(pid);
}

}  // namespace leafhull
