# SPDX-License-Identifier: Apache-2.0
"""leafhull forest under mpirun."""

import os
import pathlib
import re
import resource
import signal
import subprocess
import time
import unittest

from command import CommandTest

MPIRUN = os.environ["MPIRUN"]
MANY_TILES = ("--voxel-size", "0.04", "--tile", "32")
LOST = re.compile(
    r"leafhull: rank (\d) \(\S+, process (\d+)\) died; still to do: (\d+) of (\d+) tiles; "
    r"the same command with --resume continues"
)
OTHER_HOST = pathlib.Path(__file__).parents[1] / "ranks" / "other_host.sh"
STOPPED = re.compile(
    r"leafhull: stopped; still to do: \d+ of \d+ tiles; the same command with --resume continues"
)


FAILED = re.compile(
    r"leafhull: error: rank 1: cannot write .*\. (\d+) of (\d+) tiles are still to do; "
    r"the same command with --resume continues\."
)


def listen_to_interrupts():
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)


def ranks_of(mpirun):
    """The process id of each rank."""
    found = {}
    for folder in pathlib.Path("/proc").iterdir():
        try:
            parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
            words = (folder / "environ").read_bytes().split(b"\0") if parent == mpirun else []
        except (OSError, ValueError, IndexError):
            continue
        for word in words:
            if word.startswith(b"OMPI_COMM_WORLD_RANK="):
                found[int(word.partition(b"=")[2])] = int(folder.name)
    return found


def processes_with(variable, word):
    """The processes that have this variable in their environment and this word in their command."""
    found = []
    for folder in pathlib.Path("/proc").iterdir():
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
            variables = (folder / "environ").read_bytes().split(b"\0")
        except OSError:
            continue
        if variable.encode() in variables and word.encode() in words:
            found.append(int(folder.name))
    return found


def has_other_hosts():
    command = [OTHER_HOST, "north", "hostname"]
    return subprocess.run(command, capture_output=True, text=True).stdout.strip() == "north"


def our_lines(text):
    return [line for line in text.splitlines() if line.startswith("leafhull: ")]


