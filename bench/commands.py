# SPDX-License-Identifier: Apache-2.0
"""Programs that do not wait but run to their end, as contenders."""

import json
import tempfile
import time
from pathlib import Path

from contender import call


class Extraction:
    """The command from the start of its process to the written file; with `fresh`, every run has
    to compile its kernels."""

    def __init__(self, leafhull: Path, tree: Path, fresh: bool) -> None:
        self.version = call([str(leafhull), "--version"]).removeprefix("leafhull ").strip()
        self.setup: dict = {}
        self._folder = tempfile.TemporaryDirectory()
        self._shape = Path(self._folder.name, "shape.glb")
        self._command = [
            str(leafhull),
            "extract",
            str(tree),
            "-o",
            str(self._shape),
            "--preset",
            "draft",
            "-q",
        ]
        self._fresh = fresh

    def run(self) -> dict:
        with tempfile.TemporaryDirectory() as fresh:
            kernels = fresh if self._fresh else f"{self._folder.name}/kernels"
            self._shape.unlink(missing_ok=True)
            start = time.perf_counter()
            call(self._command, {"POCL_CACHE_DIR": kernels})
            return {"total": time.perf_counter() - start}

    def stop(self) -> None:
        self._folder.cleanup()


class Survey:
    """bench_limit: what the device can do, and what leafhull makes of it on a case."""

    version = ""

    def __init__(self, program: Path, case: Path, method: str) -> None:
        self.setup: dict = {}
        self._command = [str(program), "--pairs", str(case), "--method", method]

    def run(self) -> dict:
        start = time.perf_counter()
        told = json.loads(call(self._command))
        return told | {"total": time.perf_counter() - start}

    def stop(self) -> None:
        pass
