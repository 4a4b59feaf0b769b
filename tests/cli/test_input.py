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
