# SPDX-License-Identifier: Apache-2.0
import json
import os
import resource
import unittest

from command import ASH, CommandTest

# More bytes than the OpenCL compiler writes, and fewer than any shape of the ash has.
FULL = 5 << 18
# Enough bytes for the ash as .vdb but not as .obj.
NEARLY_FULL = 3 << 20


def disk(limit):
    """Options for a process that cannot write files larger than `limit` bytes."""
    return {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))}


class Output(CommandTest):
    def test_missing_folder(self):
        missing = self.out / "missing" / "shape.glb"
        self.fail_with(5, ["missing"], "extract", self.tree, "-o", missing)

    def test_missing_folder_is_seen_before_the_tree_is_read(self):
        missing = self.out / "missing" / "shape.glb"
        self.fail_with(5, ["missing"], "extract", "no.glb", "-o", missing)

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_unwritable_folder(self):
        self.out.chmod(0o555)
        self.addCleanup(self.out.chmod, 0o755)
        self.fail_with(5, ["out"], "extract", self.tree, "-o", self.shape)

    def test_full_disk_leaves_nothing(self):
        command = ("extract", ASH)
        for name in ("shape.glb", "shape.gltf", "shape.obj", "shape.ply", "shape.stl", "shape.vdb"):
            self.fail_with(5, [name], *command, "-o", self.out / name, **disk(FULL))

    def test_full_disk_takes_the_finished_files_back(self):
        first, second = self.out / "first.vdb", self.out / "second.obj"
        limited = disk(NEARLY_FULL)
        self.succeed("extract", ASH, "-o", first, **limited)
        first.unlink()
        self.fail_with(5, ["second.obj"], "extract", ASH, "-o", first, "-o", second, **limited)

    def test_full_disk_keeps_the_former_file(self):
        command = ("extract", ASH)
        former = self.folder / "former.obj"
        former.write_text("precious")
        self.fail_with(5, ["former.obj"], *command, "-o", former, **disk(FULL))
        self.assertEqual(former.read_text(), "precious")

    def test_shapes_cannot_go_to_standard_output(self):
        self.fail_with(2, ["shapes", "standard output"], "extract", self.tree, "-o", "-")

    def test_full_standard_output(self):
        with open("/dev/full", "w") as full:
            for arguments in (
                ("extract", self.tree, "--preset", "paper-32", "--report", "-"),
                ("inspect", self.tree),
                ("devices",),
            ):
                result = self.run_command(*arguments, stdout=full)
                self.assertEqual(result.returncode, 5, arguments)
                self.assertIn("standard output", result.stderr)

    def test_every_format_at_once(self):
        names = ["shape.glb", "shape.gltf", "shape.obj", "shape.ply", "shape.stl", "shape.vdb"]
        outputs = [word for name in names for word in ("-o", self.out / name)]
        extras = ["--save-kernels", self.out / "k.ply", "--save-field", self.out / "f.vdb"]
        report = ["--report", self.out / "r.json"]
        result = self.succeed(
            "extract", self.tree, *outputs, *extras, *report, "--preset", "paper-32"
        )
        self.assertEqual(result.stdout, "")
        for name in [*names, "k.ply", "f.vdb", "r.json"]:
            self.assertGreater((self.out / name).stat().st_size, 0)
            self.assertIn(name, result.stderr)
        self.assertEqual((self.out / "shape.glb").read_bytes()[:4], b"glTF")
        written = json.loads((self.out / "r.json").read_text())
        self.assertEqual(written["schema"], "leafhull-report/1")

    def test_standard_output_is_the_report_alone(self):
        for loudness in ((), ("-v",), ("-q",)):
            result = self.succeed(
                "extract", self.tree, "--preset", "paper-32", "--report", "-", *loudness
            )
            report = json.loads(result.stdout)
            self.assertEqual(report["schema"], "leafhull-report/1")
            self.assertEqual(bool(result.stderr), loudness != ("-q",))

    def test_empty_surface(self):
        for flags in (("--threshold", "1e9"), ("--threshold", "1e7%")):
            self.fail_with(6, ["--threshold"], "extract", self.tree, "-o", self.shape, *flags)
