# SPDX-License-Identifier: Apache-2.0
"""Pictures: rays through the density beside those that meet its mesh, and the watercolour."""

from collections.abc import Iterator
from itertools import pairwise

import contenders as who
import plan
from records import Results
from text import milliseconds, number, spread, table

DIRECT, MESH = (who.picture(surface, "phong") for surface in ("direct", "mesh"))
PAINT = "stages: paint"
DRAWING = ("stages: scene", "stages: rays", PAINT)  # after all that is known of the surface
PEAK = "peak_memory_bytes"
Values = dict[str, float | None]


def trees(results: Results) -> dict[str, str]:
    """The case of each tree that was drawn."""
    cases = dict.fromkeys(r.case for r in results.records if r.case.startswith(plan.PICTURES))
    return {case.removeprefix(plan.PICTURES): case for case in cases}


def direct_over_mesh(results: Results) -> Values:
    return {
        tree: results.ratio(case, DIRECT, MESH, "total") for tree, case in trees(results).items()
    }


def watercolour_passes(results: Results) -> Values:
    """Milliseconds of a picture whose paper is not there yet, and of the next."""
    contender = who.picture("direct", "watercolour")
    parts = {"first": PAINT, "next": "repaint_seconds"}
    medians = {
        f"{tree}, {name} picture": results.median(case, contender, part)
        for tree, case in trees(results).items()
        for name, part in parts.items()
    }
    return {name: None if s is None else 1000 * s for name, s in medians.items()}


def frames_on_gpu(results: Results) -> Values:
    return {
        tree: 1 / results.median(case, DIRECT, "redraw_seconds")
        for tree, case in trees(results).items()
        if results.median(case, DIRECT, "on_gpu")
    }


def bytes_per_pixel(results: Results) -> Values:
    """What each further pixel takes, from one size to the next."""
    values: Values = {}
    for tree, case in trees(results).items():
        for small, large in pairwise(who.PICTURE_SIZES):
            names = [who.picture("direct", "phong", size) for size in (small, large)]
            peaks = [results.median(case, name, PEAK) for name in names]
            if None not in peaks:
                further = (peaks[1] - peaks[0]) / (large**2 - small**2)
                values[f"{tree}, {small} to {large}"] = further
    return values


def row(results: Results, case: str, name: str) -> tuple[str, ...]:
    stages = [
        r.part
        for r in results.records
        if (r.case, r.contender) == (case, name) and r.part.startswith("stages: ")
    ]
    surface = sum(
        results.median(case, name, stage) for stage in dict.fromkeys(stages) if stage not in DRAWING
    )
    return (
        name,
        spread(results, case, name, "total"),
        milliseconds(surface),
        *(milliseconds(results.median(case, name, stage)) for stage in DRAWING),
        spread(results, case, name, "redraw_seconds"),
        number(results.median(case, name, PEAK) / 2**20),
    )


def section(results: Results) -> Iterator[str]:
    if not trees(results):
        return
    yield "## Pictures"
    yield ""
    yield (
        "Milliseconds from the leaves in memory to a picture in memory, of the style painterly at "
        f"`standard` ({plan.STANDARD} voxels), each in a process of its own. Surface: all stages "
        "of the extraction, up to bricks for rays or to a mesh. Scene: wood and its hierarchy of "
        "boxes, and the mesh's. Rays: what each pixel sees and its light. Paint: shading, or the "
        "passes of a watercolour and its paper. Again: rays and paint of what is ready, as the "
        "next frame of a film."
    )
    yield ""
    header = ("picture", "whole", "surface", "scene", "rays", "paint", "again", "peak memory, MiB")
    for tree, case in trees(results).items():
        names = [name for name in who.PICTURES if results.values(case, name, "total")]
        if not names:
            continue
        yield f"### {tree}"
        yield ""
        yield from table(header, (row(results, case, name) for name in names))
