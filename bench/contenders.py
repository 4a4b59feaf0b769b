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
BY_VDB = "leafhull isotropic, --mesher vdb"
PUBLISHED = tuple(f"published {method}" for method in METHODS)
LITERAL = "published controlled, literally"
SPHERES = "OpenVDB rasterizeSmoothSpheres"
PEERS = ("OpenVDB ParticlesToLevelSet", "CGAL alpha_wrap_3", "Blender", "splashsurf")
SURVEYS = tuple(f"bench_limit {method}" for method in METHODS)
COLD = "leafhull controlled, kernels to compile"
LOOKS = ("phong", "watercolour")
PICTURE_SIZES = (512, 1024, 2048)


def threaded(method: str, count: int) -> str:
    return f"leafhull {method}, {count} thread{'s' * (count > 1)}"


def picture(surface: str, look: str, size: int = 1024) -> str:
    return f"{surface} {look}, {size}x{size}"


# Side by side: what is compared at one size, then how memory grows with it.
PICTURES = {
    picture(surface, look, size): (surface, look, size)
    for surface, look, size in (
        *((surface, look, 1024) for look in LOOKS for surface in ("direct", "mesh")),
        *(("direct", "phong", size) for size in PICTURE_SIZES if size != 1024),
    )
}
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
    BY_VDB: program("contender_leafhull", "--method", "isotropic", "--mesher", "vdb"),
    **{f"published {m}": program("contender_published", "--method", m) for m in METHODS},
    **{
        threaded(m, count): program("contender_leafhull", "--method", m, "--threads", str(count))
        for m in METHODS
        for count in (1, 2)
    },
    COLD: program("contender_leafhull", "--method", "controlled"),
    **{
        name: program(
            "contender_picture", "--surface", surface, "--look", look, "--size", str(size)
        )
        for name, (surface, look, size) in PICTURES.items()
    },
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
