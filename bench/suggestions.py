#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the nine shapes that `leafhull suggest` offers differ, tree by tree, and are what their
commands give; ends with 1 where two neighbours are too close or one is out of reach.

bench/suggestions.py LEAFHULL TREE... [--leaves NAME=GLOB]...
"""

import argparse
import json
import pathlib
import shlex
import subprocess
import sys
import tempfile

import styles

LEAST_RATIO, LEAST_EROSION = 1.1, 0.04
SLIDER_ERROR = 0.01


def suggestions(leafhull, tree, options):
    with tempfile.TemporaryDirectory() as folder:
        picture = pathlib.Path(folder, "suggest.png")
        command = [leafhull, "suggest", tree, *options, "--json", "-q", "-o", picture]
        done = subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True)
    return json.loads(done.stdout)["suggestions"]


def faults(leafhull, tree, choices):
    shapes = []
    for choice in choices:
        if choice["failure"]:
            shapes.append(None)
            yield choice["failure"]
            continue
        words = shlex.split(choice["command"])
        shape = styles.Extraction(leafhull, tree, words[3 : words.index("-o")])
        shapes.append(shape)
        for slider in ("erosion", "dilation"):
            found = getattr(shape, slider)
            if abs(found - choice[slider]) > SLIDER_ERROR:
                yield f"{slider} {choice[slider]:.3f} became {found:.3f}"
    for i, j in [(i, i + 1) for i in range(9) if i % 3 < 2] + [(i, i + 3) for i in range(6)]:
        a, b = shapes[i], shapes[j]
        if a is None or b is None:
            continue
        ratio = max(a.volume, b.volume) / min(a.volume, b.volume)
        if ratio < LEAST_RATIO and abs(a.erosion - b.erosion) < LEAST_EROSION:
            yield f"{i} and {j}: {ratio:.3f} in volume, {abs(a.erosion - b.erosion):.3f} in erosion"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("leafhull", type=pathlib.Path)
    parser.add_argument("trees", nargs="+", type=pathlib.Path)
    parser.add_argument("--leaves", action="append", default=[], metavar="NAME=GLOB")
    arguments = parser.parse_args()
    globs = dict(entry.split("=", 1) for entry in arguments.leaves)
    found = 0
    for tree in arguments.trees:
        options = ["--leaves", globs[tree.stem]] if tree.stem in globs else []
        choices = suggestions(arguments.leafhull, tree, options)
        print(tree.name)
        for c in choices:
            radius = f"{c['radius_max']:5.2f}" if c["radius_max"] else "    -"
            print(f"  erosion {c['erosion']:5.0%}  dilation {c['dilation']:6.1%}  R_max {radius}")
        for fault in faults(arguments.leafhull, tree, choices):
            found += 1
            print(f"  FAULT {fault}")
    print(f"{len(arguments.trees)} trees, {found} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
