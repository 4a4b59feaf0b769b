// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>

#include "leafhull/error.h"
#include "ranks/host.h"
#include "ranks/mpi/counter_service.h"
#include "ranks/mpi/host_board.h"
#include "ranks/mpi/session.h"

namespace leafhull {
namespace {

class MpiRanks final : public Ranks {
 public:
  explicit MpiRanks(int launched) : session_(launched) {
    if (board_.ranks() < session_.size()) service_.emplace(session_, board_);
    const RankProcess mine = this_process();
    const std::vector<std::string> pids = all(std::to_string(mine.pid));
    for (const std::string& host : all(mine.host)) {
      processes_.push_back({host, std::stoi(pids[processes_.size()])});
    }
    session_.errors_return();
    if (service_) service_->errors_return();
  }

  ~MpiRanks() override {
    try {
      barrier();  // in MPI's own, ranks that wait would take a core
    } catch (const Error&) {
      MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ErrorCode::internal));
    }
  }

  int rank() const override { return session_.rank(); }
  int size() const override { return session_.size(); }
  const std::vector<RankProcess>& processes() const override { return processes_; }
  int cores() const override { return std::max(1, board_.cores() / board_.ranks()); }

  std::uint64_t next() override { return add(Counter::next, 1) - 1; }

  void reset() override {
    barrier();
    if (rank() == 0) board_.set(Counter::next, 0);
    barrier();
  }

  std::uint64_t add(Sum sum, std::uint64_t amount) override { return add(counter_of(sum), amount); }

  void sum(std::span<std::uint64_t> numbers) override {
    wait([&](MPI_Request& request) {
      return MPI_Iallreduce(MPI_IN_PLACE, numbers.data(), to_int(numbers.size()), MPI_UINT64_T,
                            MPI_SUM, MPI_COMM_WORLD, &request);
    });
  }

  std::vector<std::string> all(const std::string& mine) override {
    const auto ranks = static_cast<std::size_t>(size());
    const int mine_size = to_int(mine.size());
    std::vector<int> sizes(ranks), begins(ranks);
    wait([&](MPI_Request& request) {
      return MPI_Iallgather(&mine_size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD,
                            &request);
    });
    const std::size_t bytes = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    std::string text(static_cast<std::size_t>(to_int(bytes)), '\0');
    std::exclusive_scan(sizes.begin(), sizes.end(), begins.begin(), 0);
    wait([&](MPI_Request& request) {
      return MPI_Iallgatherv(mine.data(), mine_size, MPI_CHAR, text.data(), sizes.data(),
                             begins.data(), MPI_CHAR, MPI_COMM_WORLD, &request);
    });
    std::vector<std::string> said;
    for (std::size_t i = 0; i < ranks; ++i) {
      said.push_back(
          text.substr(static_cast<std::size_t>(begins[i]), static_cast<std::size_t>(sizes[i])));
    }
    return said;
  }

  void barrier() override {
    wait([](MPI_Request& request) { return MPI_Ibarrier(MPI_COMM_WORLD, &request); });
  }

  bool leave() noexcept override { return board_.leave(); }
  bool is_lost(int rank) const noexcept override { return board_.is_lost(rank); }
  std::uint64_t last(Sum sum) const noexcept override { return board_.get(counter_of(sum)); }
  void leave_together() noexcept override { board_.wait_for_leavers(); }

  [[noreturn]] void abort(int exit_code) override {
    leave();
    const std::lock_guard lock(session_.turn);
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
  }

 private:
  std::uint64_t add(Counter counter, std::uint64_t amount) {
    if (board_.has(0)) return board_.add(counter, amount);
    const std::uint64_t sum = service_->add(counter, amount);
    board_.note(counter, sum);
    return sum;
  }

  /// MPI's counts are ints.
  static int to_int(std::size_t bytes) {
    if (bytes > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw Error(ErrorCode::internal, "the ranks send more than 2 GiB at once");
    }
    return static_cast<int>(bytes);
  }

  template <class Start>
  void wait(Start start) {
    MPI_Request request = MPI_REQUEST_NULL;
    {
      const std::lock_guard lock(session_.turn);
      check(start(request), "a collective call of MPI");
    }
    // NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker): it knows MPI_Wait alone
    leafhull::wait(request, session_.turn);
  }

  Session session_;
  HostBoard board_;
  std::optional<CounterService> service_;  ///< where there are several hosts
  std::vector<RankProcess> processes_;
};

}  // namespace

std::unique_ptr<Ranks> mpi_ranks(int launched) { return std::make_unique<MpiRanks>(launched); }

}  // namespace leafhull
