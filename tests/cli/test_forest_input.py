# SPDX-License-Identifier: Apache-2.0
"""Scenes that are unusual, wrong or too large."""

import json
import math
import struct
import time

import glb
from forests import COARSE, ForestTest, unordered, files_in, read_glb, tiles_of


class BadScenes(ForestTest):
    def refuse(self, code, words, scene, *flags):
        self.fail_with(code, words, "forest", scene, "-o", self.out / "forest", *flags)

    def test_a_missing_tree_is_named_with_its_line(self):
        scene = self.stand("ash.glb,0,0,0", "oak.glb,5,0,0", "fir.glb,9,0,0", "elm.glb,9,9,0")
        for merge in ("none", "canopy"):
            self.refuse(3, ["stand.csv", "line 4", "fir.glb"], scene, "--merge", merge)

    def test_an_unreadable_scene(self):
        for name, data in (
            ("stand.csv", b""),
            ("stand.csv", b"model,x,y,z\n"),
            ("stand.csv", b"model,x,y,z\nash.glb,0,0\n"),
            ("stand.csv", b"model,x,y,z\nash.glb,zero,0,0\n"),
            ("stand.csv", b"\xff\xfe\0m\0o"),
            ("stand.jsonl", b'{"model": "ash.glb", "position": [0, 0]}\n'),
            ("stand.jsonl", b"not json\n"),
            ("stand.glb", b"glTF"),
            ("stand.gltf", b"{}"),
            ("stand.txt", b"model,x,y,z\nash.glb,0,0,0\n"),
        ):
            with self.subTest(data):
                result = self.run_command(
                    "forest", self.input(name, data), "-o", self.out / "forest"
                )
                self.assertIn(result.returncode, (2, 3), result.stderr)
                self.refuse(result.returncode, [name], self.folder / name)

    def test_a_broken_tree(self):
        self.input("oak.glb", b"no tree")
        self.refuse(3, ["oak.glb"], self.stand("ash.glb,0,0,0", "oak.glb,5,0,0"))
        self.input("oak.glb", glb.tree(*glb.cards(), material="bark", alpha="OPAQUE"))
        self.refuse(3, ["oak.glb", "leaves"], self.stand("ash.glb,0,0,0", "oak.glb,5,0,0"))

    def test_nothing_reaches_the_threshold(self):
        scene = self.stand("ash.glb,0,0,0", "oak.glb,90,0,0")
        for flags in (
            (),
            ("--levels", "2"),
            ("--control-scope", "scene"),
            ("--merge", "none"),
            ("--single", self.out / "forest" / "all.glb"),
        ):
            with self.subTest(flags):
                self.refuse(6, ["empty"], scene, *COARSE, "--threshold", "1e6", *flags)

    def test_every_piece_is_small(self):
        scene = self.stand(*["ash.glb,0,0,0"] * 3, "ash.glb,30,0,0")
        single = self.folder / "all.ply"
        single.write_text("mine")
        flags = ("--radius-max", "1.4", "--coverage", "0.2", "--control-scope", "scene")
        self.refuse(6, ["empty", "--min-component"], scene, *COARSE, *flags,
                    "--min-component", "1", "--single", single)  # fmt: skip
        self.assertEqual(single.read_text(), "mine")
        self.forest(scene, "forest", *COARSE, *flags, "--min-component", "0")

    def test_a_folder_that_cannot_be_written(self):
        scene = self.stand("ash.glb,0,0,0")
        self.fail_with(5, ["/proc/forest"], "forest", scene, "-o", "/proc/forest")
        self.fail_with(5, ["file"], "forest", scene, "-o", self.folder / "ash.glb")
        self.fail_with(5, ["file"], "forest", scene, "-o", self.folder / "ash.glb" / "forest")

    def test_a_scene_is_not_overwritten(self):
        scene = self.stand("ash.glb,0,0,0")
        ash = (self.folder / "ash.glb").read_bytes()
        self.refuse(2, ["ash.glb", "input"], scene, "--single", self.folder / "ash.glb")
        self.assertEqual((self.folder / "ash.glb").read_bytes(), ash)

    def quickly(self, *arguments):
        begin = time.monotonic()
        self.refuse(*arguments)
        self.assertLess(time.monotonic() - begin, 20)

    def test_more_tiles_than_there_is_room_for(self):
        scene = self.stand("ash.glb,0,0,0", "ash.glb,1000,0,0")
        words = ["tiles", "room for", "--voxel-size"]
        self.quickly(2, words, scene, "--voxel-size", "0.0001")
        self.quickly(2, words, scene, "--voxel-size", "0.0001", "--tile", "32")
        self.quickly(2, words, scene, "--voxel-size", "0.0001", "--levels", "3")

    def test_more_voxels_than_can_be_counted(self):
        scene = self.stand("ash.glb,0,0,0", "ash.glb,1e9,0,0")
        self.quickly(2, ["2^30", "--voxel-size"], scene, "--voxel-size", "0.1")
        self.quickly(2, ["2^30"], self.stand("ash.glb,1e300,0,0"), "--voxel-size", "0.1")

    def test_too_little_memory(self):
        self.input("oak.glb", glb.tree(*glb.cards(20000, 2.5, half=0.02)))
        rows = [f"oak.glb,{20 + x},20,{20 + z}" for x in range(20) for z in range(20)]
        scene = self.stand(*rows)
        words = ["densest tiles need", "GiB", "--memory is 0.5 GiB", "Raise --memory"]
        self.quickly(2, [*words, "--voxel-size"], scene, "--voxel-size", "2", "--memory", "512M")
        self.quickly(
            2, [*words, "--tile"], scene, "--voxel-size", "2", "--memory", "512M", "--tile", "128"
        )


