# SPDX-License-Identifier: Apache-2.0
import json
import shlex

import glb
from command import ASH, CommandTest


class Inspect(CommandTest):
    def test_table(self):
        page = self.succeed("inspect", ASH).stdout
        heads = page.splitlines()[0].split()
        expected = "leaves material mesh colour alpha triangles name holes colour shape place sum"
        self.assertEqual(heads, expected.split())
        for fact in ("leaf vertices", "mean R_u", "mean R_u / R_v", "bounding box", "crown unit"):
            self.assertRegex(page, rf"(?m)^{fact}  ")

    def test_json(self):
        page = json.loads(self.succeed("inspect", self.tree, "--json").stdout)
        (primitive,) = page["candidates"]
        self.assertEqual(primitive["material"], "leaf")
        self.assertEqual(primitive["mesh"], "Crown")
        self.assertEqual(primitive["node"], "Tree")
        self.assertEqual(primitive["alpha_mode"], "mask")
        self.assertEqual(primitive["vertices"], 1200)
        self.assertEqual(primitive["triangles"], 600)
        self.assertTrue(primitive["leaves"])
        self.assertEqual(primitive["verdict"], "leaves")
        self.assertEqual(primitive["word"], "leaf")
        evidence = primitive["evidence"]
        self.assertAlmostEqual(sum(evidence.values()), 2 * evidence["sum"])
        self.assertTrue(page["chosen"].startswith("leaves: leaf (name, shape"), page["chosen"])
        positions, _ = glb.cards()
        sides = [
            max(p[axis] for p in positions) - min(p[axis] for p in positions) for axis in range(3)
        ]
        self.assertAlmostEqual(page["leaves"]["crown_unit"], max(sides) / 64)
        self.assertAlmostEqual(page["leaves"]["mean_radius_ratio"], 1, places=4)

    def test_strays_are_said_and_do_not_count(self):
        positions, triangles = glb.cards()
        plain = json.loads(self.succeed("inspect", self.tree, "--json").stdout)["leaves"]
        self.assertEqual(plain["stray_leaves"], 0)
        self.assertEqual(plain["crown"], plain["bounds"])

        for k, corner in enumerate(positions[:8]):
            triangles.append([len(positions) + i for i in range(3)])
            positions += [[corner[0] + k, corner[1] - 12 + i / 8, i % 2] for i in range(3)]
        path = self.input("strays.glb", glb.tree(positions, triangles))
        result = self.succeed("inspect", path, "--json")
        leaves = json.loads(result.stdout)["leaves"]
        self.assertIn("warning: 8 leaves lie far from the crown", result.stderr)
        self.assertEqual(leaves["stray_leaves"], 8)
        self.assertEqual(leaves["crown"], plain["bounds"])
        self.assertEqual(leaves["crown_unit"], plain["crown_unit"])
        self.assertLess(leaves["bounds"]["low"][1], -10)
        page = self.succeed("inspect", path).stdout
        self.assertRegex(page, r"(?m)^stray leaves +8$")
        self.assertRegex(page, r"(?m)^crown  ")

    def test_agrees_with_extract(self):
        inspected = json.loads(self.succeed("inspect", ASH, "--json").stdout)["leaves"]
        result = self.succeed("extract", ASH, "--preset", "paper-32", "--report", "-")
        counts = json.loads(result.stdout)["counts"]
        for key in ("leaves", "leaf_vertices", "dropped_leaves"):
            self.assertEqual(inspected[key], counts[key])

    def test_suggestions_work(self):
        commands = json.loads(self.succeed("inspect", self.tree, "--json").stdout)["suggestions"]
        self.assertTrue(commands)
        for command in commands:
            self.succeed(*shlex.split(command)[1:], cwd=self.out)
        self.assertIn("tree-shape.glb", self.written())

    def test_no_leaves_prints_the_list_and_what_to_try(self):
        data = glb.tree(*glb.cards(), material="Rinde [1]", alpha="OPAQUE")
        bark = self.input("it's bark.glb", data)
        result = self.fail_with(3, ["Rinde [1]", "--leaves 'Rinde ?1?'"], "inspect", bark)
        self.assertIn("Rinde [1]", result.stdout)
        (line,) = [line for line in result.stdout.splitlines() if "--leaves" in line]
        self.assertIn("leaves            300", self.succeed(*shlex.split(line)[1:]).stdout)

    def test_no_leaves_as_json(self):
        bark = self.input("bark.glb", glb.tree(*glb.cards(), material="Bark", alpha="OPAQUE"))
        page = json.loads(self.fail_with(3, ["Bark"], "inspect", bark, "--json").stdout)
        self.assertIsNone(page["leaves"])
        self.assertFalse(page["candidates"][0]["leaves"])
        self.assertLess(page["candidates"][0]["evidence"]["name"], 0)

    def test_leaves_flag_counts(self):
        bark = self.input("bark.glb", glb.tree(*glb.cards(), material="Bark", alpha="OPAQUE"))
        page = json.loads(self.succeed("inspect", bark, "--leaves", "b?RK", "--json").stdout)
        self.assertTrue(page["candidates"][0]["leaves"])
        self.assertEqual(page["leaves"]["leaves"], 300)

    def test_control_characters_of_names(self):
        path = self.input("odd.glb", glb.tree(*glb.cards(), material="a\x1b[2J\nb"))
        page = self.succeed("inspect", path).stdout
        self.assertIn("a?[2J?b", page)
        self.assertNotIn("\x1b", page)

    def test_not_a_tree(self):
        self.fail_with(3, ["x.glb"], "inspect", self.input("x.glb", b"no tree"))
