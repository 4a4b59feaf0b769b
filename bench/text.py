# SPDX-License-Identifier: Apache-2.0
"""Numbers and tables in Markdown."""

from collections.abc import Iterable

from records import Results


def number(value: float | None) -> str:
    """Three significant digits, more before the point; empty where there is none."""
    if value is None:
        return ""
    if abs(value) >= 100:
        return f"{value:,.0f}"
    return f"{value:#.3g}".rstrip(".")


def milliseconds(seconds: float | None) -> str:
    return "" if seconds is None else number(1000 * seconds)


def spread(results: Results, case: str, contender: str, part: str) -> str:
    """Median (least to most) in milliseconds."""
    values = results.values(case, contender, part)
    if not values:
        return ""
    median = milliseconds(results.median(case, contender, part))
    if len(values) == 1:
        return f"{median} (one run)"
    return f"{median} ({milliseconds(min(values))} to {milliseconds(max(values))})"


def table(header: Iterable[str], rows: Iterable[Iterable[str]]) -> list[str]:
    """Its lines and an empty one; none without rows."""
    cells = [tuple(row) for row in rows]
    if not cells:
        return []
    names = tuple(header)
    rule = "|" + "---|" * len(names)
    return [line(names), rule, *map(line, cells), ""]


def line(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cells) + " |"
