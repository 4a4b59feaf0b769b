# SPDX-License-Identifier: Apache-2.0
import itertools
import json

import glb
from command import ASH, CommandTest

DRAFT = ("--preset", "paper-64")


class Extract(CommandTest):
    def extract(self, tree, *flags):
        """The bytes of the shape, of the kernels, and the report."""
        kernels = self.out / "kernels.ply"
        result = self.succeed(
            *("extract", tree, "-o", self.shape, "--save-kernels", kernels, "--report", "-"), *flags
        )
        return self.shape.read_bytes(), kernels.read_bytes(), json.loads(result.stdout)

    def assert_same(self, first, second):
        self.assertEqual(first[0], second[0], "the shapes differ")
        self.assertEqual(first[1], second[1], "the kernels differ")
        for part in ("parameters", "density", "metrics"):
            self.assertEqual(first[2][part], second[2][part])

    def test_ash(self):
        _, _, report = self.extract(ASH)
        self.assertEqual(report["parameters"]["style"], "painterly")
        self.assertEqual(report["parameters"]["resolution"], 128)
        self.assertEqual(report["input"], str(ASH))
        self.assertEqual(report["command"][1:3], ["extract", str(ASH)])
        self.assertGreater(report["counts"]["leaves"], 1000)
        self.assertGreater(report["counts"]["mesh_triangles"], 1000)
        self.assertGreater(report["peak_memory_bytes"], 1 << 20)

    def test_seconds_name_every_stage_and_end_with_the_total(self):
        _, _, report = self.extract(self.tree, *DRAFT)
        seconds = report["seconds"]
        self.assertEqual(list(seconds)[:3], ["read", "leaves", "device"])
        self.assertEqual(list(seconds)[-2:], ["write", "total"])
        stages = sum(time for stage, time in seconds.items() if stage != "total")
        self.assertLessEqual(stages, seconds["total"] * 1.01)
        self.assertGreater(stages, seconds["total"] * 0.8)

    def test_summary(self):
        joined = (*DRAFT, "--radius-max", "12")  # fewer than 50 pieces, so no warning about them
        result = self.succeed("extract", self.tree, "-o", self.shape, *joined)
        leaves, *rest = result.stderr.splitlines()
        self.assertEqual(leaves, "leaves: leaf (name, shape)")
        self.assertEqual(len(rest), 1, result.stderr)
        for word in ("vertices", "triangles", "component", "T = ", "shape.glb"):
            self.assertIn(word, result.stderr)
        quiet = self.succeed("extract", self.tree, "-o", self.shape, *DRAFT, "-q")
        self.assertEqual(quiet.stderr, "")
        loud = self.succeed("extract", self.tree, "-o", self.shape, *DRAFT, "-v")
        for word in ("device", "leaves", "read", "write", "total"):
            self.assertIn(word, loud.stderr)

    def test_styles(self):
        expected = {
            "painterly": ("controlled", 3.5, 0.8, 0.98),
            "thin": ("controlled", 4, 0.7, 0.8),
            "fat": ("controlled", 7.5, 1.0, 0.99),
            "previous": ("isotropic", 4, None, 0.96),
            "paper-thin": ("controlled", 1.4, 0.7, None),
            "paper-fat": ("controlled", 1.6, 1.0, None),
            "paper-previous": ("isotropic", 1.5, None, None),
        }
        thresholds = {"paper-thin": 2, "paper-fat": 2, "paper-previous": 1.5}
        for style, (method, radius, flatness, coverage) in expected.items():
            _, _, report = self.extract(ASH, "--style", style, *DRAFT)
            parameters = report["parameters"]
            self.assertEqual(parameters["style"], style)
            self.assertEqual(parameters["method"], method)
            self.assertEqual(parameters["radius_max"], radius)
            self.assertEqual(parameters["coverage"], coverage)
            self.assertIsNone(parameters["threshold_percent"])
            if flatness:
                self.assertEqual(parameters["flatness"], flatness)
            points = "vertices" if style in thresholds else "area"
            self.assertEqual(parameters["points"], points)
            if style in thresholds:
                self.assertEqual(parameters["threshold"], thresholds[style])
        _, _, report = self.extract(ASH, "--style", "luft-deussen", *DRAFT)
        self.assertEqual(report["parameters"]["style"], "paper-previous", "the old name")

    def test_options_in_any_order(self):
        pairs = [("--style", "paper-thin"), ("--threshold", "30%"), ("--radius-max", "3")]
        results = [
            self.extract(self.tree, *DRAFT, *itertools.chain(*order))
            for order in itertools.permutations(pairs)
        ]
        for other in results[1:]:
            self.assert_same(results[0], other)
        parameters = results[0][2]["parameters"]
        self.assertEqual(parameters["threshold_percent"], 30)
        self.assertIsNone(parameters["coverage"])
        self.assertEqual(parameters["radius_max"], 3)
        self.assertAlmostEqual(
            parameters["threshold"], 0.3 * results[0][2]["density"]["mean"], places=5
        )

    def test_flags_before_the_tree(self):
        flags = ("extract", *DRAFT, "--leaves", "*leaf*", "-o", self.shape, self.tree)
        self.succeed(*flags)
        self.assertEqual(self.written(), ["shape.glb"])

    def test_a_percentage_has_two_spellings(self):
        first = self.extract(self.tree, *DRAFT, "--threshold", "40%")
        self.assert_same(first, self.extract(self.tree, *DRAFT, "--threshold-percent", "40"))

    def test_same_bytes_again(self):
        self.assert_same(self.extract(ASH, *DRAFT), self.extract(ASH, *DRAFT))

    def test_same_bytes_from_one_thread_and_two(self):
        for mesher in ("vdb", "bricks"):
            flags = (*DRAFT, "--mesher", mesher, "--threads")
            self.assert_same(self.extract(ASH, *flags, "1"), self.extract(ASH, *flags, "2"))

    def test_a_report_does_not_change_the_shape(self):
        shape = self.out / "alone.glb"
        self.succeed("extract", ASH, *DRAFT, "-o", shape)
        self.assertEqual(self.extract(ASH, *DRAFT)[0], shape.read_bytes())

    def test_dense_is_the_same(self):
        band = self.extract(ASH, *DRAFT)
        dense = self.extract(ASH, *DRAFT, "--dense")
        dense[2]["parameters"]["dense"] = False
        self.assert_same(band, dense)
        self.assertLess(
            band[2]["counts"]["evaluated_voxels"], dense[2]["counts"]["evaluated_voxels"]
        )

    def test_no_snap_moves_vertices_only(self):
        flags = (*DRAFT, "--min-component", "0")
        snapped, _, first = self.extract(self.tree, *flags)
        loose, _, second = self.extract(self.tree, *flags, "--no-snap")
        self.assertTrue(first["parameters"]["snap"])
        self.assertFalse(second["parameters"]["snap"])
        self.assertEqual(first["counts"], second["counts"])
        self.assertNotEqual(glb.vertices(snapped), glb.vertices(loose))

    def test_far_from_the_origin_is_the_same_shape(self):
        shift = 10000.0  # a whole number of voxels, so the samples are the same
        flags = ("--voxel-size", "0.125", "--points", "vertices")
        positions, triangles = glb.cards()
        near, _, near_report = self.extract(self.tree, *flags)
        moved = [[x + shift, y, z] for x, y, z in positions]
        for data in (
            glb.tree(positions, triangles, translation=(shift, 0, 0)),
            glb.tree(moved, triangles),
        ):
            far, _, far_report = self.extract(self.input("far.glb", data), *flags)
            near_metrics, far_metrics = dict(near_report["metrics"]), far_report["metrics"]
            # A dilation is counted on its own lattice, whose voxels do not divide the shift.
            self.assertAlmostEqual(
                near_metrics.pop("dilation"), far_metrics.pop("dilation"), delta=0.005
            )
            self.assertEqual(near_metrics, far_metrics)
            self.assertEqual(near_report["counts"], far_report["counts"])
            for a, b in zip(glb.vertices(near), glb.vertices(far), strict=True):
                for axis, offset in enumerate((shift, 0, 0)):
                    self.assertAlmostEqual(a[axis] + offset, b[axis], delta=0.125e-3)

    def test_options_without_effect_are_named(self):
        flags = ("--method", "isotropic", "--flatness", "0.5", "--band-low", "1")
        result = self.succeed("extract", self.tree, "-o", self.shape, *DRAFT, *flags)
        for flag in ("--flatness", "--band-low"):
            self.assertIn(f"leafhull: warning: {flag} has no effect", result.stderr)

    def test_no_progress_bar_away_from_a_terminal(self):
        result = self.succeed("extract", ASH, "-o", self.shape, *DRAFT)
        self.assertNotIn("\r", result.stderr)