class OddScenes(ForestTest):
    def welded(self, scene, *flags, name="forest"):
        single = self.folder / "all.glb"
        flags = flags if "--voxel-size" in flags else (*COARSE, *flags)
        self.forest(scene, name, "--restart", "--single", single, *flags)
        surface = read_glb(single)
        self.assert_closed(surface)
        return surface

    def bounds(self, surface):
        return [(min(c), max(c)) for c in list(zip(*surface.vertices))[:3]]

    def test_a_scale_that_is_none(self):
        head = "model,x,y,z,scale"
        rows = ["ash.glb,0,0,0,1", "ash.glb,9,0,0,0", "oak.glb,0,0,9,nan", "oak.glb,9,0,9,inf"]
        scene = self.input("odd.csv", "\n".join([head, *rows, ""]).encode())
        alone = self.stand("ash.glb,0,0,0")
        for merge in ("canopy", "none"):
            report = self.folder / "report.json"
            result = self.forest(scene, "odd", "--restart", *COARSE, "--merge", merge,
                                 "--report", report)  # fmt: skip
            self.assertRegex(result.stderr, r"warning: .*odd\.csv: 3 trees were skipped.*line 3")
            self.assertEqual(json.loads(report.read_text())["scene"]["skipped"], 3)
            self.assertEqual(json.loads(report.read_text())["scene"]["trees"], 1)
            self.forest(alone, "alone", "--restart", *COARSE, "--merge", merge)
            found, expected = files_in(self.out / "odd"), files_in(self.out / "alone")
            for files in (found, expected):  # the manifest names the scene's models
                del files["manifest.json"]
            self.assertEqual(found, expected)
        rows = ["ash.glb,9,0,0,0", "oak.glb,0,0,9,nan"]
        scene = self.input("odd.csv", "\n".join([head, *rows, ""]).encode())
        result = self.run_command("forest", scene, "-o", self.out / "none")
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("of all 2", result.stderr)

    def test_trees_a_thousand_kilometres_apart(self):
        far = 27000 * 128 * 0.3  # whole tiles, so each tree has the same surface
        scene = self.stand("ash.glb,0,0,0", f"ash.glb,{far},0,0", f"ash.glb,0,0,{-far}")
        begin = time.monotonic()
        self.welded(scene, "--levels", "2", "--style", "paper-thin", "--threshold", "0.3")
        self.assertLess(time.monotonic() - begin, 60)
        clouds = {}
        for tile in tiles_of(self.out / "forest").values():
            for x, y, z, *_ in tile.vertices:
                at = (round(x / far), round(z / far))
                clouds.setdefault(at, set()).add((x - at[0] * far, y, z - at[1] * far))
        self.assertEqual(sorted(clouds), [(0, -1), (0, 0), (1, 0)])
        self.assertGreater(len(clouds[0, 0]), 100)
        for cloud in clouds.values():
            self.assertEqual(len(cloud), len(clouds[0, 0]))
            for a, b in zip(sorted(cloud), sorted(clouds[0, 0])):
                self.assertLess(max(abs(p - q) for p, q in zip(a, b)), 0.3 / 1000)

    def test_a_thousand_kilometres_away_is_as_here(self):
        """The voxel size is a power of two, so the lattice is the same."""
        meshes = []
        for x in (8, 8 + 2**20):
            scene = self.stand(f"oak.glb,{x},8,8")
            self.forest(scene, "far", "--restart", "--voxel-size", "0.25", "--tile", "128")
            (tile,) = tiles_of(self.out / "far").values()
            meshes.append(([(vx - x, y, z) for vx, y, z, *_ in tile.vertices], tile.triangles))
        here, there = meshes
        self.assertEqual(here[1], there[1], "the same triangles")
        for a, b in zip(here[0], there[0], strict=True):
            self.assertLessEqual(max(abs(p - q) for p, q in zip(a, b)), 0.25 / 1000)

    def test_two_trees_in_one_place(self):
        for scope in ("model", "scene"):
            flags = ("--control-scope", scope, "--style", "paper-thin", "--threshold", "0.5")
            one = self.welded(self.stand("oak.glb,5,5,5"), *flags)
            two = self.welded(self.stand("oak.glb,5,5,5", "oak.glb,5,5,5"), *flags)
            three = self.welded(self.stand(*["oak.glb,5,5,5"] * 3), *flags)
            if scope == "model":  # the densities add up, so N reaches T farther out
                halved = self.welded(
                    self.stand("oak.glb,5,5,5"), *flags[:-1], "0.25"
                )
                self.assertEqual(len(unordered(two)[0]), len(unordered(halved)[0]))
            self.assertGreater(len(three.vertices), 0)
            self.assertNotEqual(unordered(one), unordered(two))

    def test_a_tile_with_nothing_in_it(self):
        # Some tiles meet the box of a tree but not its surface.
        scene = self.stand("ash.glb,0,0,0", "ash.glb,40,0,40")
        report = self.folder / "report.json"
        flags = (*COARSE, "--tile", "32", "--report", report)
        self.forest(scene, "forest", *flags)
        rows = json.loads(report.read_text())
        self.assertGreater(rows["counts"]["empty"], 0)
        self.assertEqual(
            rows["counts"]["empty"], sum(tile["triangles"] == 0 for tile in rows["tiles"])
        )
        self.assertEqual(
            len(tiles_of(self.out / "forest")), rows["counts"]["tiles"] - rows["counts"]["empty"]
        )

    def gltf_scene(self, nodes, *, instancing=None, name="scene.glb"):
        """The ash as a mesh that `nodes` place; `instancing` holds translations."""

        def change(document):
            document["nodes"] = [{"mesh": 0, **node} for node in nodes]
            document["scenes"] = [{"nodes": list(range(len(nodes)))}]

        data = glb.tree(*glb.cards(300, 2.0, seed=1), change=change)
        if instancing:
            document, binary = glb.unpack(data)
            binary = binary[: document["buffers"][0]["byteLength"]]
            rows = b"".join(struct.pack("<3f", *row) for row in instancing)
            view, accessor = len(document["bufferViews"]), len(document["accessors"])
            document["bufferViews"].append(
                {"buffer": 0, "byteOffset": len(binary), "byteLength": len(rows)}
            )
            document["accessors"].append(
                {"bufferView": view, "componentType": glb.FLOAT, "count": len(instancing),
                 "type": "VEC3"}
            )  # fmt: skip
            document["buffers"][0]["byteLength"] += len(rows)
            document["extensionsUsed"] = ["EXT_mesh_gpu_instancing"]
            document["nodes"][0]["extensions"] = {
                "EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": accessor}}
            }
            data = glb.pack(document, binary + rows)
        return self.input(name, data)

    def test_a_gltf_scene_with_instances(self):
        places = [(0, 0, 0), (6, 0, 0), (0, 1, 6), (6, 2, 6)]
        nodes = self.gltf_scene([{"translation": place} for place in places])
        instances = self.gltf_scene([{}], instancing=places, name="instances.glb")
        table = self.stand(*(f"ash.glb,{x},{y},{z}" for x, y, z in places))
        canopies = [self.welded(scene) for scene in (nodes, instances, table)]
        self.assertEqual(canopies[0], canopies[2])
        self.assertEqual(canopies[1], canopies[2])
        apart = []
        for scene in (nodes, instances, table):
            self.forest(scene, "apart", "--restart", "--merge", "none", *COARSE)
            document, binary = glb.unpack((self.out / "apart" / "forest.glb").read_bytes())
            for named in (*document["nodes"], *document["meshes"]):
                named.pop("name")  # the name of a mesh or of a file
            apart.append((document, binary))
        self.assertEqual(apart[0], apart[1])
        self.assertEqual(apart[0], apart[2])

    def test_sheared_and_mirrored_trees(self):
        def matrix(a, b, c, at):
            return {"matrix": [*a, 0, *b, 0, *c, 0, *at, 1]}

        def canopy(*axes):
            scene = self.gltf_scene([matrix(*axes, (6, 6, 6))])
            return self.welded(scene, "--voxel-size", "0.05", "--style", "paper-thin", "--threshold", "0.3")

        plain = canopy((1, 0, 0), (0, 1, 0), (0, 0, 1))
        # The lattice is not mirrored with the tree, so the vertices differ.
        mirrored = canopy((-1, 0, 0), (0, 1, 0), (0, 0, 1))
        turned = [(12 - high, 12 - low) for low, high in self.bounds(plain)[:1]]
        self.assert_near(turned + self.bounds(plain)[1:], self.bounds(mirrored), 0.1)
        sheared = canopy((1, 0, 0), (0.5, 1, 0), (0, 0, 1))  # x' = x + y / 2
        for surface in (plain, mirrored, sheared):
            self.assert_outward(surface)
        self.assertGreater(
            self.bounds(sheared)[0][1] - self.bounds(sheared)[0][0],
            self.bounds(plain)[0][1] - self.bounds(plain)[0][0],
        )
        self.assert_near(self.bounds(plain)[1:], self.bounds(sheared)[1:], 0.2)
        self.assertAlmostEqual(
            self.volume(mirrored) / self.volume(plain), 1, delta=0.02, msg="it keeps its volume"
        )
        self.assertAlmostEqual(self.volume(sheared) / self.volume(plain), 1, delta=0.05)

    def volume(self, surface):
        points = [v[:3] for v in surface.vertices]
        return sum(
            a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
            for a, b, c in ((points[i] for i in t) for t in surface.triangles)
        ) / 6  # fmt: skip

    def assert_outward(self, surface):
        self.assertGreater(self.volume(surface), 0)
        along = every = 0  # areas: of triangles whose normals point outward, and of all
        for numbers in surface.triangles:
            a, b, c = (surface.vertices[i][:3] for i in numbers)
            u, v = ([q - p for p, q in zip(a, end)] for end in (b, c))
            normal = [u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3)]
            mean = [sum(surface.vertices[i][3 + k] for i in numbers) for k in range(3)]
            area = math.hypot(*normal)
            every += area
            along += area * (sum(p * q for p, q in zip(normal, mean)) > 0)
        self.assertGreater(along / every, 0.99, "normals point outward")

    def assert_near(self, found, expected, delta):
        for a, b in zip(found, expected, strict=True):
            for p, q in zip(a, b, strict=True):
                self.assertAlmostEqual(p, q, delta=delta)

    def test_eight_levels(self):
        self.welded(self.stand("oak.glb,0,0,0", "ash.glb,20,0,0"), "--levels", "8")
