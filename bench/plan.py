# SPDX-License-Identifier: Apache-2.0
"""What is run: the cases, and who runs side by side on them."""

import functools
import json
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import contenders as who
from commands import Extraction, Survey
from heat import Entrant

SHARED = who.ROOT.parent / "shared/trees"
EXAMPLES = who.ROOT / "examples"
CASES = who.ROOT / "build/bench/cases"

TREES = ("aspen-52648", "birch", "ash")
STAND_INS = {"aspen-52648": "synthetic:52648", "birch": "synthetic:56740"}
CROWNS = ("synthetic:400000", "synthetic:1000000")
RESOLUTIONS = (32, 64, 128, 256)
STYLES = ("painterly", "r1.5")

# Leaf vertices at one radius and voxel size: those of 400 k at 128 voxels, painterly.
SERIES = (50_000, 100_000, 200_000, 400_000, 1_000_000)
SERIES_LENGTHS = ("--radius", "0.62", "--voxel", "0.134")

PICTURES = "pictures-"
STANDARD = 128  # voxels

STARTUP = "startup"
CACHED, FRESH = "kernels cached", "kernels to compile"


class Case(NamedTuple):
    name: str
    tree: str
    options: tuple[str, ...]

    def made(self) -> Path:
        return make(self)


@functools.cache
def make(case: Case) -> Path:
    """The case's file."""
    folder = CASES / case.name
    program = str(who.PROGRAMS / "bench_case")
    subprocess.run([program, case.tree, *case.options, "-o", str(folder)], check=True)
    return folder / "case.json"


def about(name: str) -> dict | None:
    """What a made case says of itself, less the paths of this machine."""
    file = CASES / name / "case.json"
    if not file.exists():
        return None
    page = json.loads(file.read_text())
    return {key: value for key, value in page.items() if key not in ("tree", "points", "frames")}


def source_of(tree: str) -> str:
    """The tree's file, or the synthetic crown in its place."""
    for file in (SHARED / f"{tree}.glb", EXAMPLES / f"{tree}.glb"):
        if file.exists():
            return str(file)
    return STAND_INS[tree]


def stand_ins() -> dict[str, str]:
    """The trees that are not here, and what is run instead."""
    return {tree: source_of(tree) for tree in TREES if source_of(tree) == STAND_INS.get(tree)}


def tree_case(tree: str, resolution: int, style: str) -> Case:
    source = source_of(tree) if tree in TREES else tree
    name = Path(source).stem.replace(":", "-")
    options = ("--resolution", str(resolution), "--style", style)
    return Case(f"{name}-{resolution}-{style}", source, options)


def series_case(count: int) -> Case:
    return Case(f"series-{count}", f"synthetic:{count}", SERIES_LENGTHS)


def picture_case(tree: str) -> Case:
    of_tree = tree_case(tree, STANDARD, "painterly")
    return of_tree._replace(name=f"{PICTURES}{Path(of_tree.tree).stem.replace(':', '-')}")


def entrants(case: Case, names: tuple[str, ...]) -> list[Entrant]:
    return [Entrant(case.name, name, lambda n=name: who.start(n, case.made())) for name in names]


def contenders_of(tree: str, resolution: int, style: str) -> tuple[str, ...]:
    """The nearest everywhere, the other peers at fewer sizes: all of it is to take half an hour."""
    names = [*who.OURS, who.BY_VDB, who.SPHERES, *who.PUBLISHED]
    if (tree, resolution) == ("aspen-52648", 32):
        names.append(who.LITERAL)
    if resolution == 128 or style == "painterly":
        names += who.PEERS
    return tuple(names)


def limits(case: Case) -> list[Entrant]:
    program = who.PROGRAMS / "bench_limit"
    return [
        Entrant(case.name, name, lambda m=method: Survey(program, case.made(), m))
        for name, method in zip(who.SURVEYS, who.METHODS, strict=True)
    ]


def startup() -> list[Entrant]:
    bush = SHARED / "bush.glb"
    tree = bush if bush.exists() else EXAMPLES / "ash.glb"
    case = f"{STARTUP}-{tree.stem}-draft"
    return [
        Entrant(case, CACHED, lambda: Extraction(who.LEAFHULL, tree, fresh=False)),
        Entrant(case, FRESH, lambda: Extraction(who.LEAFHULL, tree, fresh=True)),
    ]


def painterly(tree: str, resolution: int = 128) -> Case:
    return tree_case(tree, resolution, "painterly")


def heats() -> Iterator[list[Entrant]]:
    """Each in turn; what the targets need comes first."""
    yield startup()
    for tree in TREES:
        yield entrants(painterly(tree), who.THREADS)
    yield [e for count in SERIES for e in entrants(series_case(count), who.OURS)]
    yield entrants(picture_case("birch"), tuple(who.PICTURES))
    for tree in CROWNS:
        yield entrants(painterly(tree), (*who.OURS, who.BY_VDB, who.SPHERES))
    for tree in TREES:
        for style in STYLES:
            for resolution in RESOLUTIONS:
                names = contenders_of(tree, resolution, style)
                yield entrants(tree_case(tree, resolution, style), names)


def surveys() -> Iterator[list[Entrant]]:
    """What is measured once, without a warm-up."""
    yield entrants(painterly("birch"), (who.COLD,))
    for tree in (*TREES, CROWNS[0]):
        yield limits(painterly(tree))


def quick_heats() -> Iterator[list[Entrant]]:
    yield startup()
    yield entrants(picture_case("ash"), tuple(who.PICTURES))
    for resolution in (32, 64):
        names = (*who.OURS, who.SPHERES, *who.PUBLISHED, *who.PEERS)
        yield entrants(painterly("ash", resolution), names)


def quick_surveys() -> Iterator[list[Entrant]]:
    yield limits(painterly("ash", 64))
