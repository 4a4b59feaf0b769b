#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""render.py STEM: writes STEM.md and STEM.svg again from STEM.csv and STEM.json. Forests have no
picture."""

import sys
from pathlib import Path

import forests
import plot
import report
from records import load


def render(stem: Path) -> list[Path]:
    results = load(stem)
    page, picture = stem.with_suffix(".md"), stem.with_suffix(".svg")
    page.write_text(report.page(results))
    if forests.asked(results):
        return [page]
    plot.write(results, picture)
    return [page, picture]


if __name__ == "__main__":
    render(Path(sys.argv[1]))
