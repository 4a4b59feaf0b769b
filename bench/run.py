#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the bench and writes its results: every run, tables and plots."""

import argparse
import datetime
import re
import sys
import time
from collections.abc import Iterable
from pathlib import Path

import contenders as who
import machine
import plan
import render
from heat import Entrant, Heat, Limits
from records import Results

FULL = Limits(rounds=5, seconds=12)
QUICK = Limits(rounds=2, seconds=4)


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="./dev bench", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="a small tree, 2 rounds")
    parser.add_argument("--case", metavar="REGEX", help="only the cases whose name it finds")
    return parser.parse_args()


def stem(asked: argparse.Namespace, day: str) -> Path:
    """Only whole results go where they are kept."""
    cpu = re.sub(r"[^a-z0-9]+", "-", machine.cpu().lower()).strip("-")
    whole = not asked.quick and not asked.case
    folder = who.ROOT / ("bench/results" if whole else "build/bench/results")
    folder.mkdir(parents=True, exist_ok=True)
    return folder / f"{day}-{cpu}{'-quick' if asked.quick else ''}"


def chosen(heats: Iterable[list[Entrant]], case: str | None) -> list[list[Entrant]]:
    kept = [[e for e in heat if re.search(case or "", e.case)] for heat in heats]
    return [heat for heat in kept if heat]


def run(heats: list[list[Entrant]], limits: Limits, results: Results) -> None:
    began = time.monotonic()
    for number, heat in enumerate(heats, 1):
        minutes = (time.monotonic() - began) / 60
        cases = ", ".join(dict.fromkeys(entrant.case for entrant in heat))
        print(f"[{minutes:4.1f} min] {number}/{len(heats)} {cases}", file=sys.stderr)
        Heat(limits, results).run(heat)
    results.about["minutes"] = round((time.monotonic() - began) / 60, 1)


def main() -> None:
    asked = arguments()
    heats = chosen(plan.quick_heats() if asked.quick else plan.heats(), asked.case)
    if not heats:
        sys.exit(f"bench: no case's name matches {asked.case}")
    day = datetime.date.today().isoformat()
    results = Results(
        about={
            "date": day,
            "machine": machine.describe(who.ROOT, who.LEAFHULL),
            "stand_ins": plan.stand_ins(),
            "absent": [],
        }
    )
    for tree, other in plan.stand_ins().items():
        print(f"bench: THERE IS NO {tree} HERE; {other} RUNS IN ITS PLACE", file=sys.stderr)
    run(heats, QUICK if asked.quick else FULL, results)
    names = dict.fromkeys(record.case for record in results.records)
    results.about["cases"] = {name: about for name in names if (about := plan.about(name))}
    path = stem(asked, day)
    results.save(path)
    for file in render.render(path):
        print(file)


if __name__ == "__main__":
    main()
