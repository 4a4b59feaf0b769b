# SPDX-License-Identifier: Apache-2.0
"""The results as a page of Markdown."""

from collections.abc import Iterable, Iterator

import contenders as who
import limit
import plan
import slopes
import table2
from records import Results
from targets import Target, targets

NOT_RUN = "not run"
STAGES = "stages: "


def number(value: float | None) -> str:
    """Three significant digits."""
    if value is None:
        return ""
    if abs(value) >= 100:
        return f"{value:,.0f}"
    return f"{value:#.3g}".rstrip(".")


def milliseconds(seconds: float | None) -> str:
    return "" if seconds is None else number(1000 * seconds)


def table(header: Iterable[str], rows: Iterable[Iterable[str]]) -> Iterator[str]:
    cells = list(header)
    yield "| " + " | ".join(cells) + " |"
    yield "|---" + "|--:" * (len(cells) - 1) + "|"
    for row in rows:
        yield "| " + " | ".join(row) + " |"
    yield ""


def spread(results: Results, case: str, contender: str, part: str) -> str:
    """Median (least to most) in milliseconds."""
    values = results.values(case, contender, part)
    if not values:
        return ""
    median = milliseconds(results.median(case, contender, part))
    if len(values) == 1:
        return f"{median} (one run)"
    return f"{median} ({milliseconds(min(values))} to {milliseconds(max(values))})"


def head(results: Results) -> Iterator[str]:
    about = results.about
    yield f"# Bench of {about['date']}, {about['machine']['CPU']}"
    yield ""
    yield (
        "Written by `./dev bench`; every run is in the file of the same name ending in `.csv`. "
        "Contenders run side by side (A B C A B C ...) after a warm-up run each; times are medians "
        "over the rounds, in brackets the least and the most. Slow ones run fewer rounds."
    )
    yield ""
    for tree, other in about["stand_ins"].items():
        yield f"**There was no {tree} here: {other} ran in its place.**"
        yield ""
    yield from table(("machine", ""), about["machine"].items())


def target_row(target: Target) -> tuple[str, ...]:
    values = ", ".join(f"{number(v)} ({name})" for name, v in target.measured.items())
    bound = f"at {'least' if target.at_least else 'most'} {target.bound:g} {target.unit}"
    met = {True: "met", False: "**not met**", None: "not measured"}[target.met]
    return (target.what, bound, values, met)


def targets_section(results: Results) -> Iterator[str]:
    yield "## Targets"
    yield ""
    yield from table(("what", "target", "measured", ""), map(target_row, targets(results)))


def table2_section(results: Results) -> Iterator[str]:
    yield "## Table 2 of the paper"
    yield ""
    yield (
        f"Seconds; `{table2.TREE}` has as many leaf vertices as the paper's tree. The published "
        "algorithm is the contender of that name on this machine; r1.5 has R and T of the paper's "
        "Figure 17 (c)."
    )
    yield ""
    header = ("method, style, voxels", "paper", "published, here", "leafhull", "paper / leafhull",
              "published / leafhull")  # fmt: skip
    yield from table(
        header,
        (
            (f"{row.method}, {style}, {row.resolution}",
             *map(number, (row.paper, row.published, row.ours, row.over_paper,
                           row.over_published)))
            for style in plan.STYLES
            for row in table2.rows(results, style)
        ),
    )  # fmt: skip


def whole_cell(results: Results, case: str, contender: str) -> str:
    if not results.values(case, contender, "total"):
        reasons = {(a["case"], a["contender"]): a["reason"] for a in results.about["absent"]}
        return "failed" if (case, contender) in reasons else NOT_RUN
    ratio = results.ratio(case, contender, "leafhull isotropic", "total")
    times = spread(results, case, contender, "total")
    return times if ratio is None else f"{times}, {number(ratio)}x"


def whole_section(results: Results) -> Iterator[str]:
    yield "## Whole runs, by voxels along the longest side"
    yield ""
    yield "Milliseconds, and how many times leafhull's isotropic run."
    yield ""
    for tree, style in tree_styles(results):
        cases = {n: f"{tree}-{n}-{style}" for n in plan.RESOLUTIONS}
        cases = {n: case for n, case in cases.items() if case in results.about["cases"]}
        names = dict.fromkeys(
            name
            for case in cases.values()
            for name in results.contenders(case)
            if name not in who.THREADS and name != who.COLD
        )
        rows = [(name, *(whole_cell(results, c, name) for c in cases.values())) for name in names]
        yield f"### {tree}, {style}"
        yield ""
        yield from table(("contender", *(f"{n}" for n in cases)), rows)


