# SPDX-License-Identifier: Apache-2.0
"""The results as a picture: whole runs beside the peers, by resolution, by leaf vertices."""

from pathlib import Path

import contenders as who
import plan
import slopes
from matplotlib import pyplot, ticker
from records import Results

# Apart for colour-blind readers (Okabe and Ito), by lightness and by marker in grey.
INKS = ("#000000", "#0072B2", "#D55E00", "#56B4E9", "#E69F00")
MARKERS = ("o", "s", "^", "D", "v")
DASHES = ("-", "-", "--", "-.", ":")

STYLE = {
    "font.size": 8,
    "axes.titlesize": 9,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "svg.hashsalt": "leafhull",
}


def beside_peers(axes, results: Results) -> None:
    """One row per contender, one mark per tree, a line from the least to the most."""
    cases = [f"{tree}-128-painterly" for tree in plan.TREES]
    names = [
        name
        for name in (*who.OURS, who.SPHERES, *who.PEERS, *who.PUBLISHED)
        if any(results.values(case, name, "total") for case in cases)
    ]
    for tree, case, ink, marker in zip(plan.TREES, cases, INKS, MARKERS, strict=False):
        for row, name in enumerate(names):
            if values := results.values(case, name, "total"):
                label = tree if row == 0 else None
                median = results.median(case, name, "total")
                axes.plot((min(values), max(values)), (row, row), color=ink, linewidth=1.5)
                axes.plot(median, row, marker, color=ink, markersize=5, label=label)
    axes.set_yticks(range(len(names)), names)
    axes.invert_yaxis()
    axes.set_xscale("log")
    logarithmic(axes.xaxis)
    axes.set_xlabel("whole run, s")
    axes.set_title("128 voxels, painterly")
    legend(axes, loc="lower right")


def logarithmic(axis) -> None:
    """1, 2, 5, 10 as they are written."""
    axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(ticker.NullFormatter())


def mark(axis, values: tuple[int, ...]) -> None:
    """Those values alone: 128, 50 k, 1 M."""
    axis.set_major_locator(ticker.FixedLocator(values))
    axis.set_major_formatter(ticker.EngFormatter())
    axis.set_minor_locator(ticker.NullLocator())


def legend(axes, **place) -> None:
    if axes.get_legend_handles_labels()[1]:
        axes.legend(**place)


def lines(axes, curves: dict[str, dict[int, float]]) -> None:
    for (name, points), ink, marker, dash in zip(
        curves.items(), INKS, MARKERS, DASHES, strict=False
    ):
        if points:
            axes.plot(
                points.keys(),
                points.values(),
                dash,
                color=ink,
                marker=marker,
                markersize=4,
                linewidth=1.2,
                label=name,
            )
    axes.set_xscale("log")
    axes.set_yscale("log")
    logarithmic(axes.yaxis)
    axes.set_ylabel("whole run, s")


def by_resolution(axes, results: Results) -> None:
    tree = next((t for t in ("birch", "ash") if results.contenders(f"{t}-128-painterly")), "ash")
    curves = {
        name: {
            resolution: median
            for resolution in plan.RESOLUTIONS
            if (median := results.median(f"{tree}-{resolution}-painterly", name, "total"))
        }
        for name in (*who.OURS, who.SPHERES, "Blender", who.PUBLISHED[1])
    }
    lines(axes, curves)
    mark(axes.xaxis, plan.RESOLUTIONS)
    legend(axes, loc="upper left", bbox_to_anchor=(1, 1))
    axes.set_xlabel("voxels along the longest side")
    axes.set_title(f"{tree}, painterly")


def by_leaf_vertices(axes, results: Results) -> None:
    lines(axes, {name: slopes.series_times(results, name) for name in who.OURS})
    mark(axes.xaxis, plan.SERIES)
    legend(axes, loc="upper left")
    axes.set_xlabel("leaf vertices")
    axes.set_title("Synthetic crowns at one mean density")


def write(results: Results, path: Path) -> None:
    machine = results.about["machine"]
    with pyplot.rc_context(STYLE):
        figure = pyplot.figure(figsize=(10, 6), layout="constrained")
        rows = figure.add_gridspec(2, 2, height_ratios=(1.1, 1))
        beside_peers(figure.add_subplot(rows[0, :]), results)
        by_resolution(figure.add_subplot(rows[1, 0]), results)
        by_leaf_vertices(figure.add_subplot(rows[1, 1]), results)
        figure.suptitle(
            f"leafhull and its peers, {machine['CPU']}, {machine['cores']} cores, "
            f"{results.about['date']}: medians, lines from the least to the most",
            x=0.01,
            ha="left",
            fontsize=9,
        )
        figure.savefig(path, metadata={"Date": None})
        pyplot.close(figure)
