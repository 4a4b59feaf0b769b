# SPDX-License-Identifier: Apache-2.0
"""Which triangles of a file are taken as leaves, and what the command says about it."""

import json
import pathlib
import time

import glb
from command import ASH, CommandTest

SHARED = pathlib.Path(__file__).parents[3] / "shared"

# For each shared file, the materials that are leaves or the colours of the parts that are.
RIGHT = json.loads(pathlib.Path(__file__).parents[1].joinpath("leaves.json").read_text())["files"]


def chain(nodes):
    """One card under each of many nodes, which all have different names."""

    def change(document):
        document["nodes"] = [
            {"name": f"b{i}", "mesh": 0, "translation": [i % 100, i // 100, 0]}
            for i in range(nodes)
        ]
        document["scenes"] = [{"nodes": list(range(nodes))}]

    positions, triangles = glb.cards(count=1)
    return glb.tree(positions, triangles, change=change)


def scene():
    """Two trees of cards, a meadow of cards and a plane, told apart by names."""

    def change(document):
        document["materials"] = [
            {"name": name, "alphaMode": "MASK"} for name in ("Leaf", "Grass", "Ground")
        ]
        document["meshes"] = [
            {
                "name": material["name"],
                "primitives": [
                    {"attributes": {"POSITION": 0}, "indices": 1, "material": index}
                ],
            }
            for index, material in enumerate(document["materials"])
        ]
        document["nodes"] = [
            {"name": "Oak.1", "mesh": 0, "translation": [0, 4, 0]},
            {"name": "Oak.2", "mesh": 0, "translation": [9, 4, 0]},
            {"name": "Meadow", "mesh": 1, "scale": [9, 0.01, 9]},
            {"name": "Plane", "mesh": 2, "scale": [9, 0.001, 9]},
        ]
        document["scenes"] = [{"nodes": [0, 1, 2, 3]}]

    return glb.tree(*glb.cards(), change=change)


class Leaves(CommandTest):
    def inspect(self, tree, *options):
        return json.loads(self.succeed("inspect", tree, "--json", *options).stdout)

    def test_extract_says_what_it_took_in_one_line(self):
        result = self.succeed("extract", ASH, "-o", self.shape, "--preset", "draft")
        (line,) = [x for x in result.stderr.splitlines() if x.startswith("leaves: ")]
        self.assertRegex(line, r"^leaves: leaves \(name, holes, .*\); passed over: bark$")
        quiet = self.succeed("extract", ASH, "-o", self.shape, "--preset", "draft", "-q")
        self.assertEqual(quiet.stderr, "")

    def test_all_says_what_it_took(self):
        result = self.succeed("extract", ASH, "-o", self.shape, "--preset", "draft", "--leaves", "*")
        self.assertIn("leaves: leaves", result.stderr)
        self.assertIn(", bark", result.stderr)

    def test_not_leaves(self):
        page = self.inspect(ASH, "--leaves", "*", "--not-leaves", "BARK")
        self.assertEqual(page["leaves"]["leaf_vertices"], self.inspect(ASH)["leaves"]["leaf_vertices"])
        result = self.fail_with(3, ["no leaves in"], "inspect", self.tree, "--not-leaves", "leaf")
        self.assertIn("not asked for", result.stdout)
        warned = self.succeed("inspect", ASH, "--not-leaves", "acorn")
        self.assertIn("--not-leaves acorn matches no", warned.stderr)

    def test_colours_are_checked(self):
        for text in ("green", "#12", "#12345g", "#4a7a2c,", "#4a7a2c,x", "#4a7a2c,-1"):
            self.fail_with(2, ["--leaves-colour"], "inspect", ASH, "--leaves-colour", text)
        self.fail_with(2, ["--leaf-colour"], "inspect", ASH, "--leaf-colour", "red")

    def test_a_colour_is_in_the_report_and_in_what_to_try(self):
        def change(document):
            for index, color in enumerate(((0.1, 0.3, 0.05, 1), (0.5, 0.02, 0.02, 1))):
                document["materials"][index:] = [
                    {"name": f"mat{index}", "pbrMetallicRoughness": {"baseColorFactor": color}}
                ]
            primitives = document["meshes"][0]["primitives"]
            primitives.append(primitives[0] | {"material": 1})

        tree = self.input("two.glb", glb.tree(*glb.cards(), change=change))
        page = self.inspect(tree, "--leaves-colour", "#ba2727")
        taken = [c["material"] for c in page["candidates"] if c["leaves"]]
        self.assertEqual(taken, ["mat1"])
        self.assertIn("--leaves-colour '#ba2727'", page["suggestions"][0])
        report = self.out / "report.json"
        self.succeed("extract", tree, "-o", self.shape, "--report", report, "--preset", "draft",
                     "--leaves-colour", "#ba2727,0.2")
        parameters = json.loads(report.read_text())["parameters"]
        self.assertEqual(parameters["leaves_colour"], ["#ba2727", 0.2])

    def test_a_guess_is_a_warning_that_names_the_other(self):
        def change(document):
            document["materials"] = [{"name": "a"}, {"name": "b"}]
            primitives = document["meshes"][0]["primitives"]
            primitives.append(primitives[0] | {"material": 1})

        tree = self.input("guess.glb", glb.tree(*glb.cards(count=2), change=change))
        result = self.succeed("inspect", tree)
        self.assertRegex(result.stderr, r"warning: the choice of leaves is a guess: .*--leaves")

    def test_twenty_thousand_nodes_are_quick_and_readable(self):
        tree = self.input("many.glb", chain(20_000))
        start = time.monotonic()
        result = self.succeed("inspect", tree)
        seconds = time.monotonic() - start
        self.assertLess(seconds, 5)  # 0.5 on an idle machine
        self.assertLessEqual(len(result.stdout.splitlines()), 30)
        self.assertIn("and 19,999 more", result.stdout)
        self.assertEqual(len(self.inspect(tree)["candidates"]), 20_000)

    def test_rows_past_thirty_are_counted(self):
        def change(document):
            document["materials"] = [{"name": f"leaf{i}"} for i in range(50)]
            primitives = document["meshes"][0]["primitives"]
            primitives[:] = [primitives[0] | {"material": i} for i in range(50)]

        tree = self.input("many.glb", glb.tree(*glb.cards(count=3), change=change))
        self.assertIn("and 20 more; --json lists them all", self.succeed("inspect", tree).stdout)

    def test_a_forest_makes_no_tree_of_a_meadow(self):
        path = self.input("scene.glb", scene())
        out = self.folder / "forest"
        result = self.succeed("forest", path, "-o", out, "--preset", "draft", "--merge", "none")
        page = self.inspect(path)
        verdicts = {c["material"]: c["verdict"] for c in page["candidates"]}
        self.assertEqual(verdicts, {"Leaf": "leaves", "Grass": "undergrowth", "Ground": "no"})
        self.assertNotIn("Meadow", result.stderr)
        forest, _ = glb.unpack((out / "forest.glb").read_bytes())
        self.assertEqual([mesh["name"] for mesh in forest["meshes"]], ["abstract shape"])
        self.assertIn("2 trees", result.stderr)

    def test_shared_files_give_the_right_leaves(self):
        if not SHARED.exists():
            print(f"SKIPPED: the leaves of the shared trees: there is no {SHARED}")
            self.skipTest("no shared trees")
        for name, right in RIGHT.items():
            with self.subTest(name):
                start = time.monotonic()
                text = self.succeed("inspect", SHARED / name).stdout
                self.assertLess(time.monotonic() - start, 5)  # 1 on an idle machine
                self.assertLessEqual(len(text.splitlines()), 30)
                page = self.inspect(SHARED / name)
                taken, others = set(), set()
                for candidate in page["candidates"]:
                    name_of = candidate["colour" if candidate["is_part"] else "material"]
                    (taken if candidate["leaves"] else others).add(name_of)
                self.assertEqual(taken, set(right))
                self.assertFalse(taken & others)
