# SPDX-License-Identifier: Apache-2.0
"""Tests --erosion and --dilation, the band by shares, and that styles differ."""

import json
import os
import pathlib
import unittest

import glb
import styles
from command import ASH, CommandTest

LEAFHULL = os.environ["LEAFHULL"]
SHARED = pathlib.Path(__file__).parents[3] / "shared" / "trees"


class Sliders(CommandTest):
    def report(self, *flags, preset="draft"):
        command = ("extract", ASH, "--preset", preset, "--report", "-", *flags)
        return json.loads(self.succeed(*command).stdout)

    def test_both_are_met_and_stay_where_they_are(self):
        for points, erosions, dilation in (
            ("area", (0.05, 0.2), 0.4),
            ("vertices", (0.2, 0.3), 0.5),
        ):
            for erosion in erosions:
                sliders = ("--erosion", f"{100 * erosion}%", "--dilation", repr(dilation))
                metrics = self.report(*sliders, "--points", points)["metrics"]
                self.assertAlmostEqual(metrics["erosion"], erosion, delta=0.01)
                self.assertAlmostEqual(metrics["dilation"], dilation, delta=0.01)

    def test_a_dilation_is_counted_in_64_voxels(self):
        found = self.report("--erosion", "0.05", "--dilation", "0.4", preset="standard")
        values = found["parameters"]
        again = self.report(
            *("--threshold", repr(values["threshold"])),
            *("--radius-max", repr(values["radius_max"])),
            preset="paper-64",
        )["metrics"]
        voxels = again["inside_voxels"] + again["on_voxels"]
        self.assertEqual(again["dilated_voxels"] / voxels, again["dilation"])
        self.assertAlmostEqual(again["dilation"], found["metrics"]["dilation"], places=3)

    def test_one_alone(self):
        eroded = self.report("--erosion", "0.1")
        self.assertAlmostEqual(eroded["metrics"]["erosion"], 0.1, delta=0.01)
        self.assertEqual(eroded["parameters"]["radius_max"], 3.5)
        dilated = self.report("--dilation", "0.4")
        self.assertAlmostEqual(dilated["metrics"]["dilation"], 0.4, delta=0.01)
        self.assertEqual(dilated["parameters"]["coverage"], 0.98)

    def test_pictures_sweeps_and_forests(self):
        sliders = ("--erosion", "0.1", "--dilation", "0.4", "--preset", "draft")
        self.succeed("render", ASH, *sliders, "--size", "64x64", "-o", self.out / "ash.png")
        self.succeed(
            *("sweep", ASH, "--preset", "draft", "-o", self.out / "sweep"),
            *("--erosion", "5%,20%", "--dilation", "0.4"),
        )
        rows = json.loads((self.out / "sweep" / "sweep.json").read_text())["rows"]
        for row, erosion in zip(rows, (0.05, 0.2)):
            self.assertAlmostEqual(row["metrics"]["erosion"], erosion, delta=0.01)
            self.assertAlmostEqual(row["metrics"]["dilation"], 0.4, delta=0.01)
        scene = self.input("stand.csv", f"model,x,y,z\n{ASH},0,0,0\n{ASH},6,0,0\n".encode())
        for merge in ("none", "canopy"):
            self.succeed("forest", scene, *sliders, "--merge", merge, "-o", self.out / merge)
        self.fail_with_scope(scene, sliders)

    def fail_with_scope(self, scene, sliders):
        command = ("forest", scene, *sliders, "--control-scope", "scene", "-o", self.out / "scene")
        result = self.run_command(*command)
        self.assertEqual(result.returncode, 2)
        self.assertIn("set for each model", result.stderr)

    def test_what_cannot_be_had(self):
        for words, *flags in (
            (["a dilation of 0.95", "goes up to 0."], "--dilation", "0.95", "--erosion", "0.05"),
            (["a dilation of 0.01", "goes down to 0."], "--dilation", "0.01", "--erosion", "0.05"),
        ):
            self.fail_with(2, words, "extract", ASH, "-o", self.shape, "--preset", "draft", *flags)
        corners = [(x, y, 0.0) for x in (0.0, 1.0) for y in (0.0, 1.0)]
        card = self.input("card.glb", glb.tree(corners, [(0, 1, 2), (2, 1, 3)]))
        words = ["an erosion of 0.3 ", "sheets of one density", "can"]
        self.fail_with(2, words, "extract", card, "-o", self.shape, "--erosion", "0.3")

    def test_usage(self):
        for words, *flags in (
            (["--erosion 0", "(0, 1)"], "--erosion", "0"),
            (["--erosion 1", "(0, 1)"], "--erosion", "100%"),
            (["--dilation 1", "(0, 1)"], "--dilation", "1"),
            (["--erosion", "--threshold"], "--erosion", "0.1", "--threshold", "2"),
            (["--erosion", "--coverage"], "--erosion", "0.1", "--coverage", "0.9"),
            (["--dilation", "--threshold"], "--dilation", "0.5", "--threshold", "40%"),
            (["--dilation", "--radius-max"], "--dilation", "0.5", "--radius-max", "2"),
            (["paper-thin", "--erosion"], "--dilation", "0.5", "--style", "paper-thin"),
            (["--band-high 20%", "--band-low 30%"], "--band-low", "30%", "--band-high", "20%"),
            (["--band-low-percent 130", "[0, 100]"], "--band-low", "130%"),
            (["--band-low-percent -1", "[0, 100]"], "--band-low", "-1%"),
            (["--band-low", "contradict"], "--band-low", "1", "--band-low-percent", "10"),
            (["upside down", "--band-high 1%"], "--band-low", "1", "--band-high", "1%"),
        ):
            self.fail_with(2, words, "extract", ASH, "-o", self.shape, *flags)

    def test_the_band_by_shares(self):
        density = self.report("--band-low", "30%", "--band-high", "70%")["density"]
        wide = self.report("--band-low", "0%", "--band-high", "100%")["density"]
        self.assertLess(wide["p1"], density["p1"])
        self.assertLess(density["p1"], density["p2"])
        self.assertLess(density["p2"], wide["p2"])


class Styles(CommandTest):
    def check(self, tree, *flags):
        self.assertEqual(list(styles.faults(styles.extractions(LEAFHULL, tree, flags))), [])

    def test_the_ash(self):
        self.check(ASH)

    @unittest.skipUnless(SHARED.is_dir(), f"NOT CHECKED styles on shared trees: no {SHARED}")
    def test_shared_trees(self):
        for name in ("birch", "aspen-52648", "real/birch-autumn", "real/cards-detailed-tree"):
            with self.subTest(tree=name):
                self.check(SHARED / f"{name}.glb")
