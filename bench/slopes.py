# SPDX-License-Identifier: Apache-2.0
"""How time and memory grow with the leaf vertices and with the evaluated voxels."""

from statistics import linear_regression

import plan
from records import Results

# A vertex of the mesh is a position and a normal of floats, a triangle three 32-bit indices.
VERTEX_BYTES, TRIANGLE_BYTES = 24, 12


def series_times(results: Results, contender: str) -> dict[int, float]:
    """Seconds of whole runs over the scaling series, by leaf vertices."""
    medians = {
        count: results.median(plan.series_case(count).name, contender, "total")
        for count in plan.SERIES
    }
    return {count: median for count, median in medians.items() if median is not None}


def departure_from_line(points: dict[int, float]) -> float | None:
    """The largest relative distance of a point from the line that is relatively closest to all; a
    line that starts below zero at none is no answer, for no run has less than no fixed cost."""
    if len(points) < 3:
        return None
    # value = fixed + slope * count, divided by value: the residuals are relative.
    ones = [1 / value for value in points.values()]
    counts = [count / value for count, value in points.items()]
    aa, ab, bb = dot(ones, ones), dot(ones, counts), dot(counts, counts)
    fixed = (bb * sum(ones) - ab * sum(counts)) / (aa * bb - ab * ab)
    fixed = max(fixed, 0.0)
    slope = (sum(counts) - ab * fixed) / bb
    return max(abs(fixed + slope * count - value) / value for count, value in points.items())


def dot(a: list[float], b: list[float]) -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))


def beside_mesh(results: Results, case: str, contender: str) -> float | None:
    """Bytes held at most, less those of the mesh."""
    parts = ("peak_memory_bytes", "vertices", "faces")
    values = [results.median(case, contender, part) for part in parts]
    if None in values:
        return None
    peak, vertices, faces = values
    return peak - VERTEX_BYTES * vertices - TRIANGLE_BYTES * faces


def slope(points: list[tuple[float | None, float | None]]) -> float | None:
    """That of the line through all points; none where a value is missing."""
    if any(None in point for point in points):
        return None
    x, y = zip(*points, strict=True)
    return linear_regression(x, y).slope


def bytes_per_voxel(results: Results, tree: str, contender: str) -> float | None:
    """Over a tree's resolutions."""
    cases = [f"{tree}-{resolution}-painterly" for resolution in plan.RESOLUTIONS]
    return slope(
        [
            (
                results.median(case, contender, "evaluated_voxels"),
                beside_mesh(results, case, contender),
            )
            for case in cases
        ]
    )


def bytes_per_leaf_vertex(results: Results, contender: str, per_voxel: float) -> float | None:
    """Over the scaling series, less what its voxels take."""

    def beside_voxels(case: str) -> float | None:
        memory = beside_mesh(results, case, contender)
        voxels = results.median(case, contender, "evaluated_voxels")
        return None if memory is None or voxels is None else memory - per_voxel * voxels

    return slope([(count, beside_voxels(plan.series_case(count).name)) for count in plan.SERIES])
