# SPDX-License-Identifier: Apache-2.0
"""Tests --points, --point-spacing and the styles that set them."""

import json

from command import ASH, CommandTest

DRAFT = ("--preset", "draft")


class Points(CommandTest):
    def report(self, tree, *flags):
        result = self.succeed("extract", tree, "-o", self.shape, "--report", "-", *DRAFT, *flags)
        return json.loads(result.stdout)

    def refuse(self, words, *flags):
        self.fail_with(2, words, "extract", self.tree, "-o", self.shape, *flags)

    def test_are_parts_of_leaf_area_unless_asked_for_vertices(self):
        area = self.report(self.tree)
        self.assertEqual(area["parameters"]["points"], "area")
        self.assertEqual(area["parameters"]["point_spacing"], 0.33)
        self.assertEqual(area["parameters"]["hollows"], "fill")
        vertices = self.report(self.tree, "--points", "vertices")
        self.assertEqual(vertices["parameters"]["points"], "vertices")
        self.assertEqual(vertices["parameters"]["hollows"], "keep")
        self.assertEqual(vertices["counts"]["leaf_points"], vertices["counts"]["leaf_vertices"])
        self.assertNotEqual(area["counts"]["leaf_points"], area["counts"]["leaf_vertices"])

    def test_leaf_area_and_what_of_it_is_covered(self):
        report = self.report(self.tree, "--coverage", "0.8")
        self.assertAlmostEqual(report["counts"]["leaf_area"], 300 * 0.25**2, places=6)
        self.assertAlmostEqual(report["metrics"]["covered"], 0.8, delta=0.005)
        of_vertices = self.report(self.tree, "--coverage", "0.8", "--points", "vertices")
        self.assertEqual(of_vertices["counts"]["leaf_area"], report["counts"]["leaf_area"])
        off_site = of_vertices["metrics"]["off_site_exact"] / of_vertices["counts"]["leaf_vertices"]
        self.assertAlmostEqual(of_vertices["metrics"]["covered"], 1 - off_site, places=9)

    def test_are_more_where_they_are_closer(self):
        counts = [
            self.report(ASH, "--point-spacing", spacing)["counts"]["leaf_points"]
            for spacing in ("0.1", "0.2", "0.4")
        ]
        self.assertGreater(counts[0], counts[1])
        self.assertGreater(counts[1], counts[2])

    def test_spacings_out_of_range(self):
        for spacing in ("0", "-0.1", "0.41", "1"):
            self.refuse(["--point-spacing", "(0, 0.4]"], "--point-spacing", spacing)
        for spacing in ("nan", "inf"):
            self.refuse(["--point-spacing", "finite"], "--point-spacing", spacing)
        self.refuse(["--point-spacing"], "--point-spacing", "third")
        self.refuse(["area, vertices"], "--points", "corners")

    def test_too_many(self):
        self.refuse(["ten million", "--point-spacing"], "--point-spacing", "1e-5")

    def test_styles(self):
        by_area = {
            "painterly": ("controlled", 3.5, 0.98),
            "thin": ("controlled", 4, 0.8),
            "fat": ("controlled", 7.5, 0.99),
            "previous": ("isotropic", 4, 0.96),
        }
        for style, (method, radius, coverage) in by_area.items():
            parameters = self.report(self.tree, "--style", style)["parameters"]
            self.assertEqual(parameters["style"], style)
            self.assertEqual(parameters["points"], "area")
            self.assertEqual(parameters["method"], method)
            self.assertEqual(parameters["radius_max"], radius)
            self.assertEqual(parameters["coverage"], coverage)
        at_vertices = {
            "paper-thin": ("controlled", 1.4, 2),
            "paper-fat": ("controlled", 1.6, 2),
            "paper-previous": ("isotropic", 1.5, 1.5),
        }
        for style, (method, radius, threshold) in at_vertices.items():
            parameters = self.report(ASH, "--style", style)["parameters"]
            self.assertEqual(parameters["style"], style)
            self.assertEqual(parameters["points"], "vertices")
            self.assertEqual(parameters["method"], method)
            self.assertEqual(parameters["radius_max"], radius)
            self.assertEqual(parameters["threshold"], threshold)
            self.assertIsNone(parameters["coverage"])

    def test_a_style_has_its_former_name(self):
        former = self.report(ASH, "--style", "luft-deussen")
        self.assertEqual(former["parameters"]["style"], "paper-previous")
        shape = self.shape.read_bytes()
        self.report(ASH, "--style", "paper-previous")
        self.assertEqual(self.shape.read_bytes(), shape)

    def test_styles_at_vertices_keep_their_values(self):
        for style, values in (("painterly", (2.5, 0.92)), ("thin", (1.4, None))):
            flags = ("--style", style, "--points", "vertices")
            parameters = self.report(ASH, *flags)["parameters"]
            self.assertEqual((parameters["radius_max"], parameters["coverage"]), values)