def tree_styles(results: Results) -> list[tuple[str, str]]:
    """Of the cases by resolution, each tree and style once."""
    pages = results.about["cases"].items()
    return list(
        dict.fromkeys(
            (name.removesuffix(f"-{page['resolution']}-{page['style']}"), page["style"])
            for name, page in pages
            if name.endswith(f"-{page['resolution']}-{page['style']}")
        )
    )


def parts_section(results: Results) -> Iterator[str]:
    yield "## Field and mesh apart, 128 voxels"
    yield ""
    yield "Milliseconds. What makes no field, or mixes the two, has the whole alone."
    yield ""
    for tree, style in tree_styles(results):
        case = f"{tree}-128-{style}"
        names = [name for name in results.contenders(case) if results.values(case, name, "total")]
        rows = [
            (name,
             *(spread(results, case, name, part) for part in ("field", "mesh", "total")),
             number(results.median(case, name, "vertices")),
             str(len(results.values(case, name, "total"))))
            for name in names
        ]  # fmt: skip
        if rows:
            page = results.about["cases"][case]
            yield f"### {case}: {page['count']:,} leaf vertices"
            yield ""
            header = ("contender", "field", "mesh", "whole", "vertices", "rounds")
            yield from table(header, rows)


def stages_section(results: Results) -> Iterator[str]:
    yield "## leafhull's stages, painterly, 128 voxels"
    yield ""
    columns = [
        (f"{tree}-128-painterly", name)
        for tree, style in tree_styles(results)
        if style == "painterly"
        for name in who.OURS
    ]
    columns = [key for key in columns if results.values(*key, "total")]
    stages = dict.fromkeys(r.part for r in results.records if r.part.startswith(STAGES))
    header = ("ms", *(f"{case}, {name.removeprefix('leafhull ')}" for case, name in columns))
    rows = (
        (stage.removeprefix(STAGES), *(milliseconds(results.median(*key, stage)) for key in columns))
        for stage in stages
    )
    yield from table(header, rows)


def series_section(results: Results) -> Iterator[str]:
    yield "## Time and memory against leaf vertices"
    yield ""
    yield "Synthetic crowns at one mean density, radius and voxel size."
    yield ""
    rows = []
    for count in plan.SERIES:
        case = plan.series_case(count).name
        for name in who.OURS:
            if results.values(case, name, "total"):
                memory = slopes.beside_mesh(results, case, name)
                whole = results.median(case, name, "total")
                voxels = results.median(case, name, "evaluated_voxels")
                rows.append((f"{count:,}, {name}", spread(results, case, name, "total"),
                             number(1e9 * whole / count), number(voxels),
                             number(memory / 2**20)))  # fmt: skip
    header = ("leaf vertices", "whole, ms", "ns per leaf vertex", "evaluated voxels",
              "peak memory beside the mesh, MiB")  # fmt: skip
    yield from table(header, rows)


def contender_section(results: Results) -> Iterator[str]:
    yield "## Contenders"
    yield ""
    versions = dict.fromkeys((r.contender, r.version) for r in results.records)
    yield from table(("contender", "version"), versions)
    absent: dict[tuple[str, str], list[str]] = {}
    for entry in results.about["absent"]:
        absent.setdefault((entry["contender"], entry["reason"]), []).append(entry["case"])
    if absent:
        yield "Could not be run:"
        yield ""
        rows = ((name, why, ", ".join(cases)) for (name, why), cases in absent.items())
        yield from table(("contender", "why", "cases"), rows)


def setup_section(results: Results) -> Iterator[str]:
    yield "## Cold"
    yield ""
    rows = [
        (record.case, record.contender, record.part.removeprefix("setup: "),
         milliseconds(record.value))
        for record in results.records
        if record.part.startswith("setup: ") and record.contender in (who.COLD, *who.OURS)
        and record.case == "birch-128-painterly"
    ]  # fmt: skip
    yield from table(("case", "contender", "what", "ms"), rows)


SECTIONS = (head, targets_section, table2_section, whole_section, parts_section, stages_section,
            limit.section, series_section, setup_section, contender_section)  # fmt: skip


def page(results: Results) -> str:
    return "\n".join(line for section in SECTIONS for line in section(results))
