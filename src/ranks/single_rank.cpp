// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <thread>

#include "leafhull/ranks.h"
#include "ranks/host.h"

namespace leafhull {
namespace {

class SingleRank final : public Ranks {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  const std::vector<RankProcess>& processes() const override { return processes_; }
  int cores() const override {
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }

  std::uint64_t next() override { return next_++; }
  void reset() override { next_ = 0; }
  std::uint64_t add(Sum sum, std::uint64_t amount) override {
    return sums_[static_cast<std::size_t>(sum)] += amount;
  }

  void sum(std::span<std::uint64_t>) override {}
  std::vector<std::string> all(const std::string& mine) override { return {mine}; }
  void barrier() override {}

  bool leave() noexcept override { return true; }
  bool is_lost(int) const noexcept override { return false; }
  std::uint64_t last(Sum sum) const noexcept override {
    return sums_[static_cast<std::size_t>(sum)];
  }

  void leave_together() noexcept override {}

  [[noreturn]] void abort(int exit_code) override { std::exit(exit_code); }

 private:
  std::vector<RankProcess> processes_{this_process()};
  std::uint64_t next_ = 0;
  std::array<std::atomic<std::uint64_t>, kSums> sums_{};
};

}  // namespace

std::unique_ptr<Ranks> single_rank() { return std::make_unique<SingleRank>(); }

}  // namespace leafhull
