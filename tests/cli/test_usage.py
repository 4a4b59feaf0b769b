# SPDX-License-Identifier: Apache-2.0
import os
import socket
import subprocess

from command import CommandTest


class Usage(CommandTest):
    def refuse(self, words, *flags):
        self.fail_with(2, words, "extract", self.tree, "-o", self.shape, *flags)

    def test_verbs(self):
        self.fail_with(2, ["extract, inspect, suggest, sweep, study, render, forest, scatter, devices"])
        self.fail_with(2, ["'extrat'", "Did you mean extract?"], "extrat", self.tree)
        self.fail_with(2, ["--verbose", "before the verb"], "--verbose", "extract", self.tree)

    def test_no_tree(self):
        self.fail_with(2, ["no TREE"], "extract", "-o", self.shape)
        self.fail_with(2, ["no TREE"], "inspect")

    def test_two_trees(self):
        self.refuse(["other.glb", "one TREE"], "other.glb")

    def test_no_output(self):
        self.fail_with(2, ["-o shape.glb"], "extract", self.tree)

    def test_output_without_known_extension(self):
        self.fail_with(2, ["extension", ".glb"], "extract", self.tree, "-o", self.out / "shape")
        self.fail_with(2, [".fbx", ".glb"], "extract", self.tree, "-o", self.out / "shape.fbx")

    def test_output_is_the_input(self):
        before = self.tree.read_bytes()
        self.fail_with(2, ["tree.glb"], "extract", self.tree, "-o", self.tree)
        self.assertEqual(self.tree.read_bytes(), before)

    def test_one_output_twice(self):
        self.refuse(["shape.glb"], "-o", self.shape)

    def test_unknown_flags(self):
        self.refuse(["--treshold", "Did you mean --threshold?"], "--treshold", "2")
        self.refuse(["-x", "--help"], "-x")

    def test_unknown_names_list_the_valid_ones(self):
        self.refuse(["Did you mean painterly?", "thin, fat, previous, paper-thin"], "--style", "painterli")
        self.refuse(["isotropic, uncontrolled, controlled"], "--method", "q")
        self.refuse(["crown, leaf, model"], "--radius-unit", "mm")
        self.refuse(["stddev, variance"], "--spread", "sigma")
        self.refuse(["exact, grid"], "--density", "fast")
        self.refuse(["vdb, bricks"], "--mesher", "cubes")
        self.refuse(["paper-32", "film"], "--preset", "huge")
        self.refuse(["vector, work-item"], "--variant", "scalar")

    def test_contradictions(self):
        thresholds = [("--threshold", "2"), ("--threshold-percent", "40"), ("--coverage", "0.9")]
        sizes = [("--preset", "draft"), ("--resolution", "48"), ("--voxel-size", "0.1")]
        thresholds.append(("--erosion", "0.1"))
        for choices, words in ((thresholds, "one of the four"), (sizes, "one of the three")):
            for first in choices:
                for second in choices:
                    if first != second:
                        self.refuse(["contradict", words], *first, *second)
        self.refuse(["contradict"], "--threshold", "40%", "--coverage", "0.9")
        self.refuse(["--threshold", "more than once"], "--threshold", "2", "--threshold", "40%")
        self.refuse(["--band-high 1", "--band-low 2"], "--band-low", "2", "--band-high", "1")
        self.refuse(["--adaptivity 0.5", "vdb"], "--mesher", "bricks", "--adaptivity", "0.5")
        self.refuse(["--quiet", "--verbose"], "-q", "-v")

    def test_not_numbers(self):
        for text in ("x", "", "2x", "1,5", "--dense", "1e999"):
            self.refuse(["--threshold"], "--threshold", text)
        for text in ("nan", "inf", "-inf", "nan%", "inf%"):
            self.refuse(["--threshold", "finite"], "--threshold", text)
        for flag in ("--radius-max", "--leaf-scale", "--voxel-size", "--band-low", "--adaptivity"):
            for text in ("nan", "inf"):
                self.refuse([flag, "finite"], flag, text)
        self.refuse(["--falloff", "whole"], "--falloff", "2.5")
        self.refuse(["--resolution", "whole"], "--resolution", "64.5")

    def test_out_of_range(self):
        for flag, text in (
            ("--threshold", "0"),
            ("--threshold", "-1"),
            ("--threshold", "0%"),
            ("--coverage", "0"),
            ("--coverage", "1.01"),
            ("--radius-max", "0"),
            ("--flatness", "0"),
            ("--flatness", "1.5"),
            ("--falloff", "0"),
            ("--falloff", "4"),
            ("--leaf-scale", "-1"),
            ("--min-component", "-0.1"),
            ("--min-component", "2"),
            ("--resolution", "0"),
            ("--resolution", "-64"),
            ("--voxel-size", "0"),
            ("--adaptivity", "1.1"),
            ("--threads", "0"),
            ("--threads", "1025"),
            ("--threads", "two"),
        ):
            self.refuse([flag, "range"], flag, text)

    def test_ellipse(self):
        self.refuse(["six numbers"], "--ellipse", "0.5,0.5,0.5,0")
        self.refuse(["six numbers"], "--ellipse", "1,2,3,4,5,6,7")
        self.refuse(["not a number"], "--ellipse", "0.5,0.5,a,0,0,0.5")
        self.refuse(["area"], "--ellipse", "0.5,0.5,0.5,0,1,0")

    def test_missing_value(self):
        self.refuse(["--threshold needs a value"], "--threshold")

    def test_a_line_is_written_at_once(self):
        """If it were written in parts, ranks that share a terminal would mix their lines."""
        for arguments in (("--verbose",), ("--band-low", "0.5", "--band-high", "0.25")):
            # Each write to such a socket is a separate message.
            ours, its = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
            command = [os.environ["LEAFHULL"], "extract", self.tree, "-o", self.shape, *arguments]
            with ours:
                with its:
                    subprocess.run([str(word) for word in command], stderr=its, timeout=300)
                writes = [text.decode() for text in iter(lambda: ours.recv(1 << 16), b"")]
            self.assertTrue(writes)
            for text in writes:
                self.assertRegex(text, r"\A[^\n]+\n\Z")

    def test_errors_come_before_the_tree_is_read(self):
        self.fail_with(2, ["--style"], "extract", "no.glb", "-o", self.shape, "--style", "x")

    def test_a_resolution_that_does_not_fit(self):
        for size in (("--resolution", "1000000"), ("--voxel-size", "1e-7")):
            for dense in ((), ("--dense",)):
                self.refuse(["GiB", "fits"], *size, *dense)
