# SPDX-License-Identifier: Apache-2.0
"""Runs the command LEAFHULL in its own folder."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import glb

ASH = pathlib.Path(__file__).parents[2] / "examples" / "ash.glb"


class CommandTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.tree = self.input("tree.glb", glb.tree(*glb.cards()))
        self.out = self.folder / "out"
        self.out.mkdir()
        self.shape = self.out / "shape.glb"

    def input(self, name, data):
        path = self.folder / name
        path.write_bytes(data)
        return path

    def run_command(self, *arguments, env=None, stdout=subprocess.PIPE, **options):
        return subprocess.run(
            [os.environ["LEAFHULL"], *map(str, arguments)],
            stdout=stdout,
            stderr=subprocess.PIPE,
            text=True,
            timeout=300,
            env=os.environ | (env or {}),
            **options,
        )

    def succeed(self, *arguments, **options):
        result = self.run_command(*arguments, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def fail_with(self, code, words, *arguments, **options):
        """The command exits with `code`, prints one error that holds `words`, and writes no file."""
        result = self.run_command(*arguments, **options)
        self.assertEqual(result.returncode, code, f"{arguments}: {result.stderr}")
        lines = result.stderr.splitlines()
        errors = [line for line in lines if line.startswith("leafhull: error: ")]
        self.assertEqual(len(errors), 1, result.stderr)
        self.assertEqual(errors[0], lines[-1], "nothing follows the error")
        self.assertTrue(
            all(line.startswith("leafhull: warning: ") for line in lines[:-1]), result.stderr
        )
        for word in words:
            self.assertIn(word, errors[0])
        self.assertEqual(self.written(), [])
        return result

    def written(self):
        return sorted(path.name for path in self.out.rglob("*"))
