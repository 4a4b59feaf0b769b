# SPDX-License-Identifier: Apache-2.0
"""Who takes part: how each contender is started on a case."""

import sys
import tempfile
from pathlib import Path

from contender import Contender

ROOT = Path(__file__).resolve().parent.parent
PROGRAMS = ROOT / "build/release/bench"
LEAFHULL = ROOT / "build/release/leafhull"
SCRIPTS = ROOT / "bench"

METHODS = ("isotropic", "controlled")
OURS = tuple(f"leafhull {method}" for method in METHODS)
BRICKS = "leafhull isotropic, --mesher bricks"
PUBLISHED = tuple(f"published {method}" for method in METHODS)
LITERAL = "published controlled, literally"
SPHERES = "OpenVDB rasterizeSmoothSpheres"
PEERS = ("OpenVDB ParticlesToLevelSet", "CGAL alpha_wrap_3", "Blender", "splashsurf")
SURVEYS = tuple(f"bench_limit {method}" for method in METHODS)
COLD = "leafhull controlled, kernels to compile"


def threaded(method: str, count: int) -> str:
    return f"leafhull {method}, {count} thread{'s' * (count > 1)}"


THREADS = tuple(threaded(method, count) for method in METHODS for count in (1, 2))


def program(name: str, *options: str) -> list[str]:
    return [str(PROGRAMS / name), "CASE", *options]


BLENDER = [
    "blender",
    "--background",
    "--factory-startup",
    "--python-exit-code",
    "1",
    "--python",
    str(SCRIPTS / "blender_contender.py"),
    "--",
    "CASE",
]

COMMANDS = {
    **{f"leafhull {m}": program("contender_leafhull", "--method", m) for m in METHODS},
    BRICKS: program("contender_leafhull", "--method", "isotropic", "--mesher", "bricks"),
    **{f"published {m}": program("contender_published", "--method", m) for m in METHODS},
    **{
        threaded(m, count): program("contender_leafhull", "--method", m, "--threads", str(count))
        for m in METHODS
        for count in (1, 2)
    },
    COLD: program("contender_leafhull", "--method", "controlled"),
    LITERAL: program("contender_published", "--method", "controlled", "--literal"),
    SPHERES: program("contender_rasterize_spheres"),
    "OpenVDB ParticlesToLevelSet": program("contender_particles_to_level_set"),
    "CGAL alpha_wrap_3": program("contender_alpha_wrap"),
    "Blender": BLENDER,
    "splashsurf": [sys.executable, str(SCRIPTS / "splashsurf_contender.py"), "CASE"],
}


class ColdContender(Contender):
    """One whose kernels have to be compiled."""

    def __init__(self, command: list[str]) -> None:
        self._kernels = tempfile.TemporaryDirectory()
        super().__init__(command, {"POCL_CACHE_DIR": self._kernels.name})

    def stop(self) -> None:
        super().stop()
        self._kernels.cleanup()


def start(name: str, case: Path) -> Contender:
    command = [str(case) if word == "CASE" else word for word in COMMANDS[name]]
    return ColdContender(command) if name == COLD else Contender(command)
