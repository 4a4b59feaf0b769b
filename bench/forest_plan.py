# SPDX-License-Identifier: Apache-2.0
"""What is run of forests: scenes of many trees, and how leafhull turns them into shapes."""

import functools
import json
from pathlib import Path
from typing import NamedTuple

import contenders as who
import plan
from card_tree import card_tree
from commands import Forest, total_leaf_vertices
from contender import call
from heat import Entrant, Job, Limits

SERIES = (1_000, 2_000, 5_000, 10_000, 20_000)
TWICE = 2_000  # trees, one rank beside two
MODELS, INSTANCES = 30, 1_000_000

# A tree, and the voxel that is a hundredth of its crown's unit and more: 0.25 m for the birch.
TREE, STAND_IN = "birch", "ash"
VOXELS = {TREE: 0.25, STAND_IN: 1.2}
SPACING = "0.8"  # of a crown's width: crowns touch

CASE = "forest"
CANOPY = "canopy, 2 threads"
ONE_RANK, TWO_RANKS = "1 rank, 2 threads", "2 ranks, 1 thread each"
INSTANCED = "instances, 2 threads"

# Those that take long run once.
TURNS = Limits(rounds=3, seconds=120)
ONCE = Limits(rounds=1, seconds=0, warm_up=False)


CARDS = "cards:"  # before the seed of a small tree that is made


class Scene(NamedTuple):
    name: str
    trees: tuple[str, ...]
    count: int

    def made(self) -> Path:
        return make(self)


@functools.cache
def file_of(tree: str) -> str:
    if not tree.startswith(CARDS):
        return tree
    seed = int(tree.removeprefix(CARDS))
    file = plan.CASES / f"{CASE}-models" / f"tree-{seed:02}.glb"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(card_tree(seed))
    return str(file)


@functools.cache
def make(scene: Scene) -> Path:
    """The scene's file."""
    folder = plan.CASES / scene.name
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / "scene.csv"
    options = ("--count", str(scene.count), "--seed", "1", "--spacing", SPACING, "-o", str(file))
    call([str(who.LEAFHULL), "scatter", *map(file_of, scene.trees), *options])
    return file


@functools.cache
def leaf_vertices(scene: Scene) -> int:
    """Those of all its trees."""
    of_file = {}
    for file in map(file_of, scene.trees):
        told = json.loads(call([str(who.LEAFHULL), "inspect", file, "--json"]))
        of_file[Path(file).resolve()] = told["leaves"]["leaf_vertices"]
    return total_leaf_vertices(scene.made(), of_file)


def tree() -> str:
    """The birch, or what is there in its place."""
    return TREE if (plan.SHARED / f"{TREE}.glb").exists() else STAND_IN


def stand_ins() -> dict[str, str]:
    return {} if tree() == TREE else {TREE: tree()}


def stand(count: int) -> Scene:
    """A forest of one model."""
    return Scene(f"{CASE}-{tree()}-{count}", (plan.source_of(tree()),), count)


def of_models(models: int, count: int) -> Scene:
    """A forest of small trees, each model another."""
    trees = tuple(f"{CARDS}{seed}" for seed in range(models))
    return Scene(f"{CASE}-{models}-models-{count}", trees, count)


def entrant(scene: Scene, name: str, options: tuple[str, ...], ranks: int = 1) -> Entrant:
    def start() -> Forest:
        return Forest(who.LEAFHULL, scene.made(), leaf_vertices(scene), options, ranks)

    return Entrant(scene.name, name, start)


def canopy(count: int, name: str = CANOPY, threads: int = 2, ranks: int = 1) -> Entrant:
    voxel = ("--merge", "canopy", "--voxel-size", str(VOXELS[tree()]), "--memory", "4G")
    return entrant(stand(count), name, (*voxel, "--threads", str(threads)), ranks)


def ranks(count: int) -> list[Entrant]:
    return [canopy(count, ONE_RANK, threads=2), canopy(count, TWO_RANKS, threads=1, ranks=2)]


def instanced(models: int, count: int) -> Entrant:
    return entrant(of_models(models, count), INSTANCED, ("--merge", "none", "--threads", "2"))


def jobs() -> list[Job]:
    few, many = SERIES[:2], SERIES[2:]
    return [
        Job([canopy(count) for count in few], TURNS),
        Job(ranks(TWICE), TURNS),
        Job([instanced(MODELS, INSTANCES)], TURNS),
        *(Job([canopy(count)], ONCE) for count in many),
    ]


def quick_jobs() -> list[Job]:
    limits = Limits(rounds=1, seconds=1)
    return [
        Job([canopy(50), canopy(200)], limits),
        Job(ranks(200), limits),
        Job([instanced(3, 1_000)], limits),
    ]
