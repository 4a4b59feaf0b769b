# SPDX-License-Identifier: Apache-2.0
"""What a power cut leaves: content reaches the disk before its name, and names before the journal's
line about them."""

import os
import pathlib
import unittest

from forests import COARSE, ForestTest, files_in

PRELOADED = os.environ.get("DISK_CALLS_LIBRARY", "")
DRAFT = ("--preset", "draft")
TILED = (*COARSE, "--tile", "32", "--levels", "2")


@unittest.skipUnless(PRELOADED, "nothing is known of the calls: DISK_CALLS_LIBRARY is not set")
class Disk(ForestTest):
    def setUp(self):
        super().setUp()
        self.log = self.folder / "calls"

    def calls_of(self, *arguments, **options):
        self.log.write_text("")
        env = {"LD_PRELOAD": PRELOADED, "DISK_CALLS": str(self.log)}
        self.succeed(*arguments, env=env, **options)
        calls = [line.split("\t") for line in self.log.read_text().splitlines()]
        return [call for call in calls if call[1].startswith(str(self.out))]

    def assert_lasts(self, calls, least_lines=0):
        """Replays the calls on a disk that keeps only what was synced."""
        content, names = set(), set()  # files and folders that are not on the disk
        renamed, lines = 0, 0
        for call, file, name in calls:
            if call == "write":
                if file.endswith(".jsonl"):
                    lines += 1
                    self.assertNotIn(file, content, "the line before is not on the disk")
                    self.assertEqual(names, set(), f"before a line of {file}")
                content.add(file)
            elif call == "fsync":
                content.discard(file)
                names.discard(file)
            else:
                renamed += 1
                self.assertNotIn(file, content, f"{name} gets its name before its content")
                if not name.endswith(".tmp"):
                    names.add(os.path.dirname(name))
        self.assertEqual({file for file in content if pathlib.Path(file).exists()}, set())
        self.assertEqual(names, set(), "names that are not on the disk")
        self.assertGreaterEqual(lines, least_lines)
        return renamed

    def test_a_shape(self):
        flags = ("extract", self.tree, *DRAFT, "-o", self.shape, "--report", self.out / "shape.json")
        self.assertEqual(self.assert_lasts(self.calls_of(*flags)), 2)
        again = self.calls_of(*flags)
        self.assertEqual(self.assert_lasts(again), 2)
        self.assertEqual([call for call, *_ in again].count("exchange"), 2)

    def test_a_sweep(self):
        flags = ("sweep", self.tree, *DRAFT, "--threshold", "1,2", "-o", self.out)
        self.assertGreaterEqual(self.assert_lasts(self.calls_of(*flags), 3), 5)
        self.assertGreaterEqual(self.assert_lasts(self.calls_of(*flags, "--restart"), 3), 5)

    def test_a_forest(self):
        flags = ("forest", self.scatter(20), *TILED, "-o", self.out, "--single",
                 self.out / "all.glb", "--min-component", "0.3")  # fmt: skip
        calls = self.calls_of(*flags)
        tiles = sum("/tiles/" in name for _, _, name in calls)
        self.assertGreater(tiles, 5)
        self.assertGreater(self.assert_lasts(calls, tiles // 4), 3 * tiles)
        self.assert_lasts(self.calls_of(*flags, "--restart"))

    def test_new_folders_up_to_the_first_that_was_there(self):
        scene = self.scatter(5)
        for name in ("one/two/three", "four/"):
            calls = self.calls_of("forest", scene, *TILED, "-o", name, cwd=self.out)
            self.assert_lasts(calls)
            synced = {file for call, file, _ in calls if call == "fsync"}
            folder = self.out / name
            while folder != self.out:
                folder = folder.parent
                self.assertIn(str(folder), synced, f"{folder} has a new folder in it")

    def test_a_forest_of_instances(self):
        flags = ("forest", self.scatter(20), *COARSE, "--merge", "none", "-o", self.out)
        self.assertGreaterEqual(self.assert_lasts(self.calls_of(*flags)), 3)

    def test_a_disk_that_takes_nothing(self):
        self.shape.write_text("before")
        scene = self.scatter(5)
        for flags in (
            ("extract", self.tree, *DRAFT, "-o", self.shape),
            ("sweep", self.tree, *DRAFT, "--threshold", "1,2", "-o", self.out / "sweep"),
            ("forest", scene, *TILED, "-o", self.out / "forest"),
        ):
            env = {"LD_PRELOAD": PRELOADED, "DISK_CALLS_FAIL": "1"}
            result = self.run_command(*flags, env=env)
            self.assertEqual(result.returncode, 5, result.stderr)
            self.assertIn("Input/output error", result.stderr)
        left = files_in(self.out)
        self.assertEqual(left.pop("shape.glb"), b"before")
        self.assertEqual({data for data in left.values()} - {b""}, set(), left.keys())
