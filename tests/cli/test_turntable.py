# SPDX-License-Identifier: Apache-2.0
import os
import shutil
import signal
import struct
import subprocess
import time
import unittest

import png
from command import ASH
from rendering import MESH, SMALL, WHITE, Render

NO_PROGRAMS = {"PATH": "/nonexistent"}
WITH_FFMPEG = unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is missing")


class Turntables(Render):
    def frames(self, count):
        return [f"picture-{i:04}.png" for i in range(1, count + 1)]

    def instead_of_ffmpeg(self, script):
        """An environment whose ffmpeg is a shell script."""
        programs = self.folder / "bin"
        programs.mkdir()
        program = programs / "ffmpeg"
        program.write_text("#!/bin/sh\n" + script)
        program.chmod(0o755)
        return {"PATH": f"{programs}:{os.environ['PATH']}"}

    def test_frames(self):
        result = self.render("--turntable", "4", *MESH, env=NO_PROGRAMS)
        self.assertIn("no film: ffmpeg is not on the PATH", result.stderr)
        self.assertEqual(self.written(), self.frames(4))
        pictures = [(self.out / name).read_bytes() for name in self.frames(4)]
        self.assertEqual(len(set(pictures)), 4)
        for data in pictures:
            rows = png.pixels(data)[2]
            for i in range(96):
                for pixel in (rows[0][i], rows[-1][i], rows[i][0], rows[i][-1]):
                    self.assertEqual(pixel, WHITE, "every frame holds all of it")
        self.render("--turntable", "2", *MESH, env=NO_PROGRAMS)
        halves = [(self.out / name).read_bytes() for name in self.frames(2)]
        self.assertEqual(halves, pictures[::2])

    def test_frames_of_an_earlier_turntable_are_named(self):
        self.render("--turntable", "3", *MESH, env=NO_PROGRAMS)
        result = self.render("--turntable", "2", *MESH, env=NO_PROGRAMS)
        self.assertIn("warning: " + str(self.out / "picture-0003.png"), result.stderr)

    def test_buffers(self):
        self.succeed(
            "render", ASH, *SMALL, *MESH, "--turntable", "2", "-o", self.out / "buffers.exr"
        )
        self.assertEqual(self.written(), ["buffers-0001.exr", "buffers-0002.exr"])

    @WITH_FFMPEG
    def test_a_film_comes_with_the_frames(self):
        self.render("--turntable", "3", "--size", "95x61", *MESH)
        self.assertEqual(self.written(), [*self.frames(3), "picture.mp4"])
        film = (self.out / "picture.mp4").read_bytes()
        self.assertEqual(film[4:8], b"ftyp")
        at = film.index(b"avc1", film.index(b"stsd"))  # H.264; its width and height follow
        self.assertEqual(struct.unpack_from(">HH", film, at + 28), (96, 62))

    @WITH_FFMPEG
    def test_a_film_alone(self):
        film, webp = self.out / "turn.mp4", self.out / "turn.webp"
        self.succeed(
            "render", ASH, *SMALL, *MESH, "--turntable", "3", "-o", film, "-o", webp
        )
        self.assertEqual(self.written(), ["turn.mp4", "turn.webp"])
        self.assertEqual(webp.read_bytes().count(b"ANMF"), 3)

    def test_a_named_film_needs_ffmpeg(self):
        for name in ("turn.mp4", "turn.webp"):
            words = ["ffmpeg is missing", name]
            command = ("render", "no.glb", "--turntable", "3", "-o", self.out / name)
            self.fail_with(5, words, *command, env=NO_PROGRAMS)

    @WITH_FFMPEG
    def test_a_film_that_fails(self):
        env = self.instead_of_ffmpeg("echo broken codec >&2\nexit 1\n")
        result = self.render("--turntable", "2", *MESH, env=env)
        self.assertIn("broken codec", result.stderr)
        self.assertEqual(self.written(), self.frames(2))
        for name in self.frames(2):
            (self.out / name).unlink()
        command = ("render", ASH, *SMALL, *MESH, "--turntable", "2", "-o", self.out / "turn.mp4")
        self.fail_with(5, ["turn.mp4", "broken codec"], *command, env=env)

    @WITH_FFMPEG
    def test_a_film_that_the_disk_does_not_hold(self):
        film = self.out / "turn.mp4"
        command = ("render", ASH, *SMALL, *MESH, "--turntable", "6", "-o", film)
        self.succeed(*command)
        limit = film.stat().st_size // 512 // 2
        self.assertGreater(limit, 0)
        film.unlink()
        # A write past the limit fails, as on a full disk.
        ffmpeg = shutil.which("ffmpeg")
        env = self.instead_of_ffmpeg(f"trap '' XFSZ\nulimit -f {limit}\nexec '{ffmpeg}' \"$@\"\n")
        self.fail_with(5, ["turn.mp4", "ffmpeg says", "File too large"], *command, env=env)

    def test_an_interrupt_leaves_whole_frames(self):
        flags = (*SMALL, *MESH, "--turntable", "5000", "-o", self.picture)
        process = subprocess.Popen(
            [os.environ["LEAFHULL"], "render", str(ASH), *map(str, flags)],
            stderr=subprocess.PIPE,
        )
        deadline = time.monotonic() + 60
        while len(self.written()) < 5 and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGTERM)
        said = process.communicate(timeout=60)[1].decode()
        self.assertIn("stopped; the frames so far are written", said)
        self.assertEqual(process.returncode, -signal.SIGTERM)
        written = self.written()
        self.assertEqual(written, self.frames(len(written)))
        for name in written:
            self.assertEqual(png.pixels((self.out / name).read_bytes())[:2], (96, 96))

    def test_refusals(self):
        for frames in ("0", "-1", "1.5", "x", "36001"):
            self.refuse([f"--turntable '{frames}'", "from 1 to 36000"], "--turntable", frames)
