# SPDX-License-Identifier: Apache-2.0
import math
import struct

import glb
from command import CommandTest


class Input(CommandTest):
    def refuse(self, words, data, *flags, name="bad.glb"):
        path = self.input(name, data)
        self.fail_with(3, words, "extract", path, "-o", self.shape, *flags)

    def test_no_such_file(self):
        missing = self.folder / "missing.glb"
        self.fail_with(3, ["missing.glb"], "extract", missing, "-o", self.shape)

    def test_a_folder(self):
        self.fail_with(3, [str(self.out)], "extract", self.out, "-o", self.shape)

    def test_not_a_gltf(self):
        self.refuse(["bad.glb"], b"a text, not a tree\n" * 20)
        self.refuse(["bad.glb"], b"")
        self.refuse(["bad.gltf"], b"{}", name="bad.gltf")
        self.refuse(["bad.fbx"], b"Kaydara", name="bad.fbx")

    def test_truncated_anywhere(self):
        whole = glb.tree(*glb.cards(20))
        for size in (4, 12, 16, 200, len(whole) // 2, len(whole) - 1):
            self.refuse(["bad.glb"], whole[:size])

    def test_accessor_out_of_bounds(self):
        def grow(document):
            document["accessors"][0]["count"] *= 1000

        self.refuse(["bad.glb", "accessor"], glb.tree(*glb.cards(20), change=grow))

    def test_index_past_the_vertices(self):
        positions, triangles = glb.cards(20)
        triangles[3] = [0, 1, len(positions)]
        self.refuse(["bad.glb", "ind"], glb.tree(positions, triangles))

    def test_positions_that_are_not_finite(self):
        for value in (math.nan, math.inf):
            positions, triangles = glb.cards(20)
            whole = bytearray(glb.tree(positions, triangles))
            at = whole.rindex(struct.pack("<3f", *positions[5]))
            struct.pack_into("<f", whole, at, value)
            self.refuse(["bad.glb"], bytes(whole))

    def test_required_extension_is_named(self):
        def require(document):
            document["extensionsUsed"] = document["extensionsRequired"] = ["EXT_no_such_thing"]

        self.refuse(["EXT_no_such_thing"], glb.tree(*glb.cards(20), change=require))

    def test_missing_buffer_is_named(self):
        def move_out(document):
            document["buffers"][0]["uri"] = "elsewhere.bin"

        document, _ = glb.unpack(glb.tree(*glb.cards(20), change=move_out))
        self.refuse(["elsewhere.bin"], glb.json.dumps(document).encode(), name="bad.gltf")

    def test_no_leaves_lists_what_there_is(self):
        bark = glb.tree(*glb.cards(20), material="Bark", alpha="OPAQUE")
        self.refuse(["Bark", "--leaves"], bark)
        self.refuse(["leaf", "--leaves"], glb.tree(*glb.cards(20)), "--leaves", "*petal*")

    def test_leaves_of_zero_area_only(self):
        _, triangles = glb.cards(20)
        self.refuse(["bad.glb"], glb.tree([[1, 2, 3]] * 80, triangles))

    def test_missing_texture_warns(self):
        def reference(document):
            document["images"] = [{"uri": "missing.png"}]
            document["textures"] = [{"source": 0}]
            document["materials"][0]["pbrMetallicRoughness"] = {"baseColorTexture": {"index": 0}}

        path = self.input("bare.glb", glb.tree(*glb.cards(), change=reference))
        result = self.succeed("extract", path, "-o", self.shape, "--preset", "paper-32")
        self.assertIn("leafhull: warning: ", result.stderr)
        self.assertIn("missing.png", result.stderr)
        quiet = self.succeed("extract", path, "-o", self.shape, "--preset", "paper-32", "-q")
        self.assertEqual(quiet.stderr, "")

    def test_files_outside_of_the_folder_are_read_when_they_may(self):
        def move_out(document):
            document["buffers"][0]["uri"] = "../elsewhere.bin"

        document, binary = glb.unpack(glb.tree(*glb.cards(), change=move_out))
        inner = self.folder / "inner"
        inner.mkdir()
        (self.folder / "elsewhere.bin").write_bytes(binary)
        path = inner / "tree.gltf"
        path.write_text(glb.json.dumps(document))
        self.fail_with(3, ["elsewhere.bin", "--allow-outside"], "inspect", path)
        self.succeed("inspect", path, "--allow-outside")
        (inner / "elsewhere.bin").write_bytes(binary)
        result = self.succeed("inspect", path)
        self.assertIn("is taken from the file's own folder", result.stderr)

    def test_up_stands_a_tree_up(self):
        positions, triangles = glb.cards()
        tall = [[x, y, 3 * z] for x, y, z in positions]
        path = self.input("lying.glb", glb.tree(tall, triangles))

        def height(*flags):
            page = glb.json.loads(self.succeed("inspect", path, "--json", *flags).stdout)
            return page["leaves"]["crown"]["high"][1] - page["leaves"]["crown"]["low"][1]

        self.assertAlmostEqual(height("--up", "z") / height(), 3, delta=0.3)
        self.assertEqual(height("--up", "y"), height())
        self.fail_with(2, ["--up"], "inspect", path, "--up", "x")

    def test_a_scene_of_trees_that_lie_stands_up(self):
        positions, triangles = glb.cards()
        tall = [[x, y, 3 * z] for x, y, z in positions]
        lying = self.input("lying.glb", glb.tree(tall, triangles))
        scene = self.input("stand.csv", f"model,x,y,z\n{lying.name},0,0,0\n".encode())
        flags = ("--merge", "none", "--voxel-size", "0.3")
        for name, up in (("as-it-is", ()), ("upright", ("--up", "z"))):
            self.succeed("forest", scene, "-o", self.out / name, *flags, *up)
        boxes = []
        for name in ("as-it-is", "upright"):
            document, _ = glb.unpack((self.out / name / "forest.glb").read_bytes())
            accessor = document["accessors"][
                document["meshes"][0]["primitives"][0]["attributes"]["POSITION"]
            ]
            boxes.append((accessor["min"], accessor["max"]))
        (low, high), (turned_low, turned_high) = boxes
        self.assertAlmostEqual(turned_high[1], high[2], delta=0.3)
        self.assertAlmostEqual(turned_low[2], -high[1], delta=0.3)
        self.assertGreater(turned_high[1] - turned_low[1], 2 * (high[1] - low[1]))

    def test_a_lying_tree_is_scattered_upright(self):
        positions, triangles = glb.cards()
        lying = self.input("lying.glb", glb.tree([[x, y, 3 * z] for x, y, z in positions], triangles))
        texts = []
        for number, up in enumerate(((), ("--up", "z"))):
            scene = self.out / f"{number}.csv"
            self.succeed("scatter", lying, "-o", scene, "--count", "30", *up)
            texts.append(scene.read_text())
        self.assertNotEqual(*texts, "crowns are narrower where they stand")

    def test_what_is_not_read_is_converted(self):
        blend = self.input("oak.blend", b"BLENDER-v300")
        result = self.fail_with(3, ["Blender file", "blender -b"], "inspect", blend)
        self.assertIn("export_scene.gltf(filepath='oak.glb')", result.stderr)

    def test_bytes_after_the_end_are_passed_over(self):
        path = self.input("tail.glb", glb.tree(*glb.cards()) + b"tail")
        self.assertIn("4 bytes after the end", self.succeed("inspect", path).stderr)
