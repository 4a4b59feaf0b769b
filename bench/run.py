#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the bench and writes its results: every run, tables and plots."""

import argparse
import datetime
import math
import re
import sys
import time
from pathlib import Path

import contenders as who
import forest_plan
import machine
import plan
import render
from heat import Heat, Job, Limits
from records import Results

FULL = Limits(rounds=5, seconds=12)
QUICK = Limits(rounds=2, seconds=4)
ONCE = Limits(rounds=1, seconds=math.inf, warm_up=False)


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="./dev bench", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="a small tree, 2 rounds")
    parser.add_argument("--forest", action="store_true", help="forests, and nothing else: an hour")
    parser.add_argument(
        "--case", metavar="REGEX", default="", help="only the cases whose name it finds"
    )
    return parser.parse_args()


def stem(asked: argparse.Namespace, day: str) -> Path:
    """Only whole results go where they are kept."""
    cpu = re.sub(r"[^a-z0-9]+", "-", machine.cpu().lower()).strip("-")
    whole = not asked.quick and not asked.case
    folder = who.ROOT / ("bench/results" if whole else "build/bench/results")
    folder.mkdir(parents=True, exist_ok=True)
    kind = f"{'-forest' if asked.forest else ''}{'-quick' if asked.quick else ''}"
    return folder / f"{day}-{cpu}{kind}"


def every_job(quick: bool, forest: bool) -> list[Job]:
    if forest:
        return forest_plan.quick_jobs() if quick else forest_plan.jobs()
    heats, surveys, limits = (
        (plan.quick_heats(), plan.quick_surveys(), QUICK)
        if quick
        else (plan.heats(), plan.surveys(), FULL)
    )
    return [Job(heat, limits) for heat in heats] + [Job(survey, ONCE) for survey in surveys]


def jobs(asked: argparse.Namespace) -> list[Job]:
    """Those whose cases were chosen."""
    kept = [
        Job([e for e in job.entrants if re.search(asked.case, e.case)], job.limits)
        for job in every_job(asked.quick, asked.forest)
    ]
    return [job for job in kept if job.entrants]


def run(todo: list[Job], results: Results) -> None:
    began = time.monotonic()
    for number, job in enumerate(todo, 1):
        minutes = (time.monotonic() - began) / 60
        cases = ", ".join(dict.fromkeys(entrant.case for entrant in job.entrants))
        print(f"[{minutes:4.1f} min] {number}/{len(todo)} {cases}", file=sys.stderr)
        Heat(job.limits, results).run(job.entrants)
    results.about["minutes"] = round((time.monotonic() - began) / 60, 1)


def main() -> None:
    asked = arguments()
    todo = jobs(asked)
    if not todo:
        sys.exit(f"bench: no case's name matches {asked.case}")
    day = datetime.date.today().isoformat()
    stand_ins = (forest_plan if asked.forest else plan).stand_ins()
    results = Results(
        about={
            "date": day,
            "forests": asked.forest,
            "machine": machine.describe(who.ROOT, who.LEAFHULL),
            "stand_ins": stand_ins,
            "absent": [],
        }
    )
    for tree, other in stand_ins.items():
        print(f"bench: THERE IS NO {tree} HERE; {other} RUNS IN ITS PLACE", file=sys.stderr)
    run(todo, results)
    names = dict.fromkeys(record.case for record in results.records)
    results.about["cases"] = {name: about for name in names if (about := plan.about(name))}
    path = stem(asked, day)
    results.save(path)
    for file in render.render(path):
        print(file)


if __name__ == "__main__":
    main()
