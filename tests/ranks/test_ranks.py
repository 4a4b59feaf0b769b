# SPDX-License-Identifier: Apache-2.0
"""Ranks under mpirun; each is a process of RANK_PROBE."""

import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

PROBE = os.environ["RANK_PROBE"]
MPIRUN = os.environ["MPIRUN"]
HERE = pathlib.Path(__file__).parent
ONE_HOST = ("--allow-run-as-root", "--oversubscribe", "--bind-to", "none")
TWO_HOSTS = (
    "--allow-run-as-root", "--bind-to", "none", "--mca", "plm_rsh_agent", HERE / "other_host.sh",
    "--host", "north:2,south:2",
)  # fmt: skip


def has_other_hosts():
    command = [HERE / "other_host.sh", "north", "hostname"]
    return subprocess.run(command, capture_output=True, text=True).stdout.strip() == "north"


class RanksTest(unittest.TestCase):
    def run_ranks(self, deed, launcher=(), env=None):
        """The result, and for each rank what it wrote: a list of words per line."""
        with tempfile.TemporaryDirectory() as folder:
            command = [str(word) for word in (*launcher, PROBE, deed, folder)]
            result = subprocess.run(
                command, capture_output=True, text=True, timeout=100, env=os.environ | (env or {})
            )
            said = {
                int(file.name): [line.split() for line in file.read_text().splitlines()]
                for file in sorted(pathlib.Path(folder).iterdir())
            }
        return result, {rank: lines for rank, lines in said.items() if lines}


class Alone(RanksTest):
    def said(self, deed, **env):
        result, said = self.run_ranks(deed, env=env)
        self.assertEqual((result.returncode, list(said)), (0, [0]), result.stderr)
        return said[0]

    def test_a_process_on_its_own(self):
        self.assertEqual(self.said("introduce")[0][0], "1")
        self.assertEqual(self.said("sum"), [["1000", str(1000 << 32), "1000"]])
        numbers = [str(n) for n in range(100_000)]
        self.assertEqual(self.said("count"), [["0", *numbers], ["1", *numbers]])
        self.assertEqual(self.run_ranks("give-up")[0].returncode, 5)

    def test_slurm_alone_makes_no_ranks(self):
        for task in ({}, {"SLURM_PROCID": "2"}, {"PMIX_RANK": "0", "SLURM_STEP_NUM_TASKS": "1"}):
            lines = self.said("introduce", SLURM_NTASKS="4", SLURM_JOB_ID="7", **task)
            self.assertEqual(lines[0][0], "1")

    def test_a_launcher_that_is_not_of_this_mpi(self):
        for launcher in (
            {"OMPI_COMM_WORLD_SIZE": "4"},
            {"PMI_SIZE": "4", "PMI_RANK": "1"},
            {"PMIX_RANK": "1", "SLURM_STEP_NUM_TASKS": "4"},
        ):
            result, said = self.run_ranks("introduce", env=launcher)
            self.assertEqual((result.returncode, said), (2, {}), result.stderr)
            self.assertIn("one of 4 ranks", result.stderr)


@unittest.skipUnless(MPIRUN, "leafhull is built without MPI: several ranks are not tested")
class OneHost(RanksTest):
    where = ONE_HOST
    sizes = (1, 2, 4)

    def mpirun(self, size, deed):
        return self.run_ranks(deed, [MPIRUN, *self.where, "-n", size])

    def said(self, size, deed):
        result, said = self.mpirun(size, deed)
        self.assertEqual(result.returncode, 0, result.stderr)
        return said

    def test_the_counter_gives_each_number_once(self):
        for size in self.sizes:
            said = self.said(size, "count")
            for turn in (0, 1):
                taken = [int(n) for lines in said.values() for n in lines[turn][1:]]
                self.assertEqual(sorted(taken), list(range(100_000)))

    def test_sums(self):
        for size in self.sizes:
            total = [str(size * 1000), str(size * 1000 << 32), str(size * 1000)]
            self.assertEqual(self.said(size, "sum"), {r: [total] for r in range(size)})

    def test_what_all_say_is_in_the_order_of_ranks(self):
        for size in self.sizes:
            heard = [[str(r * 100_000), *(["abcd"[r]] if r else [])] for r in range(size)]
            self.assertEqual(self.said(size, "talk"), {r: heard for r in range(size)})

    def test_numbers_of_all_are_added_up(self):
        for size in self.sizes:
            everyone = [[str(size * (size + 1) // 2), "0", str(size * ((1 << 20) - 1))]]
            self.assertEqual(self.said(size, "add-up"), {r: everyone for r in range(size)})

    def test_a_busy_rank_0_keeps_nobody_waiting(self):
        said = self.said(4, "busy")
        self.assertEqual(sorted(said), [1, 2, 3])
        for [(mean, worst)] in said.values():
            self.assertLess(float(mean), 0.05)
            self.assertLess(float(worst), 0.5)

    def test_waiting_takes_no_core(self):
        for [[seconds]] in self.said(4, "idle").values():
            self.assertLess(float(seconds), 0.2)

    def test_a_rank_that_gives_up_ends_all_with_its_code(self):
        for size in self.sizes[-2:]:
            result, _ = self.mpirun(size, "give-up")
            self.assertEqual(result.returncode, 5, result.stderr)

    def test_a_rank_that_is_killed(self):
        for victim, deed in ((0, "lose-first"), (1, "lose-second")):
            result, said = self.mpirun(4, deed)
            self.assertEqual(result.returncode, 128 + signal.SIGKILL, result.stderr)
            self.assertNotIn(victim, said)
            mates = self.mates_of(victim)
            self.assertLessEqual(set(mates), set(said))
            self.assertEqual([said[mate][0][0] for mate in mates].count("first"), 1, said)
            for rank, [words] in said.items():
                self.assertEqual(words[1:], [str(victim)] if rank in mates else [], said)

    def mates_of(self, victim):
        """The other ranks on the victim's host."""
        return [rank for rank in range(4) if rank != victim]

    def test_who_is_who(self):
        for size in self.sizes:
            said = self.said(size, "introduce")
            self.assertEqual(sorted(said), list(range(size)))
            for [(ranks, cores, is_own_pid, _)] in said.values():
                self.assertEqual((int(ranks), is_own_pid), (size, "1"))
                self.assertGreaterEqual(int(cores), 1)

@unittest.skipUnless(MPIRUN, "leafhull is built without MPI: several hosts are not tested")
@unittest.skipUnless(has_other_hosts(), "no right to pretend other hosts (unshare --uts)")
class TwoHosts(OneHost):
    where = TWO_HOSTS
    sizes = (4,)

    def mates_of(self, victim):
        return [1 - victim]

    def test_their_names(self):
        hosts = [lines[0][3] for lines in self.said(4, "introduce").values()]
        self.assertEqual(hosts, ["north", "north", "south", "south"])


if __name__ == "__main__":
    unittest.main()
