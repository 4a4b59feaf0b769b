// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "leafhull/error.h"
#include "leafhull/ranks.h"
#include "ranks/host.h"

namespace leafhull {
namespace {

/// The number that a launcher left in the environment; 0: none.
int number_in(const char* variable) {
  const char* const text = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): nobody sets it
  if (text == nullptr) return 0;
  int value = 0;
  const std::string_view digits = text;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

/// The number of processes, this one included, that the launcher started to find each other.
int launched_processes() {
  const int by_open_mpi = number_in("OMPI_COMM_WORLD_SIZE");
  if (by_open_mpi > 0) return by_open_mpi;
  const int by_pmi = number_in("PMI_SIZE");  // MPICH's and Intel's mpiexec, srun --mpi=pmi2
  if (by_pmi > 0) return by_pmi;
  // srun --mpi=pmix. Slurm alone does not make ranks: a batch script, a shell in an allocation and
  // the tasks of srun --mpi=none work each on its own.
  const bool by_pmix = std::getenv("PMIX_RANK") != nullptr;  // NOLINT(concurrency-mt-unsafe)
  return by_pmix ? number_in("SLURM_STEP_NUM_TASKS") : 1;
}

}  // namespace

RankProcess this_process() {
  std::array<char, 256> host{};  // POSIX: at most 255 bytes
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  return {host.data(), getpid()};
}

std::unique_ptr<Ranks> open_ranks() {
  const int processes = launched_processes();
  if (processes <= 1) return single_rank();
#ifdef LEAFHULL_HAS_MPI
  return mpi_ranks(processes);
#else
  throw Error(ErrorCode::usage,
              "leafhull was started as one of " + std::to_string(processes) +
                  " ranks, but it was built without MPI",
              "Start it alone, share the work with --tile-range, or build it with "
              "-DLEAFHULL_MPI=ON.");
#endif
}

}  // namespace leafhull
