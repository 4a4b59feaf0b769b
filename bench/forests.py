# SPDX-License-Identifier: Apache-2.0
"""Forests: what leafhull set itself for them, and how time and memory grow with the trees."""

import re
from collections.abc import Iterator

import forest_plan as plan
import slopes
from records import Results
from text import number, spread, table

PEAK = "peak_memory_bytes"
PER_INSTANCE = 100  # bytes that a tree may take
Values = dict[str, float | None]


def cases(results: Results) -> list[str]:
    names = dict.fromkeys(record.case for record in results.records)
    return [name for name in names if name.startswith(plan.CASE)]


def series(results: Results, part: str) -> dict[int, float]:
    """A median of the canopies, by trees."""
    counts = {
        int(found[1]): case
        for case in cases(results)
        if (found := re.fullmatch(rf"{plan.CASE}-[a-z]+-(\d+)", case))
    }
    medians = {
        count: results.median(case, plan.CANOPY, part) for count, case in sorted(counts.items())
    }
    return {count: median for count, median in medians.items() if median is not None}


def label(count: int) -> str:
    return f"{count:,} trees"


def rate(results: Results, count: int = plan.SERIES[-1]) -> Values:
    """Millions of leaf vertices a second."""
    seconds = series(results, "total").get(count)
    vertices = series(results, "leaf_vertices").get(count)
    return {label(count): 1e-6 * vertices / seconds if seconds and vertices else None}


def resident(results: Results, count: int = plan.SERIES[-1]) -> Values:
    """GiB."""
    peak = series(results, PEAK).get(count)
    return {label(count): peak and peak / 2**30}


def departure(results: Results) -> Values:
    part = slopes.departure_from_line(series(results, "total"))
    return {"time": None if part is None else 100 * part}


def growth(results: Results) -> Values:
    """Percent by which memory has grown since the fewest trees, beside what each may take."""
    peaks = series(results, PEAK)
    if not peaks:
        return {}
    few, *more = peaks
    return {
        label(count): 100 * ((peaks[count] - PER_INSTANCE * (count - few)) / peaks[few] - 1)
        for count in more
    }


def ranks(results: Results) -> Values:
    return {
        case: results.ratio(case, plan.TWO_RANKS, plan.ONE_RANK, "total")
        for case in cases(results)
    }


def instances(results: Results) -> Values:
    return {case: results.median(case, plan.INSTANCED, "total") for case in cases(results)}


def row(results: Results, case: str, name: str) -> tuple[str, ...]:
    seconds, vertices, peak, written = (
        results.median(case, name, part)
        for part in ("total", "leaf_vertices", PEAK, "written_bytes")
    )
    return (
        f"{case}, {name}",
        number(vertices and 1e-6 * vertices),
        spread(results, case, name, "total"),
        number(1e-6 * vertices / seconds),
        number(peak / 2**20),
        number(written / 2**20),
    )


def section(results: Results) -> Iterator[str]:
    rows = [
        row(results, case, name)
        for case in cases(results)
        for name in results.contenders(case)
        if results.values(case, name, "total")
    ]
    if not rows:
        return
    yield "## Forests"
    yield ""
    yield (
        "`leafhull forest` from the start of its process to the finished folder; trees are "
        f"{plan.SPACING} crown widths apart. Memory is the most that one process held resident, "
        "as the kernel counts it."
    )
    yield ""
    header = (
        "scene, how",
        "leaf vertices, M",
        "whole, ms",
        "M leaf vertices/s",
        "peak memory, MiB",
        "written, MiB",
    )
    yield from table(header, rows)