@unittest.skipUnless(MPIRUN, "leafhull is built without MPI")
class ForestRanks(CommandTest):
    def setUp(self):
        super().setUp()
        rows = [f"tree.glb,{x},0,{z}" for x in range(8) for z in range(8)]
        text = "\n".join(["model,x,y,z", *rows, ""])
        self.scene = self.input("stand.csv", text.encode())

    def command(self, ranks, folder, *flags, scene=None, where=("--oversubscribe",)):
        return [
            MPIRUN, "--allow-run-as-root", "--bind-to", "none", *where, "-n", str(ranks),
            os.environ["LEAFHULL"], "forest", str(scene or self.scene), "-o", str(folder), *flags,
        ]  # fmt: skip

    def start(self, *arguments, **options):
        return subprocess.Popen(
            self.command(*arguments, **options),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=listen_to_interrupts,
        )

    def end(self, process):
        _, text = process.communicate(timeout=300)
        return process.returncode, text

    def bytes_in(self, folder):
        return {
            str(path.relative_to(folder)): path.read_bytes()
            for path in sorted(folder.rglob("*"))
            if path.is_file()
        }

    def test_ranks_do_not_change_a_byte(self):
        flags = ("--voxel-size", "0.1", "--tile", "32", "--levels", "2")
        self.succeed("forest", self.scene, "-o", self.out / "alone", *flags)
        alone = self.bytes_in(self.out / "alone")
        self.assertIn("tileset.json", alone)
        for ranks in (1, 2, 4):
            folder = self.out / str(ranks)
            code, text = self.end(self.start(ranks, folder, *flags))
            self.assertEqual(code, 0, text)
            self.assertEqual(len(our_lines(text)), 1, text)
            self.assertEqual(self.bytes_in(folder), alone)

    def tiles_done(self, folder):
        journals = (folder / "work").glob("journal-*.jsonl")
        return sum(len(journal.read_text().splitlines()) for journal in journals)

    def test_a_rank_that_is_killed(self):
        folder = self.out / "stand"
        process = self.start(4, folder, *MANY_TILES)
        while self.tiles_done(folder) < 8 and process.poll() is None:
            time.sleep(0.01)
        victim = ranks_of(process.pid)[2]
        os.kill(victim, signal.SIGKILL)
        code, text = self.end(process)
        self.assertEqual(code, 128 + signal.SIGKILL, text)
        (line,) = our_lines(text)
        told = LOST.fullmatch(line)
        self.assertIsNotNone(told, line)
        self.assertEqual((int(told[1]), int(told[2])), (2, victim))
        counted = int(told[4]) - int(told[3])
        uncounted = self.tiles_done(folder) - counted
        self.assertTrue(0 <= uncounted <= 4, "a rank may die between the two")

        code, text = self.end(self.start(2, folder, *MANY_TILES, "--resume"))
        self.assertEqual(code, 0, text)
        self.succeed("forest", self.scene, "-o", self.out / "whole", *MANY_TILES)
        self.assertEqual(self.bytes_in(folder), self.bytes_in(self.out / "whole"))

    @unittest.skipUnless(has_other_hosts(), "no right to pretend other hosts (unshare --uts)")
    def test_a_lost_rank_of_another_host(self):
        where = ("--mca", "plm_rsh_agent", str(OTHER_HOST), "--host", "north:1,south:1")
        process = self.start_tiles(2, where=where)
        (victim,) = processes_with("OMPI_COMM_WORLD_RANK=1", str(self.out / "stand"))
        os.kill(victim, signal.SIGKILL)
        code, text = self.end(process)
        self.assertNotEqual(code, 0)
        (line,) = our_lines(text)
        self.assertIn("perhaps by a rank on another host; ", line)
        self.assertRegex(line.replace(", perhaps by a rank on another host", ""), STOPPED)

    def test_an_error_says_how_much_is_still_to_do(self):
        process = self.start_tiles(2)
        resource.prlimit(ranks_of(process.pid)[1], resource.RLIMIT_FSIZE, (1000, 1000))
        code, text = self.end(process)
        self.assertEqual(code, 5, text)
        (line,) = our_lines(text)
        told = FAILED.fullmatch(line)
        self.assertIsNotNone(told, line)
        counted = int(told[2]) - int(told[1])
        self.assertTrue(0 <= self.tiles_done(self.out / "stand") - counted <= 2, line)

    def start_tiles(self, ranks, **options):
        """Starts ranks and waits until they compute tiles."""
        process = self.start(ranks, self.out / "stand", *MANY_TILES, **options)
        while self.tiles_done(self.out / "stand") < 8 and process.poll() is None:
            time.sleep(0.01)
        return process

    def test_an_interrupt_is_answered_once(self):
        process = self.start_tiles(4)
        process.send_signal(signal.SIGINT)
        code, text = self.end(process)
        self.assertNotEqual(code, 0)
        lines = our_lines(text)
        self.assertEqual(len(lines), 1, text)
        self.assertIsNotNone(STOPPED.fullmatch(lines[0]), lines)

    def test_an_error_ends_all_ranks_with_its_code(self):
        scene = self.input("broken.csv", b"model,x,y,z\nno.glb,0,0,0\n")
        code, text = self.end(self.start(4, self.out / "stand", scene=scene))
        self.assertEqual(code, 3, text)
        self.assertEqual(len(our_lines(text)), 1, text)
        self.assertRegex(our_lines(text)[0], r"leafhull: error: rank \d: .*no\.glb")

    def test_a_part_is_not_for_ranks(self):
        code, text = self.end(self.start(2, self.out / "stand", "--tile-range", "1/2"))
        self.assertEqual(code, 2, text)
        (line,) = our_lines(text)
        self.assertRegex(line, r"error: rank \d: --tile-range .*\b2\b.* without mpirun\.")
        self.assertEqual(self.written(), [])
        flags = ("--voxel-size", "0.1", "--tile", "32")
        for part in ("1/2", "2/2"):
            code, text = self.end(self.start(1, self.out / "stand", *flags, "--tile-range", part))
            self.assertEqual(code, 0, text)
        code, text = self.end(self.start(2, self.out / "stand", *flags, "--finish"))
        self.assertEqual(code, 0, text)
        self.assertIn("tileset.json", self.written())

    def test_ranks_that_were_started_with_different_words(self):
        one = self.command(1, self.out / "stand")
        other = self.command(1, self.out / "other")
        command = [*one, ":", *other[other.index("-n") :]]
        result = subprocess.run(command, capture_output=True, text=True, timeout=100)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(len(our_lines(result.stderr)), 1, result.stderr)
        self.assertIn("another command", our_lines(result.stderr)[0])
