# SPDX-License-Identifier: Apache-2.0
import json
import shlex
import struct

import styles
from command import ASH, CommandTest

COARSE = ("--preset", "paper-32")


def report_of(command):
    """The words of a suggested command, with a report in place of its shape."""
    words = shlex.split(command)
    return [*words[1 : words.index("-o")], "--report", "-"]


class Suggest(CommandTest):
    def suggest(self, *flags, tree=ASH):
        result = self.succeed("suggest", tree, *COARSE, "--json", *flags, cwd=self.out)
        return json.loads(result.stdout)

    def test_every_choice_is_what_its_command_gives(self):
        page = self.suggest()
        choices = page["suggestions"]
        self.assertEqual(len(choices), 9)
        self.assertEqual([choice["failure"] for choice in choices], 9 * [None])
        for choice in choices:
            single = json.loads(self.succeed(*report_of(choice["command"])).stdout)
            parameters = single["parameters"]
            self.assertEqual(parameters["method"], "controlled")
            self.assertEqual(parameters["resolution"], 32)
            self.assertEqual(parameters["erosion"], choice["erosion"])
            self.assertEqual(parameters["dilation"], choice["dilation"])
            self.assertEqual(parameters["radius_max"], choice["radius_max"])
            self.assertEqual(parameters["threshold"], choice["threshold"])
            self.assertEqual(single["metrics"]["erosion"], choice["erosion_reached"])
            self.assertEqual(single["metrics"]["dilation"], choice["dilation_reached"])
            for slider in ("erosion", "dilation"):
                self.assertAlmostEqual(choice[slider], choice[f"{slider}_reached"], delta=0.01)
            self.assertEqual(single["counts"]["components"], choice["components"])
            voxels = single["metrics"]["dilated_voxels"]
            self.assertEqual(voxels, choice["dilated_voxels"])
            self.assertAlmostEqual(
                choice["dilated_volume"] / (voxels * parameters["voxel_size"] ** 3), 1
            )

    def test_neighbours_differ(self):
        choices = self.suggest()["suggestions"]
        shapes = [(self.volume(c["command"]), c["erosion_reached"]) for c in choices]
        for i in range(9):
            for j in [*([i + 1] if i % 3 < 2 else []), *([i + 3] if i < 6 else [])]:
                with self.subTest(first=i, second=j):
                    small, large = sorted((shapes[i][0], shapes[j][0]))
                    outside = abs(shapes[i][1] - shapes[j][1])
                    self.assertTrue(large > 1.1 * small or outside > 0.04)

    def volume(self, command):
        words = shlex.split(command)
        shape = self.out / "shape.stl"
        self.succeed(*words[1 : words.index("-o")], "-o", shape)
        return styles.volume(shape)

    def test_the_share_is_of_the_bounding_box(self):
        box = json.loads(self.succeed("inspect", ASH, "--json").stdout)["leaves"]["bounds"]
        volume = 1
        for low, high in zip(box["low"], box["high"]):
            volume *= high - low
        for choice in self.suggest()["suggestions"]:
            share = choice["dilated_volume"] / volume
            self.assertAlmostEqual(choice["dilated_share_of_box"] / share, 1)

    def test_table_and_commands(self):
        result = self.succeed("suggest", self.tree, *COARSE, cwd=self.out)
        lines = result.stdout.splitlines()
        self.assertEqual(lines[0].split()[:3], ["erosion", "dilation", "R_max"])
        self.assertEqual(len([line for line in lines[1:10] if line.split()[0].endswith("%")]), 9)
        commands = [line for line in lines if line.startswith("  leafhull extract ")]
        self.assertEqual(len(commands), 9)
        self.succeed(*shlex.split(commands[4])[1:], cwd=self.out)
        self.assertEqual(self.written(), ["tree-shape.glb", "tree-suggest.png"])
        self.assertIn("tree-suggest.png", result.stderr)

    def test_the_strip(self):
        strip = self.out / "strip.png"
        strip.write_text("before")
        page = self.suggest("-o", strip)
        self.assertEqual(page["picture"], str(strip))
        data = strip.read_bytes()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack_from(">II", data, 16)
        self.assertGreater(width, 900)
        self.assertGreater(height, 900)
        self.assertEqual(self.written(), ["strip.png"])

    def test_what_was_typed_is_in_the_commands(self):
        odd = self.input("my tree.glb", self.tree.read_bytes())
        page = self.suggest("--leaves", "le?f*", "--leaf-scale", "1.5", tree=odd)
        for choice in page["suggestions"]:
            words = shlex.split(choice["command"])
            self.assertEqual(words[2], str(odd))
            for flag, value in (("--leaves", "le?f*"), ("--leaf-scale", "1.5"), COARSE):
                self.assertEqual(words[words.index(flag) + 1], value)
            self.assertEqual(words[-1], "my tree-shape.glb")

    def test_refusals(self):
        for words, *flags in (
            (["--threshold", "unknown"], "--threshold", "2"),
            (["--coverage", "unknown"], "--coverage", "0.9"),
            (["--erosion", "unknown"], "--erosion", "0.1"),
            ([".png"], "-o", self.out / "strip.jpg"),
            (["--preset"], "--preset", "huge"),
        ):
            self.fail_with(2, words, "suggest", self.tree, *flags)
        missing = self.out / "missing" / "strip.png"
        self.fail_with(5, ["missing"], "suggest", self.tree, "-o", missing)
        self.fail_with(5, ["missing"], "suggest", "no.glb", "-o", missing)
        self.fail_with(3, ["no.glb"], "suggest", "no.glb", "-o", self.out / "strip.png")
        picture = self.input("tree.png", self.tree.read_bytes())
        self.fail_with(2, ["input itself"], "suggest", picture, "-o", picture)
