# SPDX-License-Identifier: Apache-2.0
"""splashsurf's reconstruction of the points at a case's kernel radius and voxel size.

splashsurf sums and meshes patch by patch, so only the whole can be timed. It normalises by each
particle's density: its surface, at 0.6 of the interpolated colour, is not the case's."""

import importlib.metadata
import json
import math
import sys
import time
from pathlib import Path


def report(values: dict) -> None:
    print(json.dumps(values), flush=True)


class Reconstruction:
    # The wheel's docstring says absolute lengths; it takes multiples of the particle radius.
    SMOOTHING_LENGTH = 2.0
    SUPPORT = 2 * SMOOTHING_LENGTH

    def __init__(self, case: dict) -> None:
        import numpy
        import pysplashsurf

        self.reconstruct = pysplashsurf.reconstruct_surface
        self.points = numpy.fromfile(case["points"], "<f8").astype("f4").reshape(-1, 3)
        self.voxel = case["voxel"]
        self.particle_radius = case["radius"] / self.SUPPORT

    def run(self) -> dict:
        start = time.perf_counter()
        result = self.reconstruct(
            self.points,
            particle_radius=self.particle_radius,
            smoothing_length=self.SMOOTHING_LENGTH,
            cube_size=self.voxel / self.particle_radius,
        )
        total = time.perf_counter() - start
        if not math.isclose(result.grid.cell_size, self.voxel, rel_tol=1e-5):
            raise RuntimeError(f"voxels of {result.grid.cell_size}, not of {self.voxel}")
        counts = {"vertices": len(result.mesh.vertices), "faces": len(result.mesh.triangles)}
        return {"field": None, "mesh": None, "total": total, **counts}


def main() -> None:
    reconstruction = Reconstruction(json.loads(Path(sys.argv[1]).read_text()))
    version = importlib.metadata.version("pysplashsurf")
    report({"ready": True, "name": "splashsurf", "version": version, "setup": {}})
    for line in sys.stdin:
        if line.strip() != "run":
            break
        report(reconstruction.run())


if __name__ == "__main__":
    try:
        main()
    except Exception as error:
        report({"error": f"{type(error).__name__}: {error}"})
        sys.exit(1)
