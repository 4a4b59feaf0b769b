# SPDX-License-Identifier: Apache-2.0
import json
import os
import shlex
import signal
import subprocess
import unittest

import glb
from command import CommandTest
from test_interrupt import listen_to_interrupts
from test_output import FULL, disk

CLAIMS = ["1a", "1b", "2a", "2b", "3a", "3b", "4a", "4b", "5a", "5b", "6"]
WORDS = {"holds": "holds", "fails": "does not hold", "open": "cannot be told"}


class Study(CommandTest):
    def setUp(self):
        super().setUp()
        self.report = self.out / "report"

    def study(self):
        return json.loads((self.report / "study.json").read_text())

    def bare(self):
        """A tree with too few leaves for a surface."""
        return self.input("bare.glb", glb.tree(*glb.cards(count=3)))

    def test_report_of_two_trees_of_one_name(self):
        other = self.folder / "other"
        other.mkdir()
        second = other / "tree.glb"
        second.write_bytes(glb.tree(*glb.cards(seed=2)))
        result = self.succeed("study", self.tree, second, "-o", f"{self.report}/")
        self.assertIn("report.html", result.stderr)
        self.assertIn("report.html", self.written())

        study = self.study()
        self.assertEqual([tree["name"] for tree in study["trees"]], ["tree", "tree (2)"])
        self.assertEqual(
            shlex.split(study["command"]),
            ["leafhull", "study", "tree.glb", "tree.glb", "-o", "report"],
        )
        self.assertNotIn(str(self.folder), json.dumps(study))
        for tree in study["trees"]:
            self.check_band(tree)
        blocks = result.stdout.strip().split("\n\n")
        self.assertEqual(len(blocks), 2)
        for tree, block in zip(study["trees"], blocks):
            self.check_block(tree, block.splitlines())

    def check_band(self, tree):
        band = tree["band"]
        self.assertIsNone(band["failure"])
        shares = [row["off_site_sampled"] / tree["leaf_vertices"] for row in band["ends"]]
        for share, paper in zip(shares, (172, 24766)):
            self.assertAlmostEqual(share, paper / 52648, delta=0.001)
        (verdict,) = (v for v in tree["readings"][0]["verdicts"] if v["number"] == "2b")
        self.assertIn("Where the band lies", verdict["figures"])

    def check_block(self, tree, lines):
        self.assertEqual(lines[0], f"{tree['name']}: {tree['leaf_vertices']:,} leaf vertices")
        self.assertEqual([line.split()[0] for line in lines[2:]], CLAIMS)
        for i, line in enumerate(lines[2:]):
            outcomes = [reading["verdicts"][i]["outcome"] for reading in tree["readings"]]
            self.assertIn(f"  {WORDS[outcomes[0]]}  ", line)
            self.assertTrue(line.endswith(f" {outcomes.count('holds')} of 8"), line)

    def test_no_surface_anywhere_is_a_result(self):
        self.succeed("study", self.bare(), "-o", self.report, "-q")
        (tree,) = self.study()["trees"]
        for reading in tree["readings"]:
            self.assertTrue(all(row["empty"] for row in reading["table1"]))
            self.assertEqual({verdict["outcome"] for verdict in reading["verdicts"]}, {"open"})

    def test_a_report_is_replaced(self):
        for _ in range(2):
            self.succeed("study", self.bare(), "-o", self.report)
        self.assertEqual(self.study()["schema"], "leafhull-study/1")

    def test_usage(self):
        self.fail_with(2, ["TREE"], "study", "-o", self.report)
        self.fail_with(2, ["-o"], "study", self.tree)
        self.fail_with(2, ["twice"], "study", self.tree, self.tree, "-o", self.report)
        link = self.folder / "link.glb"
        link.symlink_to(self.tree)
        self.fail_with(2, ["link.glb", "twice"], "study", self.tree, link, "-o", self.report)
        self.fail_with(
            2, ["--threshold"], "study", self.tree, "--threshold", "2", "-o", self.report
        )

    def test_every_tree_is_read_before_the_first_is_studied(self):
        broken = self.input("broken.glb", b"glTF")
        for last in (broken, self.folder / "missing.glb"):
            self.fail_with(3, [last.name], "study", self.tree, last, "-o", self.report)
        self.fail_with(3, ["--leaves"], "study", self.tree, "--leaves", "no*", "-o", self.report)

    def test_folder_is_looked_at_before_a_tree_is_read(self):
        file = self.folder / "file"
        file.write_text("precious")
        for folder in (file, file / "report"):
            self.fail_with(5, [str(folder)], "study", "no.glb", "-o", folder)
        self.assertEqual(file.read_text(), "precious")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_unwritable_folder(self):
        self.out.chmod(0o555)
        self.addCleanup(self.out.chmod, 0o755)
        for folder in (self.out, self.report):
            self.fail_with(5, ["out"], "study", "no.glb", "-o", folder)

    def test_full_disk_leaves_nothing(self):
        bare = self.bare().read_bytes()
        trees = [self.input(f"bare{i}.glb", bare) for i in range(12)]  # the report grows beyond FULL
        self.succeed("study", *trees, "-o", self.folder)
        self.assertGreater((self.folder / "report.html").stat().st_size, FULL)
        for folder in (self.report, self.out):
            self.fail_with(5, ["report.html"], "study", *trees, "-o", folder, **disk(FULL))

    def test_interrupted_while_files_are_written_it_leaves_nothing(self):
        command = [os.environ["LEAFHULL"], "study", str(self.bare()), "-o", str(self.out)]
        for _ in range(5):
            process = subprocess.Popen(
                command,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                preexec_fn=listen_to_interrupts,
            )
            while process.poll() is None and not self.written():
                pass
            process.send_signal(signal.SIGINT)
            _, text = process.communicate(timeout=60)
            if process.returncode == -signal.SIGINT:
                return self.assertEqual(self.written(), [], text)
            for name in self.written():
                (self.out / name).unlink()
        self.fail("no run could be caught while writing")
