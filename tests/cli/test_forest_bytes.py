# SPDX-License-Identifier: Apache-2.0
"""The same scene and options give the same bytes, whichever process computes a tile and when."""

import json
import os
import subprocess
import unittest

from forests import COARSE, MPIRUN, UNDER_MPIRUN, ForestTest, files_in, mpirun

CANOPY = ("--merge", "canopy", *COARSE, "--tile", "64")


class SameBytes(ForestTest):
    def under_mpirun(self, ranks, scene, folder, *flags):
        result = subprocess.run(
            [*mpirun(ranks), os.environ["LEAFHULL"], "forest", scene, "-o", folder, *flags],
            env=os.environ | UNDER_MPIRUN, capture_output=True, text=True, timeout=300,
        )  # fmt: skip
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_forest_of_200_trees(self):
        scene = self.scatter(200)

        def run(name, *flags, ranks=0):
            folder = self.out / name
            flags = (*CANOPY, "--single", folder / "all.glb", *flags)
            if ranks:
                self.under_mpirun(ranks, scene, folder, *flags)
            else:
                self.forest(scene, name, *flags)
            return files_in(folder)

        alone = run("alone")
        self.assertIn("all.glb", alone)
        self.assertIn("manifest.json", alone)
        self.assertGreater(sum(name.startswith("tiles/0/") for name in alone), 20)
        for name, *flags in (
            ("1-thread", "--threads", "1"),
            ("2-threads", "--threads", "2"),
            ("1G", "--memory", "1G"),
            ("8G", "--memory", "8G"),
        ):
            with self.subTest(name):
                run(name, *flags)
                self.assert_same_files(self.out / name, alone)
        if not MPIRUN:
            self.skipTest("leafhull is built without MPI: nothing is known of its ranks")
        for ranks in (1, 2, 4):
            with self.subTest(ranks=ranks):
                run(f"{ranks}-ranks", ranks=ranks)
                self.assert_same_files(self.out / f"{ranks}-ranks", alone)

    @unittest.skipUnless(MPIRUN, "leafhull is built without MPI")
    def test_statistics_of_the_scene_over_ranks(self):
        scene = self.scatter(60)
        # The crowns are so dense that T is not a density that many leaves share.
        flags = (*COARSE, "--tile", "32", "--levels", "2", "--control-scope", "scene",
                 "--radius-max", "15", "--coverage", "0.7")  # fmt: skip
        self.forest(scene, "alone", *flags)
        for ranks in (2, 3):
            self.under_mpirun(ranks, scene, self.out / f"{ranks}", *flags)
            self.assert_same_files(self.out / f"{ranks}", files_in(self.out / "alone"))


class Parts(ForestTest):
    def setUp(self):
        super().setUp()
        self.scene = self.scatter(60)

    def part(self, number, folder, *flags):
        return self.forest(self.scene, folder, *flags, "--tile-range", f"{number}/3")

    def test_in_any_order_and_then_finished(self):
        for scope, order in (("model", (3, 1, 2)), ("scene", (2, 3, 1))):
            flags = (*COARSE, "--tile", "32", "--control-scope", scope)
            report = self.folder / "report.json"
            self.forest(self.scene, f"{scope}-whole", *flags, "--report", report)
            levels = json.loads(report.read_text())["levels"]
            for done, number in enumerate(order):
                early = self.run_command(
                    "forest", self.scene, "-o", self.out / scope, *flags, "--finish"
                )
                self.assertEqual(early.returncode, 2, early.stderr)
                self.assertRegex(
                    early.stderr, r"error: \d+ of \d+ tiles are still to do in .*--tile-range"
                )
                todo = int(early.stderr.split("error: ")[1].split()[0])
                every = int(early.stderr.split(" of ")[1].split()[0])
                self.assertEqual((todo == every, todo == 0), (done == 0, False))
                self.assertAlmostEqual(todo, every * (3 - done) / 3, delta=1)
                result = self.part(number, scope, *flags)
                self.assertEqual("still to do" in result.stderr, done < 2, result.stderr)
            self.forest(self.scene, scope, *flags, "--finish", "--report", report)
            self.assertEqual(json.loads(report.read_text())["levels"], levels)
            self.assert_same_files(self.out / scope, files_in(self.out / f"{scope}-whole"))

    def test_at_once(self):
        flags = (*COARSE, "--tile", "32")
        self.forest(self.scene, "whole", *flags, "--single", self.out / "whole" / "all.ply")
        parts = [
            subprocess.Popen(
                [
                    os.environ["LEAFHULL"], "forest", self.scene, "-o", self.out / "parts",
                    *flags, "--tile-range", f"{number}/3",
                ],
                stderr=subprocess.PIPE, text=True,
            )
            for number in (1, 2, 3)
        ]  # fmt: skip
        for part in parts:
            _, text = part.communicate(timeout=300)
            self.assertEqual(part.returncode, 0, text)
        self.forest(
            self.scene, "parts", *flags, "--finish", "--single", self.out / "parts" / "all.ply"
        )
        self.assert_same_files(self.out / "parts", files_in(self.out / "whole"))

    def test_a_part_is_done_once(self):
        flags = (*COARSE, "--tile", "32")
        first = self.part(1, "parts", *flags)
        self.assertNotIn("from an earlier run", first.stderr)
        self.assertIn("from an earlier run", self.part(1, "parts", *flags).stderr)
        # Another part may join a folder that holds one part's tiles.
        self.part(2, "parts", *flags)
        self.forest(self.scene, "parts", *flags, "--resume")
        self.forest(self.scene, "whole", *flags)
        self.assert_same_files(self.out / "parts", files_in(self.out / "whole"))

    def test_more_parts_than_tiles(self):
        scene = self.stand("ash.glb,10,10,10")
        flags = (*COARSE, "--tile", "512")
        for number in (1, 2, 3):
            self.forest(scene, "parts", *flags, "--tile-range", f"{number}/3")
        self.forest(scene, "parts", *flags, "--finish")
        self.forest(scene, "whole", *flags)
        self.assert_same_files(self.out / "parts", files_in(self.out / "whole"))
