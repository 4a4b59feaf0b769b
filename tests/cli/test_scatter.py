# SPDX-License-Identifier: Apache-2.0
import csv
import math
import struct
import zlib

import glb
from command import CommandTest


def grey16(rows):
    """A 16-bit grey PNG."""

    def chunk(kind, data):
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 16, 0, 0, 0, 0)
    lines = b"".join(b"\0" + struct.pack(f">{len(row)}H", *row) for row in rows)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(lines))
        + chunk(b"IEND", b"")
    )


class Scatter(CommandTest):
    def setUp(self):
        super().setUp()
        self.scene = self.out / "scene.csv"

    def scatter(self, *flags, trees=None):
        self.succeed("scatter", *(trees or [self.tree]), *flags, "-o", self.scene)
        with self.scene.open(newline="") as file:
            return [
                {name: text if name == "model" else float(text) for name, text in row.items()}
                for row in csv.DictReader(file)
            ]

    def refuse(self, words, *flags, code=2):
        self.fail_with(code, words, "scatter", *flags)

    def test_a_forest(self):
        other = self.input("other, too.glb", glb.tree(*glb.cards(radius=4)))
        rows = self.scatter("--count", 500, "--area", "120x60", trees=[self.tree, other])
        self.assertEqual(list(rows[0]), ["model", "x", "y", "z", "yaw", "scale"])
        self.assertEqual(len(rows), 500)
        self.assertEqual({row["model"] for row in rows}, {"../tree.glb", "../other, too.glb"})
        for row in rows:
            self.assertLessEqual(abs(row["x"]), 60)
            self.assertLessEqual(abs(row["z"]), 30)
            self.assertEqual(row["y"], 0)
            self.assertTrue(0 <= row["yaw"] < 360)
            self.assertTrue(0.8 <= row["scale"] <= 1.2)
        apart = math.sqrt(120 * 60 / 500)
        nearest = min(
            math.hypot(a["x"] - b["x"], a["z"] - b["z"])
            for i, a in enumerate(rows)
            for b in rows[:i]
        )
        self.assertGreater(nearest, 0.7 * apart)
        self.assertEqual(self.written(), ["scene.csv"])

    def test_the_same_command_gives_the_same_bytes(self):
        written = []
        for seed in (7, 7, 8):
            self.scatter("--count", 200, "--seed", seed)
            written.append(self.scene.read_bytes())
        self.assertEqual(written[0], written[1])
        self.assertNotEqual(written[0], written[2])

    def test_spacing_is_in_crown_widths(self):
        sides = []
        for spacing in (0.5, 1):
            rows = self.scatter("--count", 400, "--spacing", spacing, "--scale", "1:1")
            sides.append(max(row["x"] for row in rows) - min(row["x"] for row in rows))
            self.assertEqual({row["scale"] for row in rows}, {1})
        # The crown is a ball of radius 2 with cards that stick out.
        self.assertTrue(0.5 * 20 * 3.6 < sides[0] < 0.5 * 20 * 4.3, sides)
        self.assertAlmostEqual(sides[1] / sides[0], 2, delta=0.1)

    def test_a_height_map_of_16_bits(self):
        hills = self.input("hills.png", grey16([[0, 65535], [0, 65535]]))
        rows = self.scatter(
            "--height", 30, "--height-map", hills, "--count", 200, "--area", "100x100"
        )
        for row in rows:
            self.assertAlmostEqual(row["y"], 30 * (row["x"] / 100 + 0.5), delta=2e-3)

    def test_leaves_are_named(self):
        odd = self.input("odd.glb", glb.tree(*glb.cards(), material="odd bark", alpha="OPAQUE"))
        out = ("-o", self.scene)
        self.refuse(["no leaves in", "--leaves"], odd, "--count", 9, *out, code=3)
        self.assertEqual(len(self.scatter("--count", 9, "--leaves", "odd*", trees=[odd])), 9)

    def test_it_says_what_it_did(self):
        result = self.succeed("scatter", self.tree, "--count", 1200, "-o", self.scene)
        self.assertRegex(
            result.stderr, r"\Aleafhull: 1,200 trees of 1 model in .* s: .*scene\.csv\n\Z"
        )
        result = self.succeed("scatter", self.tree, "--count", 1, "-q", "-o", self.scene)
        self.assertEqual(result.stderr + result.stdout, "")

    def test_help(self):
        page = self.succeed("scatter", "--help").stdout
        for flag in (
            "-o, --output FILE", "--count N", "--seed N", "--scale LOW:HIGH", "--spacing X",
            "--area WxD", "--height-map FILE", "--height X", "--leaves GLOB",
        ):
            self.assertIn(f"\n  {flag}", page)
        for line in page.splitlines():
            self.assertLessEqual(len(line), 100, line)
        self.assertIn("\n  scatter ", self.succeed("--help").stdout)

    def test_usage(self):
        tree, out = self.tree, ("-o", self.scene)
        for words, flags in (
            (["no TREE is given"], ("--count", 5, *out)),
            (["--count is missing"], (tree, *out)),
            (["no output is named", "-o scene.csv"], (tree, "--count", 5)),
            (["--count '0' is out of range", "1 to 1000000"], (tree, "--count", 0, *out)),
            (["--count '1000001'"], (tree, "--count", 1000001, *out)),
            (["--count '2.5'"], (tree, "--count", 2.5, *out)),
            (["--seed '-1'"], (tree, "--count", 5, "--seed", -1, *out)),
            (["--area '100' is not two numbers"], (tree, "--count", 5, "--area", 100, *out)),
            (["--area 'ten' is not a number"], (tree, "--count", 5, "--area", "tenx5", *out)),
            (["--area has a side"], (tree, "--count", 5, "--area", "0x5", *out)),
            (["--area is a line"], (tree, "--count", 5, "--area", "1e8x1", *out)),
            (["--scale '1'"], (tree, "--count", 5, "--scale", "1", *out)),
            (["--scale is not a range"], (tree, "--count", 5, "--scale", "2:1", *out)),
            (["--spacing is not a positive"], (tree, "--count", 5, "--spacing", 0, *out)),
            (["--height is given without"], (tree, "--count", 5, "--height", 5, *out)),
            (["contradict"], (tree, "--count", 5, "--area", "5x5", "--spacing", 0.8, *out)),
            (["not a .csv file"], (tree, "--count", 5, "-o", self.out / "scene.json")),
        ):
            with self.subTest(words=words):
                self.refuse(words, *flags)

    def test_files_that_are_not_there(self):
        out = ("--count", 5, "-o", self.scene)
        self.refuse(["oak.glb: cannot be read"], self.tree, self.folder / "oak.glb", *out, code=3)
        self.refuse(["height map", "none.png"], self.tree, "--height-map", "none.png", *out, code=3)
        nowhere = self.out / "nowhere" / "scene.csv"
        self.refuse(["does not exist", "mkdir"], self.tree, "--count", 5, "-o", nowhere, code=5)

    def test_a_million_trees(self):
        self.succeed("scatter", self.tree, "--count", 1000000, "-o", self.scene)
        with self.scene.open("rb") as file:
            self.assertEqual(sum(1 for _ in file), 1000001)
