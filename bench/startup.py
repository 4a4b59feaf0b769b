# SPDX-License-Identifier: Apache-2.0
"""The command from the start of its process to the written file, as a contender."""

import os
import subprocess
import tempfile
import time
from pathlib import Path

from contender import Unavailable


class Command:
    """`leafhull extract` at draft; with `fresh`, every run has to compile its kernels."""

    def __init__(self, leafhull: Path, tree: Path, fresh: bool) -> None:
        self.setup: dict = {}
        self._fresh = fresh
        self._leafhull = leafhull
        self._tree = tree
        self._folder = tempfile.TemporaryDirectory()
        self.version = self._call("--version").removeprefix("leafhull ").strip()

    def run(self) -> dict:
        with tempfile.TemporaryDirectory(dir=self._folder.name) as fresh:
            kernels = fresh if self._fresh else f"{self._folder.name}/kernels"
            shape = f"{fresh}/shape.glb"
            start = time.perf_counter()
            self._call("extract", str(self._tree), "-q", "-o", shape, "--preset", "draft",
                       kernels=kernels)  # fmt: skip
            return {"total": time.perf_counter() - start}

    def stop(self) -> None:
        self._folder.cleanup()

    def _call(self, *arguments: str, kernels: str = "") -> str:
        environment = os.environ | ({"POCL_CACHE_DIR": kernels} if kernels else {})
        try:
            return subprocess.run(
                [self._leafhull, *arguments],
                env=environment,
                check=True,
                capture_output=True,
                text=True,
            ).stdout
        except FileNotFoundError:
            raise Unavailable(f"{self._leafhull} is not built") from None
        except subprocess.CalledProcessError as error:
            raise Unavailable(error.stderr.strip()) from None
