# SPDX-License-Identifier: Apache-2.0
"""The results as a page of Markdown. A section without rows is left out."""

from collections.abc import Iterable, Iterator

import contenders as who
import forests
import limit
import pictures
import plan
import slopes
import table2
from records import Results
from targets import Target, targets
from text import milliseconds, number, spread, table

NOT_RUN = "not run"
STAGES = "stages: "
SETUP = "setup: "
REFERENCE = who.OURS[0]


def section(
    title: str, note: str, header: Iterable[str], rows: Iterable[Iterable[str]]
) -> list[str]:
    lines = table(header, rows)
    return [title, "", *([note, ""] if note else []), *lines] if lines else []


def head(results: Results) -> Iterator[str]:
    about = results.about
    yield f"# Bench of {about['date']}, {about['machine']['CPU']}"
    yield ""
    yield (
        "Written by `./dev bench`; every run is in the file of this name that ends in `.csv`. "
        "Contenders run side by side (A B C A B C ...) after a warm-up run each; times are medians "
        "over the rounds, in brackets the least and the most. The slow ones run fewer rounds."
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


def targets_section(results: Results) -> list[str]:
    return section(
        "## Targets",
        "",
        ("what", "target", "measured", ""),
        map(target_row, targets(results)),
    )


def table2_section(results: Results) -> list[str]:
    note = (
        f"Seconds. `{table2.TREE}` has as many leaf vertices as the paper's tree; the published "
        "algorithm is the contender of that name, on this machine. The paper does not say with "
        "which radius it measured: r1.5 has R and T of its Figure 17 (c)."
    )
    header = (
        "method, style, voxels",
        "paper",
        "published",
        "leafhull",
        "paper over leafhull",
        "published over leafhull",
    )
    rows = [
        (f"{row.method}, {style}, {row.resolution}", *map(number, row.values))
        for style in plan.STYLES
        for row in table2.rows(results, style)
    ]
    return section("## Table 2 of the paper", note, header, rows)


def whole_cell(results: Results, case: str, contender: str) -> str:
    if not results.values(case, contender, "total"):
        absent = any(
            (entry["case"], entry["contender"]) == (case, contender)
            for entry in results.about["absent"]
        )
        return "failed" if absent else NOT_RUN
    ratio = results.ratio(case, contender, REFERENCE, "total")
    times = spread(results, case, contender, "total")
    return times if ratio is None else f"{times}, {number(ratio)}x"


def whole_section(results: Results) -> Iterator[str]:
    if not tree_styles(results):
        return
    yield "## Whole runs, by voxels along the longest side"
    yield ""
    yield "Milliseconds, and how many times leafhull's isotropic run that is."
    yield ""
    for tree, style in tree_styles(results):
        cases = [
            (resolution, case)
            for resolution in plan.RESOLUTIONS
            if (case := f"{tree}-{resolution}-{style}") in results.about["cases"]
        ]
        names = dict.fromkeys(
            name
            for _, case in cases
            for name in results.contenders(case)
            if name not in (*who.THREADS, who.COLD, *who.SURVEYS)
        )
        header = ("contender", *(str(resolution) for resolution, _ in cases))
        rows = [(name, *(whole_cell(results, case, name) for _, case in cases)) for name in names]
        yield from section(f"### {tree}, {style}", "", header, rows)


def tree_styles(results: Results) -> list[tuple[str, str]]:
    """Each tree and style that was run at resolutions, once."""
    endings = {
        name: f"-{page['resolution']}-{page['style']}"
        for name, page in results.about["cases"].items()
    }
    return list(
        dict.fromkeys(
            (name.removesuffix(ending), results.about["cases"][name]["style"])
            for name, ending in endings.items()
            if name.endswith(ending)
        )
    )


def parts_section(results: Results) -> Iterator[str]:
    if not tree_styles(results):
        return
    yield "## Field and mesh apart, 128 voxels"
    yield ""
    yield (
        "Milliseconds. leafhull's isotropic field is hash, bounds and field at a known T, as the "
        "peers' is; the controlled one is steps 1 to 6 of the paper. Who mixes the two, or makes "
        "no field, has the whole alone."
    )
    yield ""
    header = ("contender", "field", "mesh", "whole", "vertices", "rounds")
    for tree, style in tree_styles(results):
        case = f"{tree}-128-{style}"
        rows = [
            (
                name,
                *(spread(results, case, name, part) for part in ("field", "mesh", "total")),
                number(results.median(case, name, "vertices")),
                str(len(totals)),
            )
            for name in results.contenders(case)
            if name not in who.SURVEYS and (totals := results.values(case, name, "total"))
        ]
        if rows:
            count = results.about["cases"][case]["count"]
            yield from section(f"### {tree}, {style}: {count:,} leaf vertices", "", header, rows)


def stages_section(results: Results) -> list[str]:
    columns = [
        (f"{tree}-128-painterly", name)
        for tree, style in tree_styles(results)
        for name in who.OURS
        if style == "painterly" and results.values(f"{tree}-128-painterly", name, "total")
    ]
    if not columns:
        return []
    stages = dict.fromkeys(
        r.part
        for r in results.records
        if r.part.startswith(STAGES) and (r.case, r.contender) in columns
    )
    header = (
        "ms",
        *(
            f"{case.removesuffix('-128-painterly')} {name.removeprefix('leafhull ')}"
            for case, name in columns
        ),
    )
    rows = [
        (
            stage.removeprefix(STAGES),
            *(milliseconds(results.median(*key, stage)) for key in columns),
        )
        for stage in stages
    ]
    return section("## leafhull's stages, painterly, 128 voxels", "", header, rows)


def series_section(results: Results) -> list[str]:
    rows = []
    for count in plan.SERIES:
        case = plan.series_case(count).name
        for name in who.OURS:
            if whole := results.median(case, name, "total"):
                voxels = results.median(case, name, "evaluated_voxels")
                memory = slopes.beside_mesh(results, case, name)
                rows.append(
                    (
                        f"{count:,}, {name}",
                        spread(results, case, name, "total"),
                        number(1e9 * whole / count),
                        number(voxels),
                        number(memory / 2**20),
                    )
                )
    header = (
        "leaf vertices",
        "whole, ms",
        "ns per leaf vertex",
        "evaluated voxels",
        "peak memory beside the mesh, MiB",
    )
    note = "Synthetic crowns at one mean density, radius and voxel size."
    return section("## Time and memory against leaf vertices", note, header, rows)


def cold_section(results: Results) -> list[str]:
    case = "birch-128-painterly"
    rows = [
        (case, record.contender, record.part.removeprefix(SETUP), milliseconds(record.value))
        for record in results.records
        if record.part.startswith(SETUP)
        and record.contender in (who.COLD, *who.OURS)
        and record.case == case
    ]
    for case in dict.fromkeys(r.case for r in results.records if r.contender == plan.CACHED):
        cached, fresh = (results.median(case, n, "total") for n in (plan.CACHED, plan.FRESH))
        rows.append((case, "the command", plan.CACHED, spread(results, case, plan.CACHED, "total")))
        if fresh is not None:
            whole = spread(results, case, plan.FRESH, "total")
            rows.append((case, "the command", plan.FRESH, whole))
            rows.append((case, "the command", "the difference", milliseconds(fresh - cached)))
    header = ("case", "contender", "what", "ms")
    return section("## Cold", "What comes before a warm run, and whole processes.", header, rows)


def contender_section(results: Results) -> Iterator[str]:
    versions = dict.fromkeys((r.contender, r.version) for r in results.records)
    yield from section("## Contenders", "", ("contender", "version"), versions)
    absent: dict[tuple[str, str], list[str]] = {}
    for entry in results.about["absent"]:
        absent.setdefault((entry["contender"], entry["reason"]), []).append(entry["case"])
    rows = [(name, why, ", ".join(cases)) for (name, why), cases in absent.items()]
    yield from section("### Could not be run", "", ("contender", "why", "cases"), rows)


SECTIONS = (
    head,
    targets_section,
    table2_section,
    whole_section,
    parts_section,
    stages_section,
    limit.section,
    series_section,
    pictures.section,
    forests.section,
    cold_section,
    contender_section,
)


def page(results: Results) -> str:
    return "\n".join(line for part in SECTIONS for line in part(results))
