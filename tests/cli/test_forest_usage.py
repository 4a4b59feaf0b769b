# SPDX-License-Identifier: Apache-2.0
from command import CommandTest


class ForestUsage(CommandTest):
    def setUp(self):
        super().setUp()
        self.scene = self.input("stand.csv", b"model,x,y,z\ntree.glb,0,0,0\n")

    def refuse(self, words, *flags):
        self.fail_with(2, words, "forest", self.scene, "-o", self.out / "stand", *flags)

    def test_what_is_missing(self):
        self.fail_with(2, ["no SCENE", "forest stand.csv"], "forest", "-o", self.out / "stand")
        self.fail_with(2, ["no folder", "-o"], "forest", self.scene)
        self.refuse(["one SCENE"], "other.csv")

    def test_names(self):
        self.refuse(["none, canopy", "Did you mean canopy?"], "--merge", "canoppy")
        self.refuse(["model, scene"], "--control-scope", "all")

    def test_out_of_range(self):
        for flag, text, words in (
            ("--levels", "0", ["1 to 8"]),
            ("--levels", "9", ["1 to 8"]),
            ("--levels", "two", ["1 to 8"]),
            ("--tile", "16", ["32 to 512"]),
            ("--tile", "544", ["32 to 512"]),
            ("--tile", "100", ["multiple of 32", "96 or 128"]),
            ("--memory", "511M", ["512 MiB or more"]),
            ("--memory", "1", ["512 MiB or more"]),
            ("--memory", "4X", ["is not a size", "4G"]),
            ("--memory", "-4G", ["is not a size"]),
            ("--memory", "nan", ["is not a size"]),
            ("--memory", "1e30", ["is not a size"]),
            ("--memory", "G", ["is not a size"]),
            ("--memory", "", ["is not a size"]),
            ("--tile-range", "0/4", ["count from 1", "1/4 to 4/4"]),
            ("--tile-range", "5/4", ["1 to 4"]),
            ("--tile-range", "-1/4", ["1 to 4"]),
            ("--tile-range", "1/0", ["--tile-range, N"]),
            ("--tile-range", "3", ["1/4"]),
            ("--tile-range", "a/4", ["1 to 4"]),
            ("--tile-range", "1/4/4", ["--tile-range, N"]),
            ("--threads", "0", ["1 to 1024"]),
            ("--coverage", "2", ["--coverage"]),
        ):
            self.refuse([flag, *words], flag, text)

    def test_contradictions(self):
        resume, restart, finish = ("--resume",), ("--restart",), ("--finish",)
        part, single = ("--tile-range", "1/4"), ("--single", self.out / "stand.glb")
        for first, second in (
            (resume, restart),
            (finish, part),
            (finish, restart),
            (part, restart),
            (part, single),
        ):
            words = [str(first[0]), str(second[0]), "contradict"]
            self.refuse(words, *first, *second)
            self.refuse(words, *second, *first)
        tile, levels = ("--tile", "64"), ("--levels", "2")
        for flags in (levels, single, tile, part, finish):
            self.refuse(["--merge none", flags[0], "contradict"], "--merge", "none", *flags)
        self.refuse(["--preset", "contradict"], "--preset", "draft", "--voxel-size", "1")
        self.refuse(["--quiet", "--verbose"], "-q", "-v")

    def test_options_that_tiles_cannot_have(self):
        self.refuse(["--mesher", "does not apply to forests", "cracks"], "--mesher", "vdb")
        self.refuse(["--adaptivity", "does not apply to forests", "cracks"], "--adaptivity", "0.5")
        self.refuse(["--hollows fill", "--merge none"], "--hollows", "fill")
        page = self.succeed("forest", "--help").stdout
        self.assertNotIn("--mesher", page)
        self.assertNotIn("--adaptivity", page)

    def test_outputs(self):
        self.refuse(["stand.obj", ".ply"], "--single", self.out / "stand.obj")
        self.refuse(["report.txt", ".json"], "--report", self.out / "report.txt")
        self.fail_with(2, ["input"], "forest", self.tree, "-o", self.out, "--single", self.tree)
        folder = self.folder / "file"
        folder.write_text("")
        self.fail_with(5, ["file"], "forest", self.scene, "-o", folder)
        self.fail_with(
            5, ["missing"], "forest", self.scene, "-o", self.out, "--report", "missing/r.json"
        )

    def test_names_that_are_the_forests_own(self):
        stand, own = self.out / "stand", "one of the forest's files"
        for name in ("manifest.json", "tileset.json", "tiles/0/report.json", "work/report.json"):
            self.refuse([own, name, "--report"], "--report", stand / name)
        for name in ("forest.glb", "tiles/0/0_0_0.glb", "work/all.ply"):
            self.refuse([own, name, "--single"], "--single", stand / name)
        roundabout = self.folder / "out/../out/stand/tiles/../manifest.json"
        self.refuse([own, "--report"], "--report", roundabout)
        self.fail_with(2, [own, "--report"], "forest", self.scene, "-o", "out/stand",
                       "--report", "out/stand/manifest.json", cwd=self.folder)  # fmt: skip
        stand = self.folder / "stand"
        stand.mkdir()
        (stand / "manifest.json").write_text("{}")
        (self.folder / "link").symlink_to(stand)
        (self.folder / "link.json").symlink_to(stand / "manifest.json")
        for name in ("link/manifest.json", "link.json"):
            self.fail_with(2, [own, name, "--report"], "forest", self.scene, "-o", stand,
                           "--report", self.folder / name)  # fmt: skip

    def test_inputs_under_names_that_are_the_forests_own(self):
        stand = self.folder / "stand"
        (stand / "tiles").mkdir(parents=True)
        for name in ("forest.glb", "tiles/tree.glb"):
            data = self.tree.read_bytes()
            (stand / name).write_bytes(data)
            scene = self.input("own.csv", f"model,x,y,z\nstand/{name},0,0,0\n".encode())
            for what, given in (("scene", stand / name), ("model", scene)):
                for merge in ("none", "canopy"):
                    words = ["one of the forest's files", f"the {what}", name]
                    flags = ("-o", stand, "--merge", merge, "--restart")
                    self.fail_with(2, words, "forest", given, *flags)
            self.assertEqual((stand / name).read_bytes(), data)

    def test_a_scene_that_is_not_there(self):
        self.fail_with(3, ["no.csv"], "forest", self.folder / "no.csv", "-o", self.out)

    def test_markdown_has_the_flags_of_forests(self):
        page = self.succeed("help-forests").stdout
        for flag in "--merge --levels --memory --tile-range --resume --single --report".split():
            self.assertRegex(page, rf"(?m)^\| `{flag}\b")
