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


def asked(results: Results) -> bool:
    """Whether it is a bench of forests."""
    return results.about.get("forests", False)


def series(results: Results, part: str) -> dict[int, float]:
    """A median of the canopies, by trees."""
    medians = {
        count: results.median(case, plan.CANOPY, part)
        for count in plan.SERIES
        for case in cases(results)
        if re.fullmatch(rf"{plan.CASE}-[a-z]+-{count}", case)
    }
    return {count: median for count, median in medians.items() if median is not None}


def whole_series(results: Results, part: str) -> dict[int, float]:
    """Nothing where a member is missing: no target is met by fewer."""
    medians = series(results, part)
    return medians if set(medians) == set(plan.SERIES) else {}


def label(count: int) -> str:
    return f"{count:,} trees"


def rate(results: Results) -> Values:
    """Millions of leaf vertices a second, of the largest canopy."""
    count = plan.SERIES[-1]
    seconds = series(results, "total").get(count)
    vertices = series(results, "leaf_vertices").get(count)
    return {label(count): 1e-6 * vertices / seconds if seconds and vertices else None}


def resident(results: Results) -> Values:
    """GiB, of the largest canopy."""
    count = plan.SERIES[-1]
    peak = series(results, PEAK).get(count)
    return {label(count): peak and peak / 2**30}


def departure(results: Results) -> Values:
    part = slopes.departure_from_line(whole_series(results, "total"))
    return {"time": None if part is None else 100 * part}


def growth(results: Results) -> Values:
    """Percent by which memory has grown since the fewest trees, beside what each may take."""
    peaks = whole_series(results, PEAK)
    few = plan.SERIES[0]
    return {
        label(count): 100 * ((peak - PER_INSTANCE * (count - few)) / peaks[few] - 1)
        for count, peak in peaks.items()
        if count != few
    }


def ranks(results: Results) -> Values:
    return {
        case: results.ratio(case, plan.TWO_RANKS, plan.ONE_RANK, "total")
        for case in cases(results)
        if case.endswith(f"-{plan.TWICE}")
    }


def instances(results: Results) -> Values:
    case = plan.of_models(plan.MODELS, plan.INSTANCES).name
    return {case: results.median(case, plan.INSTANCED, "total")}


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
