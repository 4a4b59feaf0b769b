# SPDX-License-Identifier: Apache-2.0
import json
import shlex
import struct

from command import ASH, CommandTest

COARSE = ("--preset", "paper-32")


def report_of(command):
    """The words of a suggested command, a report in place of its shape."""
    words = shlex.split(command)
    return [*words[1 : words.index("-o")], "--report", "-"]


class Suggest(CommandTest):
    def suggest(self, *flags, tree=ASH):
        result = self.succeed("suggest", tree, *COARSE, "--json", *flags, cwd=self.out)
        return json.loads(result.stdout)

    def test_every_choice_is_what_its_command_gives(self):
        page = self.suggest()
        choices = page["suggestions"]
        pairs = [(choice["coverage"], choice["radius_max"]) for choice in choices]
        self.assertEqual(pairs, [(c, r) for c in (0.85, 0.92, 0.98) for r in (1.5, 2.5, 4)])
        for choice in choices:
            single = json.loads(self.succeed(*report_of(choice["command"])).stdout)
            parameters = single["parameters"]
            self.assertEqual(parameters["method"], "controlled")
            self.assertEqual(parameters["resolution"], 32)
            self.assertEqual(parameters["coverage"], choice["coverage"])
            self.assertEqual(parameters["threshold"], choice["threshold"])
            self.assertEqual(single["counts"]["components"], choice["components"])
            voxels = single["metrics"]["dilated_voxels"]
            self.assertEqual(voxels, choice["dilated_voxels"])
            self.assertAlmostEqual(
                choice["dilated_volume"] / (voxels * parameters["voxel_size"] ** 3), 1
            )

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
        self.assertEqual(lines[0].split()[:3], ["coverage", "R_max", "T"])
        self.assertEqual(len([line for line in lines if line.startswith("    0.")]), 9)
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
