# SPDX-License-Identifier: Apache-2.0
"""Every command of the README runs as it is printed."""

import os
import pathlib
import shlex
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def commands():
    lines = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
    return [line.strip() for line in lines if line.startswith("    leafhull ")]


class Readme(unittest.TestCase):
    def test_every_command(self):
        listed = commands()
        self.assertGreater(len(listed), 12)
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(ROOT / "examples", pathlib.Path(folder) / "examples")
            for command in listed:
                with self.subTest(command):
                    _, *words = shlex.split(command)
                    result = subprocess.run(
                        [os.environ["LEAFHULL"], *words], cwd=folder, capture_output=True, text=True
                    )
                    self.assertEqual(result.returncode, 0, result.stderr)
                    if "-o" in words:
                        output = pathlib.Path(folder) / words[words.index("-o") + 1]
                        numbered = list(output.parent.glob(f"{output.stem}*{output.suffix}"))
                        self.assertTrue(output.exists() or numbered, output)
