# SPDX-License-Identifier: Apache-2.0
"""A forest that was cut off loses nothing: it continues and ends with the same bytes."""

import json
import os
import pathlib
import pty
import random
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import time

from forests import COARSE, MPIRUN, UNDER_MPIRUN, ForestTest, files_in, mpirun

TILED = (*COARSE, "--tile", "32")


class CutOff(ForestTest):
    def setUp(self):
        super().setUp()
        self.scene = self.scatter(60)
        self.flags = (*TILED, "--levels", "2", "--single", self.out / "cut" / "all.glb")
        self.place = self.out / "cut"

    def undisturbed(self):
        self.forest(self.scene, "cut", *self.flags)  # this run may compile kernels
        begin = time.monotonic()
        self.forest(self.scene, "cut", *self.flags, "--restart")
        self.seconds = time.monotonic() - begin
        return files_in(self.place)

    def start(self, *flags, before=(), **options):
        return subprocess.Popen(
            [*before, os.environ["LEAFHULL"], "forest", self.scene, "-o", self.place, *self.flags,
             *flags],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
            env=os.environ | UNDER_MPIRUN, **options,
        )  # fmt: skip

    def test_killed_twenty_times(self):
        whole = self.undisturbed()
        pick = random.Random(20)
        killed = forests = 0
        flags = ("--restart",)
        while killed < 20:
            self.assertLess(forests, 40, "runs end before they can be killed")
            process = self.start(*flags)
            time.sleep(pick.uniform(0, self.seconds))
            process.send_signal(signal.SIGKILL)
            _, text = process.communicate(timeout=60)
            if process.returncode == -signal.SIGKILL:
                killed += 1
                flags = ("--resume",) if (self.place / "work").exists() else ("--restart",)
                continue
            self.assertEqual(process.returncode, 0, text)
            self.assert_same_files(self.place, whole)
            forests += 1
            flags = ("--restart",)
        self.forest(self.scene, "cut", *self.flags, "--resume")
        self.assert_same_files(self.place, whole)

    def run_with_files_up_to(self, size):
        """A run whose files cannot grow beyond `size` once it has begun to write tiles."""
        ignore = lambda: signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # noqa: E731
        process = self.start(preexec_fn=ignore)
        while process.poll() is None and not list(self.place.glob("work/*/*.glb")):
            time.sleep(0.001)
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (size, size))
        _, text = process.communicate(timeout=300)
        return subprocess.CompletedProcess(process.args, process.returncode, stderr=text)

    def assert_says_what_is_left(self, result):
        told = re.search(r"\. (\d+) of (\d+) tiles are still to do; the same command with --resume "
                         r"continues\.\n\Z", result.stderr)  # fmt: skip
        self.assertIsNotNone(told, result.stderr)
        journals = (self.place / "work").glob("journal-*")
        done = sum(len(journal.read_text().splitlines()) for journal in journals)
        self.assertEqual(int(told[2]) - int(told[1]), done)

    def assert_one_line(self, result):
        self.assertEqual(result.returncode, 5, result.stderr)
        self.assertRegex(result.stderr, r"\Aleafhull: error: cannot write [^\n]*\n\Z")

    def test_a_file_that_is_too_large(self):
        whole = self.undisturbed()
        largest = max(len(data) for name, data in whole.items() if name.startswith("tiles/"))
        self.assertGreater(len(whole["all.glb"]), largest)
        for limit in (1000, largest // 2, largest + 1000):
            with self.subTest(limit):
                shutil.rmtree(self.place)
                result = self.run_with_files_up_to(limit)
                self.assert_one_line(result)
                self.assert_says_what_is_left(result)
                left = [name for name in files_in(self.place) if name.endswith(".tmp")]
                self.assertEqual(left, [])
                self.forest(self.scene, "cut", *self.flags, "--resume")
                self.assert_same_files(self.place, whole)

    def test_a_full_disk(self):
        whole = self.undisturbed()
        disk = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        size = sum(map(len, whole.values()))
        mount = ["mount", "-t", "tmpfs", "-o", f"size={size // 2}", "tmpfs", disk]
        if subprocess.run(mount, stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("no file system can be mounted here: nothing is known of full disks")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        self.place = disk / "cut"
        self.flags = (*TILED, "--levels", "2", "--single", self.place / "all.glb")
        self.assert_one_line(
            self.run_command("forest", self.scene, "-o", self.place, *self.flags)
        )
        self.assert_one_line(
            self.run_command("forest", self.scene, "-o", self.place, *self.flags, "--resume")
        )
        subprocess.run(["mount", "-o", "remount,size=1G", disk], check=True)
        self.succeed("forest", self.scene, "-o", self.place, *self.flags, "--resume")
        self.assert_same_files(self.place, whole)

    def test_mpirun_killed_with_all_ranks(self):
        if not MPIRUN:
            self.skipTest("leafhull is built without MPI")
        whole = self.undisturbed()
        shutil.rmtree(self.place)
        for seconds in (0.5, 1, 1.5):
            process = self.start("--resume", before=mpirun(2))
            time.sleep(seconds)
            process.kill()
            process.communicate(timeout=60)
            time.sleep(0.5)  # time for the ranks to see that mpirun is gone
        process = self.start("--resume", before=mpirun(2))
        _, text = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, text)
        self.assert_same_files(self.place, whole)


class TimeLeft(ForestTest):
    def bar(self, *arguments):
        """What a terminal shows of standard error, redraw by redraw."""
        ours, theirs = pty.openpty()
        os.set_blocking(ours, True)
        with open(theirs, "wb") as terminal, open(ours, "rb", buffering=0) as screen:
            process = subprocess.Popen(
                [os.environ["LEAFHULL"], *map(str, arguments)], stdout=terminal, stderr=terminal
            )
            terminal.close()
            shown = b""
            try:
                while data := screen.read(4096):
                    shown += data
            except OSError:  # Linux reports this way that no writer is left
                pass
            self.assertEqual(process.wait(timeout=300), 0, shown)
        return shown.decode().split("\r\033[K")

    def test_what_was_done_before_tells_no_pace(self):
        """The pass before the tiles does not count for the pace either."""
        scene = self.scatter(60)
        flags = ("--voxel-size", "0.1", "--tile", "64", "--control-scope", "scene")
        self.forest(scene, "forest", *flags, "--tile-range", "1/2")
        (journal,) = (self.out / "forest" / "work").glob("journal-*")
        done = len(journal.read_text().splitlines())
        self.assertGreater(done, 4)
        bar = self.bar("forest", scene, "-o", self.out / "forest", *flags, "--resume")
        tiles = [line for line in bar if line.startswith("tiles ")]
        self.assertIn("left", "".join(tiles))
        first = [line for line in tiles if re.search(rf"\] {done} of ", line)]
        self.assertEqual(len(first), 1, tiles)
        self.assertNotIn("left", first[0])


class Folders(ForestTest):
    def setUp(self):
        super().setUp()
        self.scene = self.scatter(20)
        self.place = self.out / "forest"

    def refuse(self, code, words, *flags, scene=None):
        before = files_in(self.place)
        result = self.run_command("forest", scene or self.scene, "-o", self.place, *flags)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertRegex(result.stderr, r"\Aleafhull: error: [^\n]*\n\Z")
        for word in words:
            self.assertIn(word, result.stderr)
        after = files_in(self.place)
        for name in after.keys() - before.keys():  # only an empty journal may appear
            self.assertRegex(name, "^work/journal-")
            self.assertEqual(after.pop(name), b"")
        self.assertEqual(after, before, "nothing is changed")

    def unfinished(self, *flags):
        self.forest(self.scene, "forest", *(flags or TILED), "--tile-range", "1/2")

    def test_an_unfinished_forest(self):
        self.unfinished()
        self.refuse(2, ["unfinished", "--resume", "--restart"], *TILED)
        self.forest(self.scene, "forest", *TILED, "--resume")
        self.forest(self.scene, "other", *TILED)
        self.assert_same_files(self.place, files_in(self.out / "other"))

    def test_control_over_the_scene_is_kept(self):
        flags = (*TILED, "--control-scope", "scene")
        self.unfinished(*flags)
        kept = self.place / "work" / "control.json"
        text = kept.read_text()
        kept.write_text(text.replace('"mean": ', '"mean": 1'))
        self.refuse(3, ["control.json", "damaged", "--restart"], *flags, "--resume")
        kept.write_text(text)
        result = self.forest(self.scene, "forest", *flags, "--resume", "--verbose")
        self.assertNotIn("control", result.stderr, "it is not computed again")
        self.forest(self.scene, "other", *flags)
        self.assert_same_files(self.place, files_in(self.out / "other"))

    def test_a_finished_forest(self):
        self.forest(self.scene, "forest", *TILED)
        self.refuse(2, ["finished", "--resume", "--restart"], *TILED)
        before = {path: path.stat().st_mtime_ns for path in self.place.rglob("*")}
        result = self.forest(self.scene, "forest", *TILED, "--resume")
        self.assertRegex(result.stderr, r"\Aleafhull: .*finished; nothing was left to do\n\Z")
        self.assertEqual({path: path.stat().st_mtime_ns for path in self.place.rglob("*")}, before)
        self.refuse(2, ["finished, without all.glb"], *TILED, "--resume",
                    "--single", self.place / "all.glb")  # fmt: skip

    def test_other_options(self):
        for finished in (False, True):
            if finished:
                self.forest(self.scene, "forest", *TILED, "--restart")
            else:
                self.unfinished()
            for words, flags in (
                (["options.threshold is null there and 0.5 here"], (*TILED, "--threshold", "0.5")),
                (["voxel_size is 0.3 there and 0.25 here"],
                 ("--voxel-size", "0.25", "--tile", "32")),
                (["tile is 32 there and 64 here"], (*COARSE, "--tile", "64")),
                (["levels is 1 there and 2 here"], (*TILED, "--levels", "2")),
                (['control_scope is "model" there and "scene" here'],
                 (*TILED, "--control-scope", "scene")),
                (['options.style is "painterly" there and "paper-thin" here'],
                 (*TILED, "--style", "paper-thin")),
            ):  # fmt: skip
                with self.subTest(words, finished=finished):
                    words = [*words, "another forest", "--restart"]
                    self.refuse(2, words, *flags, "--resume")
                    self.refuse(2, words, *flags)
            self.refuse(2, ['merge is "canopy" there and "none" here'], "--merge", "none",
                        *COARSE, "--resume")  # fmt: skip

    def test_another_scene(self):
        self.unfinished()
        other = self.scatter(21)
        self.refuse(2, ["trees is 20 there and 21 here"], *TILED, "--resume", scene=other)
        moved = self.scatter(20, "--seed", "2")
        self.refuse(2, ["placing"], *TILED, "--resume", scene=moved)

    def test_trees_that_stand_otherwise(self):
        rows = ["oak.glb,5,0,5,0,1", "elm.glb,15,0,5,0,1", "oak.glb,25,0,5,0,1"]
        self.forest(self.stand(*rows), "forest", *TILED, "--tile-range", "1/2")
        for place, row in (
            (0, "oak.glb,5,0,5,90,1"),
            (1, "elm.glb,15,0,5,0,1.2"),
            (2, "elm.glb,25,0,5,0,1"),
            (2, "oak.glb,25,0,5.5,0,1"),
        ):
            with self.subTest(row):
                other = self.stand(*rows[:place], row, *rows[place + 1 :], name="other.csv")
                self.refuse(2, ["placing"], *TILED, "--resume", scene=other)
        self.forest(self.stand(*rows), "forest", *TILED, "--resume")

    def test_another_model(self):
        self.unfinished()
        oak, elm = (self.folder / f"{name}.glb" for name in ("oak", "elm"))
        oak.write_bytes(elm.read_bytes())
        self.refuse(2, ["models.", "sha256"], *TILED, "--resume")

    def test_restart(self):
        for begin in (lambda: self.unfinished(), lambda: self.forest(self.scene, "forest", *TILED)):
            begin()
            flags = (*COARSE, "--tile", "64", "--levels", "2")
            self.forest(self.scene, "forest", *flags, "--restart")
            self.forest(self.scene, "other", *flags)
            self.assert_same_files(self.place, files_in(self.out / "other"))
            shutil.rmtree(self.place)
            shutil.rmtree(self.out / "other")

    def test_restart_removes_only_forests(self):
        self.place.mkdir()
        (self.place / "tiles").mkdir()
        (self.place / "tiles" / "roof.txt").write_text("terracotta")
        (self.place / "manifest.json").write_text('{"name": "a web page"}')
        for flags in ((), ("--resume",), ("--restart",)):
            result = self.run_command("forest", self.scene, "-o", self.place, *TILED, *flags)
            self.assertIn(result.returncode, (2, 3), result.stderr)
            self.assertIn(str(self.place), result.stderr)
        self.assertEqual((self.place / "tiles" / "roof.txt").read_text(), "terracotta")
        self.assertEqual((self.place / "manifest.json").read_text(), '{"name": "a web page"}')

    def test_a_damaged_journal(self):
        self.unfinished()
        (journal,) = (self.place / "work").glob("journal-*")
        lines = journal.read_bytes().splitlines(keepends=True)
        self.assertGreater(len(lines), 3)
        for damaged in (
            lines[1].replace(b'"vertices":', b'"vertices":1', 1),
            lines[1].replace(b"{", b"", 1),
            b"not even JSON\n",
            b"\0" * 100 + b"\n",
        ):
            journal.write_bytes(lines[0] + damaged + b"".join(lines[2:]))
            self.refuse(3, [journal.name, "line 2", "damaged", "--restart"], *TILED, "--resume")
        # A line that was cut off counts as missing.
        journal.write_bytes(b"".join(lines[:-1]) + lines[-1][:-20])
        self.forest(self.scene, "forest", *TILED, "--resume")
        self.forest(self.scene, "other", *TILED)
        self.assert_same_files(self.place, files_in(self.out / "other"))

    def test_a_damaged_tile(self):
        self.forest(self.scene, "other", *TILED)
        for ending in ("glb", "seam"):
            for damage in (lambda data: data[:-1], lambda data: data[:-1] + b"\xa5"):
                self.unfinished()
                tile = max((self.place / "work").rglob(f"*.{ending}"))
                tile.write_bytes(damage(tile.read_bytes()))
                result = self.run_command("forest", self.scene, "-o", self.place, *TILED, "--resume")
                if result.returncode != 0:  # only a checksum shows the damage
                    self.assertEqual(result.returncode, 3, result.stderr)
                    self.assertIn("is damaged", result.stderr)
                    self.assertIn("--resume", result.stderr)
                    result = self.forest(self.scene, "forest", *TILED, "--resume")
                self.assertIn(str(tile), result.stderr)
                self.assert_same_files(self.place, files_in(self.out / "other"))
                shutil.rmtree(self.place)

    def test_a_damaged_manifest(self):
        self.forest(self.scene, "forest", *TILED)
        manifest = self.place / "manifest.json"
        text = manifest.read_text()
        for damaged in (text.replace('"trees": 20', '"trees": 21'), text[:-10], "", "[]", "{}"):
            manifest.write_text(damaged)
            words = ["manifest.json", "--restart"]
            self.refuse(3, words, *TILED, "--resume")
            self.refuse(3, words, *TILED)
        foreign = json.loads(text)
        foreign["schema"] = "leafhull-forest/99"
        manifest.write_text(json.dumps(foreign))
        self.refuse(3, ["manifest.json", "leafhull-forest/99"], *TILED, "--resume")
        manifest.write_text(text)
        self.forest(self.scene, "forest", *TILED, "--resume")

    def test_a_finished_forest_that_has_lost_a_tile(self):
        self.forest(self.scene, "forest", *TILED)
        tile = next((self.place / "tiles").rglob("*.glb"))
        tile.unlink()
        self.refuse(3, [tile.name, "missing", "--restart"], *TILED, "--resume")
        self.forest(self.scene, "forest", *TILED, "--restart")
        self.assertTrue(tile.exists())
