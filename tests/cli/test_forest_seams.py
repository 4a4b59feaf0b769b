# SPDX-License-Identifier: Apache-2.0
"""The surface is the same however the scene is cut into tiles, and has no cracks between tiles."""

import collections
import json
import random

from command import ASH
from forests import COARSE, ForestTest, unordered, read_glb, read_ply, tiles_of


class Seams(ForestTest):
    def setUp(self):
        super().setUp()
        pick = random.Random(5)  # within the first tile of 512 voxels
        self.scene = self.stand(
            *(
                f"{pick.choice(('ash', 'elm', 'oak'))}.glb,{pick.uniform(10, 45):.3f},"
                f"{pick.uniform(10, 13):.3f},{pick.uniform(10, 45):.3f},"
                f"{pick.uniform(0, 360):.2f},{pick.uniform(0.8, 1.3):.3f}"
                for _ in range(60)
            )
        )

    def welded(self, tile, *flags, name="all.glb"):
        single = self.folder / name
        flags = flags if "--voxel-size" in flags else (*COARSE, *flags)
        self.forest(
            self.scene, "forest", "--restart", "--tile", tile, "--single", single,
            "--memory", "8G", *flags
        )
        surface = (read_ply if name.endswith(".ply") else read_glb)(single)
        self.assertGreater(len(surface.triangles), 2000)
        self.assert_closed(surface)
        return surface

    def same_for_all_tiles(self, *flags):
        whole = unordered(self.welded(512, *flags))
        self.assertEqual(len(tiles_of(self.out / "forest")), 1, "512 voxels hold all")
        for tile in (32, 64):
            found = unordered(self.welded(tile, *flags))
            self.assertGreater(len(tiles_of(self.out / "forest")), 8)
            self.assertTrue(found[0] == whole[0], "the same vertices, bit for bit")
            self.assertTrue(found[1] == whole[1], "the same triangles")

    def test_a_tree_that_has_grown(self):
        """The kernels reach as far as the tree is tall; a tile that misses some loses surface."""
        scene = self.stand("oak.glb,0,0,0,0,4")
        flags = ("--voxel-size", "0.2", "--radius-max", "16", "--method", "isotropic",
                 "--threshold-percent", "60")  # fmt: skip
        whole = {}
        for edge in ("32", "512"):
            single = self.out / edge / "all.ply"
            self.forest(scene, edge, *flags, "--tile", edge, "--single", single)
            whole[edge] = unordered(read_ply(single))
        self.assertGreater(len(whole["512"][0]), 10000)
        self.assertEqual(whole["32"], whole["512"])

    def test_painterly(self):
        self.same_for_all_tiles("--style", "painterly", "--min-component", "0.02")

    def test_thin(self):
        self.same_for_all_tiles("--style", "paper-thin", "--threshold", "0.5")

    def test_kernels_that_reach_far_over_seams(self):
        """The kernels reach farther than the bricks around a tile."""
        far = ("--voxel-size", "0.2", "--radius-max", "16")
        self.same_for_all_tiles(*far, "--method", "isotropic", "--threshold-percent", "60")
        self.same_for_all_tiles(*far, "--control-scope", "scene", "--threshold", "0.3")

    def test_statistics_of_the_scene(self):
        self.same_for_all_tiles("--control-scope", "scene", "--style", "paper-thin", "--threshold", "0.5")

    def test_small_pieces_go_over_seams_too(self):
        flags = ("--style", "painterly")
        every = self.welded(32, *flags, "--min-component", "0")
        few = self.welded(32, *flags, "--min-component", "0.3")
        self.assertLess(len(few.triangles), len(every.triangles))
        self.assertTrue(unordered(few)[1] < unordered(every)[1], "what stays is as it was")
        whole = self.welded(512, *flags, "--min-component", "0.3")
        self.assertTrue(unordered(whole) == unordered(few))

    def test_ply_and_glb_are_one_mesh(self):
        self.assertEqual(self.welded(32), self.welded(32, name="all.ply"))

    def test_tiles_have_the_bits_of_the_welded_mesh(self):
        vertices, triangles = unordered(self.welded(32))
        tiles = tiles_of(self.out / "forest")
        seen = sum((unordered(tile)[1] for tile in tiles.values()), collections.Counter())
        self.assertTrue(seen == triangles, "every triangle in one tile")
        self.assertEqual({v for tile in tiles.values() for v in tile.vertices}, set(vertices))


class Alone(ForestTest):
    def extract(self, tree, *flags):
        shape, report = self.folder / "shape.glb", self.folder / "shape.json"
        self.succeed(
            "extract", tree, "-o", shape, "--report", report, "--mesher", "bricks", *flags
        )
        return read_glb(shape), json.loads(report.read_text())["parameters"]["threshold"]

    def test_one_tree_is_as_it_is_extracted(self):
        self.input("big.glb", ASH.read_bytes())
        for tree, voxel, *flags in (
            ("oak.glb", 0.15),
            ("oak.glb", 0.15, "--style", "paper-thin", "--threshold", "0.5"),
            ("oak.glb", 0.15, "--coverage", "0.8", "--min-component", "0.05"),
            ("oak.glb", 0.15, "--threshold-percent", "60", "--method", "isotropic"),
            ("big.glb", 1.5),
        ):
            flags = ("--voxel-size", voxel, *flags)
            mesh, threshold = self.extract(self.folder / tree, *flags)
            for scope in ("model", "scene"):
                with self.subTest(tree=tree, flags=flags, scope=scope):
                    single, report = self.folder / "all.glb", self.folder / "forest.json"
                    self.forest(
                        self.stand(f"{tree},0,0,0"), "forest", "--restart", "--tile", "64",
                        "--control-scope", scope, "--single", single, "--report", report, *flags,
                    )  # fmt: skip
                    found = json.loads(report.read_text())["levels"][0]["threshold"]
                    if scope == "scene" and "--threshold" not in flags:
                        # Over a scene, a coverage is met only to a step of a histogram.
                        self.assertAlmostEqual(found / threshold, 1, delta=1e-4)
                        continue
                    self.assertEqual(found, threshold)
                    self.assert_same_shape(read_glb(single), mesh, voxel)

    def assert_same_shape(self, found, expected, voxel):
        """Newton's iteration starts from vertices that are at most 2^-14 voxels apart. Nearly all end
        within a thousandth of a voxel, the rounding of tiles; where N is flat some end farther."""
        self.assertEqual(len(found.vertices), len(expected.vertices))
        self.assertEqual(len(found.triangles), len(expected.triangles))
        cells = {}
        for vertex in expected.vertices:
            cells.setdefault(tuple(round(c / (voxel / 16)) for c in vertex[:3]), []).append(vertex)
        steps, aside = (-1, 0, 1), 0
        for vertex in found.vertices:
            x, y, z = (round(c / (voxel / 16)) for c in vertex[:3])
            near = [
                other
                for i in steps for j in steps for k in steps
                for other in cells.get((x + i, y + j, z + k), ())
            ]  # fmt: skip
            apart = min(
                (max(abs(a - b) for a, b in zip(vertex[:3], other[:3])) for other in near),
                default=1e9,
            )
            self.assertLessEqual(apart, 0.01 * voxel, vertex)
            aside += apart > 0.001 * voxel
        self.assertLess(aside, 0.01 * len(found.vertices))
