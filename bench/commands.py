# SPDX-License-Identifier: Apache-2.0
"""Programs that do not wait but run to their end, as contenders."""

import csv
import json
import os
import tempfile
import time
from collections import Counter
from pathlib import Path

from contender import call, measure


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


class Forest:
    """leafhull forest, or as many of it as there are ranks, from the start of its process to the
    finished folder."""

    def __init__(
        self,
        leafhull: Path,
        scene: Path,
        leaf_vertices: int,
        options: tuple[str, ...],
        ranks: int = 1,
    ) -> None:
        self.version = call([str(leafhull), "--version"]).removeprefix("leafhull ").strip()
        self.setup: dict = {}
        self._leaf_vertices = leaf_vertices
        self._folder = tempfile.TemporaryDirectory(dir=scene.parent)
        self._command = [str(leafhull), "forest", str(scene), *options, "-q"]
        if ranks > 1:
            self._command = ["mpirun", "-n", str(ranks), *self._command]

    def run(self) -> dict:
        with tempfile.TemporaryDirectory(dir=self._folder.name) as folder:
            result = Path(folder, "forest")
            seconds, peak = measure([*self._command, "-o", str(result)], as_root_by_mpi())
            written = sum(file.stat().st_size for file in result.rglob("*") if file.is_file())
        return {
            "total": seconds,
            "peak_memory_bytes": peak,
            "leaf_vertices": self._leaf_vertices,
            "written_bytes": written,
        }

    def stop(self) -> None:
        self._folder.cleanup()


def as_root_by_mpi() -> dict[str, str]:
    """OpenMPI asks root, whom containers have, to say so twice."""
    names = ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM")
    return dict.fromkeys(names, "1") if os.geteuid() == 0 else {}


def total_leaf_vertices(scene: Path, of_tree: dict[Path, int]) -> int:
    """Those of every tree of a scatter file, which names models from its folder."""
    with scene.open(newline="") as file:
        counts = Counter(row["model"] for row in csv.DictReader(file))
    return sum(of_tree[(scene.parent / name).resolve()] * n for name, n in counts.items())
