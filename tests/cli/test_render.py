# SPDX-License-Identifier: Apache-2.0
import json
import math
import resource

import glb
import png
from command import ASH
from rendering import DRAFT, MESH, WHITE, Render, is_green


class Pictures(Render):
    def test_a_tree_on_white_paper(self):
        for surface in ("direct", "mesh"):
            width, height, rows = self.pixels("--surface", surface)
            self.assertEqual((width, height), (96, 96))
            for corner in (rows[0][0], rows[0][-1], rows[-1][0], rows[-1][-1]):
                self.assertEqual(corner, WHITE)
            seen = [pixel for row in rows for pixel in row if pixel != WHITE]
            self.assertGreater(len(seen), 96 * 96 // 10)
            self.assertGreater(sum(map(is_green, seen)), len(seen) // 2)
            foot = [pixel for row in rows[84:90] for pixel in row if pixel != WHITE]
            self.assertTrue(foot, "the trunk is in the picture")
            self.assertFalse(any(map(is_green, foot)))
        self.assertEqual(self.written(), ["picture.png"])

    def test_a_tree_beside_its_shape(self):
        alone = self.pixels()[2]
        for look in ("phong", "watercolour"):
            width, height, rows = self.pixels("--beside", "--look", look)
            self.assertEqual((width, height), (96 + 3 + 96, 96))
            tree = [row[:96] for row in rows]
            if look == "phong":
                self.assertEqual([row[99:] for row in rows], alone, "the shape, as it is alone")
                self.assertTrue(all(row[96:99] == [WHITE] * 3 for row in rows))
            shape = {(x, y) for y in range(96) for x in range(96) if alone[y][x] != WHITE}
            seen = {(x, y) for y in range(96) for x in range(96) if tree[y][x] != WHITE}
            self.assertGreater(len(seen), 96 * 96 // 12)
            self.assertGreater(len(seen & shape), 0.9 * len(seen), "from the same place")
            self.assertLess(len(seen), 0.9 * len(shape), "leaves with gaps between them")
            self.assertGreater(sum(is_green(tree[y][x]) for x, y in seen), len(seen) // 3)

    def test_what_cannot_stand_beside_a_shape(self):
        for flags in (("--figure17",), ("--as", "shape"), ("-o", self.out / "a.exr")):
            self.refuse(["--beside"], "--beside", *flags)

    def test_looks(self):
        pictures = {
            look: self.pixels("--look", look, *MESH)[2]
            for look in ("phong", "watercolour", "normals", "depth")
        }
        seen = {(x, y) for y in range(96) for x in range(96) if pictures["phong"][y][x] != WHITE}
        for look in ("watercolour", "normals"):
            colours = {pictures[look][y][x] for x, y in seen}
            self.assertGreater(len(colours), 100, look)
        self.assertTrue(all(len(set(pixel)) == 1 for row in pictures["depth"] for pixel in row))
        paper = pictures["watercolour"][2][2]
        self.assertGreater(min(paper), 200, "paper stays light")

    def test_any_size(self):
        for size in ("1x1", "7x3", "40x100"):
            for look in ("phong", "watercolour"):
                width, height, _ = self.pixels("--size", size, "--look", look, *MESH)
                self.assertEqual(f"{width}x{height}", size)

    def test_the_same_bytes_again_and_with_any_threads(self):
        for flags in (("--look", "watercolour"), MESH, ("--look", "normals")):
            first = self.bytes(*flags, "--threads", "2")
            self.assertEqual(self.bytes(*flags, "--threads", "2"), first)
            self.assertEqual(self.bytes(*flags, "--threads", "1"), first)

    def test_viewpoints(self):
        names = ("front", "three-quarter", "top")
        pictures = {self.bytes("--camera", name, *MESH) for name in names}
        self.assertEqual(len(pictures), 3)
        rows = self.pixels("--camera", "top", *MESH)[2]
        seen = [pixel for row in rows for pixel in row if pixel != WHITE]
        self.assertGreater(sum(map(is_green, seen)), 0.9 * len(seen), "the crown hides the trunk")

    def test_shape_options_count(self):
        thin = self.bytes("--style", "paper-thin", *MESH)
        self.assertNotEqual(self.bytes("--style", "fat", *MESH), thin)
        self.assertNotEqual(self.bytes("--style", "paper-thin"), self.bytes("--style", "fat"))

    def test_buffers_as_exr(self):
        exr = self.out / "buffers.exr"
        self.render("-o", exr, *MESH)
        data = exr.read_bytes()
        self.assertEqual(data[:4], b"\x76\x2f\x31\x01")
        header = data[: data.index(b"screenWindowWidth")]
        for channel in (b"A", b"B", b"G", b"N.X", b"P.Z", b"R", b"Z", b"id", b"key", b"open"):
            self.assertIn(b"\0" + channel + b"\0", header)
        self.assertEqual(self.written(), ["buffers.exr", "picture.png"])

    def test_what_it_says(self):
        self.assertEqual(self.render("-q", *MESH).stderr, "")
        said = self.render(*MESH)
        self.assertEqual(said.stdout, "")
        self.assertEqual(len(said.stderr.splitlines()), 1)
        self.assertIn("picture.png", said.stderr)
        steps = [line.split()[0] for line in self.render("-v").stderr.splitlines()]
        for step in ("field", "rays", "paint", "write"):
            self.assertIn(step, steps)


class Cameras(Render):
    def test_a_file(self):
        low, high = self.bounds()
        middle = [(a + b) / 2 for a, b in zip(low, high)]
        far = [middle[0], middle[1], middle[2] + 5 * (high[1] - low[1])]
        file = self.camera(eye=far, target=middle, angle=20)
        rows = self.pixels("--camera", file, *MESH)[2]
        self.assertNotEqual(rows[48][48], WHITE)
        lens = {"yfov": math.radians(20), "znear": 1}
        document = {
            "asset": {"version": "2.0"},
            "nodes": [{"camera": 0, "translation": far}],
            "cameras": [{"type": "perspective", "perspective": lens}],
        }
        node = self.input("camera.glb", glb.pack(document))
        self.assertEqual(self.pixels("--camera", node, *MESH)[2], rows)

    def test_inside_the_crown(self):
        low, high = self.bounds()
        eye = [(a + b) / 2 for a, b in zip(low, high)]
        file = self.camera(eye=eye, target=[eye[0] + 1, eye[1], eye[2]], angle=90)
        for flags in ((), MESH, ("--look", "watercolour"), ("--look", "depth")):
            result = self.render("--camera", file, *flags)
            self.assertNotIn("nothing is in view", result.stderr)

    def test_nothing_in_view(self):
        file = self.camera(eye=[0, 0, 1e5], target=[0, 0, 2e5])
        for flags in ((), MESH):
            result = self.render("--camera", file, *flags)
            self.assertIn("warning: nothing is in view", result.stderr)
            rows = png.pixels(self.picture.read_bytes())[2]
            self.assertEqual({pixel for row in rows for pixel in row}, {WHITE})
        result = self.render("--camera", file, "--look", "watercolour")
        self.assertIn("warning: nothing is in view", result.stderr)

    def test_refusals(self):
        self.refuse(["'frnt'", "Did you mean front?"], "--camera", "frnt")
        self.refuse(["no.json", "cannot be read"], "--camera", "no.json", code=3)
        folder = self.folder
        self.refuse([str(folder), "cannot be read"], "--camera", folder, code=3)
        for words, camera in (
            (["JSON"], b"not JSON"),
            (["eye", "missing"], b'{"target": [0, 0, 0]}'),
            (["target"], b'{"eye": [1, 2, 3], "target": [1, 2, 3]}'),
            (["up"], b'{"eye": [0, 9, 0], "target": [0, 0, 0]}'),
            (["angle"], b'{"eye": [0, 0, 9], "target": [0, 0, 0], "angle": 180}'),
            (["fov"], b'{"eye": [0, 0, 9], "target": [0, 0, 0], "fov": 30}'),
        ):
            file = self.input("camera.json", camera)
            self.refuse(["camera.json", *words], "--camera", file, code=3)
        self.refuse(["perspective camera"], "--camera", self.tree, code=3)
        far = self.camera(eye=[0, 0, 1e30], target=[0, 0, 0])
        for flags in ((), MESH):
            self.refuse(["camera", "too far"], "--camera", far, *flags)


class Subjects(Render):
    def setUp(self):
        super().setUp()
        shapes = self.folder / "shapes"
        shapes.mkdir()
        self.glb, self.obj, self.field = (shapes / f"ash.{kind}" for kind in ("glb", "obj", "vdb"))
        self.succeed("extract", ASH, *DRAFT, "-o", self.glb, "-o", self.obj, "-o", self.field)

    def test_shapes_are_told_from_trees(self):
        first = self.pixels(subject=self.glb)
        paper = first[2][0][0]
        for shape in (self.glb, self.obj):
            result = self.render(subject=shape)
            self.assertIn(f"{shape} is drawn as an abstract shape", result.stderr)
            rows = png.pixels(self.picture.read_bytes())[2]
            self.assertTrue(any(is_green(pixel) for row in rows for pixel in row))
            if shape == self.glb:
                self.assertEqual(rows, first[2])
            # An OBJ file does not hold the leaves' colour.
            for row, first_row in zip(rows, first[2], strict=True):
                self.assertEqual([p == paper for p in row], [p == paper for p in first_row])
        self.assertNotIn("abstract shape", self.render("--as", "shape", subject=self.glb).stderr)
        self.assertNotIn("abstract shape", self.render(*MESH).stderr)
        as_shape = self.bytes("--as", "shape")
        self.assertNotEqual(as_shape, self.bytes(*MESH), "leaves, not their shape")

    def test_a_shape_taken_for_a_tree_is_a_guess(self):
        result = self.render("--as", "tree", subject=self.obj)
        self.assertIn("the choice of leaves is a guess", result.stderr)

    def test_leaf_colour(self):
        def shares(*flags):
            rows = self.pixels(*flags)[2]
            pixels = [p for row in rows for p in row]
            return [sum(p[i] > p[j] + 25 for p in pixels) for i, j in ((0, 1), (1, 0), (2, 1))]

        for look in ("phong", "watercolour"):
            with self.subTest(look):
                own, red = shares("--look", look), shares("--look", look, "--leaf-colour", "#b01020")
                self.assertGreater(own[1], 20 * own[2])
                self.assertGreater(red[0], 4 * own[0])
                self.assertLess(red[1], own[1] / 4)

    def test_a_shape_has_no_density(self):
        self.refuse(["--surface direct", "density"], "--surface", "direct", subject=self.glb)
        self.refuse(["--figure17", "tree"], "--figure17", subject=self.glb)
        result = self.render("--style", "paper-thin", subject=self.glb)
        self.assertIn("warning: --style has no effect", result.stderr)

    def test_a_density(self):
        for flags in ((), MESH, ("--look", "watercolour")):
            rows = self.pixels(*flags, subject=self.field)[2]
            self.assertTrue(any(is_green(pixel) for row in rows for pixel in row))
        result = self.render("--coverage", "0.5", *MESH, subject=self.field)
        self.assertIn("warning: --coverage has no effect", result.stderr)
        result = self.render("--as", "tree", *MESH, subject=self.field)
        self.assertIn("warning: --as has no effect", result.stderr)

    def test_a_density_that_cannot_be_drawn(self):
        self.refuse(["was sampled only for T"], "--threshold", "50", subject=self.field)
        self.refuse(["no.vdb"], subject="no.vdb", code=3)
        broken = self.input("broken.vdb", self.field.read_bytes()[:5000])
        self.refuse(["broken.vdb"], subject=broken, code=3)

    def test_direct_and_mesh_agree(self):
        for subject in (ASH, self.field):
            direct = self.pixels("--surface", "direct", subject=subject)[2]
            mesh = self.pixels(*MESH, subject=subject)[2]
            both = [(a != WHITE, b != WHITE) for p, q in zip(direct, mesh) for a, b in zip(p, q)]
            common = sum(a and b for a, b in both) / sum(a or b for a, b in both)
            self.assertGreater(common, 0.97, subject)

    def test_options_of_meshes_do_not_count_without_one(self):
        flags = ("--no-snap", "--mesher", "vdb", "--adaptivity", "0.5")
        result = self.render(*flags)
        for flag in ("--no-snap", "--mesher", "--adaptivity"):
            warning = f"warning: {flag} has no effect without --surface mesh"
            self.assertIn(warning, result.stderr)
        self.assertEqual(self.picture.read_bytes(), self.bytes())
        self.assertNotIn("no effect", self.render(*flags, *MESH).stderr)

    def test_an_empty_surface(self):
        for flags in ((), MESH):
            self.refuse(["surface is empty"], "--threshold", "1e9", *flags, code=6)


class Watercolours(Render):
    def test_styles(self):
        pictures = {
            self.bytes("--look", "watercolour", *MESH, "--watercolour-style", style)
            for style in ("classic", "wet", "dry")
        }
        self.assertEqual(len(pictures), 3)
        default = self.bytes("--look", "watercolour", *MESH)
        self.assertIn(default, pictures)
        file = self.input("own.json", b'{"base": "classic", "paper": "#ff0000"}')
        rows = self.pixels("--look", "watercolour", *MESH, "--watercolour-style", file)[2]
        red, green, _ = rows[2][2]
        self.assertGreater(red, green + 100)

    def test_detail(self):
        paint = ("--look", "watercolour", *MESH)
        none, most = (self.bytes(*paint, "--detail", detail) for detail in "01")
        self.assertNotEqual(none, most)

    def test_without_effect(self):
        result = self.render(*MESH, "--detail", "1", "--watercolour-style", "wet")
        for flag in ("--detail", "--watercolour-style"):
            self.assertIn(f"warning: {flag} has no effect with --look phong", result.stderr)

    def test_refusals(self):
        style = "--watercolour-style"
        self.refuse(["'clasic'", "Did you mean classic?", "classic, wet, dry"], style, "clasic")
        self.refuse(["no.json"], style, "no.json", code=3)
        for words, text in (
            (["own.json"], b"{"),
            (["own.json", "wetnes"], b'{"wetnes": 1}'),
            (["own.json", "bleeding"], b'{"bleeding": "much"}'),
            (["own.json", "shadow"], b'{"shadow": {"wetness": 99}}'),
            (["own.json", "too large", "1e999"], b'{"sky": 1e999}'),
            (["own.json", "no key 'a b'"], b'{"a\\nb": 1}'),
        ):
            self.refuse(words, style, self.input("own.json", text))
        self.refuse(["--detail '2'", "from 0 to 1"], "--detail", "2")
        self.refuse(["--detail 'x'", "not a number"], "--detail", "x")


class Plate(Render):
    def test_figure17(self):
        width, height, rows = self.pixels("--figure17", "--size", "64x64", *MESH)
        self.assertGreater(width, 128)
        self.assertGreater(height, 3 * 64)
        self.assertTrue(any(is_green(pixel) for row in rows for pixel in row))
        self.assertEqual(self.written(), ["picture.png"])

    def test_other_options_win_over_the_rows(self):
        small = ("--figure17", "--size", "32x32", *MESH)
        self.assertNotEqual(self.bytes(*small, "--threshold", "60%"), self.bytes(*small))

    def test_the_papers_values(self):
        small = ("--size", "32x32", *MESH)
        paper = self.bytes("--figure17", "paper", *small)
        self.assertNotEqual(paper, self.bytes("--figure17", *small))
        own = self.bytes("--figure17", "paper", *small, "--points", "vertices", "--threshold", "1.5")
        self.assertNotEqual(paper, own)

    def test_a_sheet_past_the_largest_file(self):
        self.refuse(["sheet", "PNG", "--size"], "--figure17", "--size", "16384x16384")

    def test_contradictions(self):
        self.refuse(["'pape'"], "--figure17", "pape")
        self.refuse(["--figure17", "--turntable"], "--figure17", "--turntable", "3")
        self.refuse(["--figure17", "--look depth"], "--figure17", "--look", "depth")
        self.refuse(["one .png"], "--figure17", "-o", self.out / "a.exr")
        result = self.render("--figure17", "--size", "32x32", *MESH, "--style", "painterly")
        self.assertIn("--style has no effect", result.stderr)


class Refusals(Render):
    def test_sizes(self):
        for size in ("0x96", "96x0", "-1x96", "96", "96x", "x", "9.5x9", "axb", "16385x1", "1x2x3"):
            self.refuse(["--size"], "--size", size)
        self.refuse(["WIDTHxHEIGHT"], "--size", "96")

    def test_a_size_past_the_memory(self):
        limit = 4 << 30
        self.refuse(
            ["16384x8192", "GiB", "fits", "--size"],
            *("--size", "16384x8192"),
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)),
        )

    def test_outputs(self):
        self.fail_with(2, ["no output", "-o picture.png"], "render", ASH)
        for name, words in (
            ("picture", ["no extension"]),
            ("picture.jpg", [".jpg", ".png"]),
            ("picture.mp4", ["film", "--turntable"]),
            ("picture.webp", ["film", "--turntable"]),
        ):
            self.fail_with(2, words, "render", ASH, "-o", self.out / name)
        self.refuse(["same file"], "-o", self.out / "." / "picture.png")
        tree = self.input("tree.png", self.tree.read_bytes())
        self.fail_with(2, ["input itself"], "render", tree, "-o", tree)
        self.assertEqual(tree.read_bytes(), self.tree.read_bytes())
        missing = self.out / "missing" / "picture.png"
        self.fail_with(5, ["missing"], "render", "no.glb", "-o", missing)

    def test_names(self):
        self.refuse(["'fong'", "Did you mean phong?"], "--look", "fong")
        self.refuse(["direct, mesh"], "--surface", "polygons")
        self.refuse(["tree, shape"], "--as", "bush")
        self.refuse(["--surfce", "Did you mean --surface?"], "--surfce", "mesh")
        self.refuse(["--quiet", "--verbose"], "-q", "-v")
        self.fail_with(3, ["no.glb"], "render", "no.glb", "-o", self.picture)
        self.fail_with(2, ["no TREE"], "render", "-o", self.picture)

    def test_help(self):
        page = self.succeed("render", "--help").stdout
        for flag in (
            "--output", "--look", "--size", "--camera", "--turntable", "--surface",
            "--watercolour-style", "--detail", "--as", "--figure17", "--style", "--device",
        ):  # fmt: skip
            self.assertRegex(page, rf"(?m)^  (-\w, )?{flag}\b")
