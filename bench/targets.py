# SPDX-License-Identifier: Apache-2.0
"""What leafhull set itself, beside what was measured. A target is met where every value is."""

from typing import NamedTuple

import contenders as who
import forests
import limit
import pictures
import plan
import slopes
from records import Results

LARGE = "synthetic-400000"
Values = dict[str, float | None]


class Target(NamedTuple):
    what: str
    bound: float
    at_least: bool  # else at most
    unit: str
    measured: dict[str, float]  # by case or method

    @property
    def met(self) -> bool | None:
        """None where nothing was measured."""
        values = self.measured.values()
        if not values:
            return None
        return min(values) >= self.bound if self.at_least else max(values) <= self.bound


def at_least(what: str, bound: float, unit: str, values: Values) -> Target:
    return Target(what, bound, True, unit, measured(values))


def at_most(what: str, bound: float, unit: str, values: Values) -> Target:
    return Target(what, bound, False, unit, measured(values))


def measured(values: Values) -> dict[str, float]:
    return {name: value for name, value in values.items() if value is not None}


def painterly(tree: str) -> str:
    return f"{tree}-128-painterly"


def over(results: Results, peer: str, part: str, trees: tuple[str, ...]) -> Values:
    return {
        tree: results.ratio(painterly(tree), peer, "leafhull isotropic", part) for tree in trees
    }


def whole_over(results: Results, peer: str, trees: tuple[str, ...]) -> Values:
    """With our mesher and with OpenVDB's."""
    by_vdb = {
        f"{tree}, `--mesher vdb`": results.ratio(painterly(tree), peer, who.BY_VDB, "total")
        for tree in trees
    }
    return {**over(results, peer, "total", trees), **by_vdb}


def over_published(results: Results) -> Values:
    return {
        f"{method}, {style}": results.ratio(
            f"aspen-52648-128-{style}", f"published {method}", f"leafhull {method}", "total"
        )
        for method in who.METHODS
        for style in plan.STYLES
    }


def controlled_over_isotropic(results: Results) -> Values:
    return {
        tree: results.ratio(painterly(tree), "leafhull controlled", "leafhull isotropic", "total")
        for tree in (*plan.TREES, LARGE)
    }


def threads(results: Results, part: str) -> Values:
    return {
        f"{tree} {method}": results.ratio(
            painterly(tree), who.threaded(method, 1), who.threaded(method, 2), part
        )
        for tree in plan.TREES
        for method in who.METHODS
    }


def linearity(results: Results) -> Values:
    departures = {
        method: slopes.departure_from_line(slopes.series_times(results, f"leafhull {method}"))
        for method in who.METHODS
    }
    return {name: None if value is None else 100 * value for name, value in departures.items()}


def memory_per_voxel(results: Results) -> Values:
    return {
        f"{tree} {method}": slopes.bytes_per_voxel(results, tree, f"leafhull {method}")
        for tree in plan.TREES
        for method in who.METHODS
    }


def memory_per_leaf_vertex(results: Results) -> Values:
    """What a voxel takes is the birch's."""
    values: Values = {}
    for method in who.METHODS:
        contender = f"leafhull {method}"
        per_voxel = slopes.bytes_per_voxel(results, "birch", contender)
        if per_voxel is not None:
            values[method] = slopes.bytes_per_leaf_vertex(results, contender, per_voxel)
    return values


def startup(results: Results, contender: str) -> Values:
    cases = {record.case for record in results.records if record.contender == contender}
    return {case: results.median(case, contender, "total") for case in sorted(cases)}


def targets(results: Results) -> list[Target]:
    """Of what was run: forests, or trees one by one."""
    return of_forests(results) if forests.asked(results) else of_trees(results)


def of_forests(results: Results) -> list[Target]:
    return [
        at_least("a canopy of 20,000 trees, 0.25 m voxels, 2 cores", 3, "M leaf vertices/s",
                 forests.rate(results)),
        at_most("memory of that canopy", 4, "GiB", forests.resident(results)),
        at_most("time against trees, 1,000 to 20,000: departure from a line", 10, "%",
                forests.departure(results)),
        at_most("memory against trees: growth since 1,000, beside 100 bytes per instance", 5, "%",
                forests.growth(results)),
        at_most("2 ranks over 1 rank with 2 threads, 2 cores", 1.1, "x", forests.ranks(results)),
        at_most("`--merge none`, 1 M instances of 30 models", 60, "s", forests.instances(results)),
    ]  # fmt: skip


def of_trees(results: Results) -> list[Target]:
    return [
        at_least("hash, bounds and field, isotropic, painterly, 128 voxels, over "
                 "`rasterizeSmoothSpheres` and its point grid", 25, "x",
                 over(results, who.SPHERES, "field", ("birch", LARGE))),
        at_least("whole run over OpenVDB's chain", 7, "x",
                 whole_over(results, who.SPHERES, (*plan.TREES, LARGE))),
        at_least("whole run over Blender's", 5, "x",
                 whole_over(results, "Blender", plan.TREES)),
        at_least("whole run over the published algorithm, 128 voxels, aspen-52648", 200, "x",
                 over_published(results)),
        at_most("`controlled` over `isotropic`, whole run", 1.8, "x",
                controlled_over_isotropic(results)),
        at_least("field kernel, share of the measured FMA peak", 40, "%",
                 limit.percent_of_peak(results)),
        at_most("pairs evaluated per pair inside a support", 3, "x",
                limit.pairs_per_inside(results)),
        at_least("2 threads over 1, field", 1.85, "x", threads(results, "stages: field")),
        at_least("2 threads over 1, whole run", 1.6, "x", threads(results, "total")),
        at_most("time against leaf vertices, 50 k to 1 M at one mean density: departure from a "
                "line", 15, "%", linearity(results)),
        at_most("peak memory beside the mesh, per leaf vertex", 160, "bytes",
                memory_per_leaf_vertex(results)),
        at_most("peak memory beside the mesh, per evaluated voxel", 12, "bytes",
                memory_per_voxel(results)),
        at_most("process start to file at `draft`, kernels cached", 0.15, "s",
                startup(results, plan.CACHED)),
        at_most("process start to file at `draft`, kernels to compile", 0.9, "s",
                startup(results, plan.FRESH)),
        at_most("a direct picture of 1024x1024 in Phong shading over extracting and drawing the "
                "mesh, `standard`", 3, "x", pictures.direct_over_mesh(results)),
        at_most("the watercolour passes of 1024x1024", 250, "ms",
                pictures.watercolour_passes(results)),
        at_most("memory that a direct picture takes for each of its pixels", 160, "bytes",
                pictures.bytes_per_pixel(results)),
        at_least("direct redraws of 1024x1024 on a GPU", 30, "frames/s",
                 pictures.frames_on_gpu(results)),
    ]  # fmt: skip
