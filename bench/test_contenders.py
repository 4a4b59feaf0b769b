#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every contender of the bench on the example tree: what it says, and that its counts make sense.
BENCH is the folder of the programs, TREE the tree."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BENCH = pathlib.Path(os.environ["BENCH"])
TREE = os.environ["TREE"]

CONTENDERS = {
    "leafhull isotropic": ("contender_leafhull", "--method", "isotropic"),
    "leafhull controlled": ("contender_leafhull", "--method", "controlled", "--threads", "1"),
    "published isotropic": ("contender_published", "--method", "isotropic"),
    "published controlled": ("contender_published", "--method", "controlled"),
    "OpenVDB rasterizeSmoothSpheres": ("contender_rasterize_spheres", "--threads", "1"),
    "OpenVDB ParticlesToLevelSet": ("contender_particles_to_level_set",),
    "CGAL alpha_wrap_3": ("contender_alpha_wrap",),
}


def run(program, *arguments, talk=None):
    return subprocess.run(
        [BENCH / program, *arguments], input=talk, capture_output=True, text=True, check=False
    )


class Contenders(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.cases = {}
        for resolution, style in ((32, "painterly"), (64, "r1.5")):
            folder = pathlib.Path(cls.folder.name) / style
            made = run("bench_case", TREE, "--resolution", str(resolution), "--style", style, "-o",
                       folder)
            assert made.returncode == 0, made.stderr
            cls.cases[style] = folder / "case.json"

    def lines(self, case, program, *arguments):
        done = run(program, case, *arguments, talk="run\nrun\nquit\n")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return [json.loads(line) for line in done.stdout.splitlines()]

    def test_each_runs_twice_alike(self):
        for style, case in self.cases.items():
            for name, command in CONTENDERS.items():
                with self.subTest(name, style=style):
                    ready, first, second = self.lines(case, *command)
                    self.assertEqual((ready["ready"], ready["name"]), (True, name))
                    self.assertTrue(ready["version"])
                    for key in ("vertices", "faces"):
                        self.assertGreater(first[key], 100)
                        self.assertEqual(first[key], second[key])
                    for result in (first, second):
                        self.assertGreater(result["mesh"], 0)
                        self.assertGreater(result["total"], 0)
                        self.assertGreater(result["peak_memory_bytes"], 0)

    def test_pictures(self):
        case = self.cases["painterly"]
        for surface, stage in (("direct", "bricks"), ("mesh", "polygonise")):
            for look in ("phong", "watercolour"):
                with self.subTest(surface=surface, look=look):
                    options = ("--surface", surface, "--look", look, "--size", "64")
                    ready, *runs = self.lines(case, "contender_picture", *options)
                    self.assertEqual((ready["ready"], len(runs)), (True, 2))
                    for result in runs:
                        stages = result["stages"]
                        self.assertIn(stage, stages)
                        self.assertAlmostEqual(sum(stages.values()), result["total"])
                        for seconds in (stages["scene"], stages["rays"], stages["paint"]):
                            self.assertGreater(seconds, 0)
                        self.assertGreater(result["redraw_seconds"], result["repaint_seconds"])
                        self.assertIn(result["on_gpu"], (0, 1))

    def test_leafhull_and_published_make_surfaces_of_one_size(self):
        for style, case in self.cases.items():
            for method in ("isotropic", "controlled"):
                with self.subTest(method, style=style):
                    ours = self.lines(case, *CONTENDERS[f"leafhull {method}"])[1]
                    theirs = self.lines(case, *CONTENDERS[f"published {method}"])[1]
                    self.assertAlmostEqual(ours["vertices"] / theirs["vertices"], 1, delta=0.15)

    def test_a_case_says_where_its_leaf_vertices_are(self):
        for style, file in self.cases.items():
            case = json.loads(file.read_text())
            self.assertEqual(case["style"], style)
            for key, doubles in (("points", 3), ("frames", 8)):
                self.assertEqual(os.path.getsize(case[key]), 8 * doubles * case["count"])

    def test_synthetic_crowns_keep_their_density(self):
        thresholds = []
        for count in (20000, 80000):
            folder = pathlib.Path(self.folder.name) / str(count)
            made = run("bench_case", f"synthetic:{count}", "--radius", "0.4", "--voxel", "0.2",
                       "-o", folder)
            self.assertEqual(made.returncode, 0, made.stderr)
            result = self.lines(folder / "case.json", "contender_leafhull", "--method", "isotropic")
            thresholds.append(result[1]["threshold"])
        self.assertAlmostEqual(thresholds[0] / thresholds[1], 1, delta=0.2)

    def test_a_failure_is_a_line(self):
        done = run("contender_published", "no such case")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no such case", json.loads(done.stdout)["error"])
        done = run("contender_published", self.cases["painterly"], talk="walk\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("walk", json.loads(done.stdout.splitlines()[1])["error"])

    def test_the_limit(self):
        done = run("bench_limit", "--pairs", self.cases["painterly"])
        self.assertEqual(done.returncode, 0, done.stderr)
        page = json.loads(done.stdout)
        self.assertGreater(page["fma_gflops"], 0)
        self.assertGreater(page["bandwidth_gbs"], 0)
        field = page["stages"]["field"]
        self.assertGreater(field["pairs_inside"], 0)
        self.assertGreaterEqual(field["pairs_evaluated"], field["pairs_inside"])
        self.assertGreater(field["device_seconds"], 0)


if __name__ == "__main__":
    unittest.main()
