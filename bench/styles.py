#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How far the styles of leaf area lie apart, tree by tree; ends with 1 where two are too close.

bench/styles.py LEAFHULL TREE... [--leaves NAME=GLOB]... [--preset NAME] [-- OPTION...]
"""

import argparse
import array
import json
import pathlib
import subprocess
import sys
import tempfile

STYLES = ("thin", "previous", "painterly", "fat")
MOST_PIECES = 60
MOST_OF_FAT, MOST_OF_PREVIOUS = 0.6, 0.8  # volumes of thin
LEAST_THIN_EROSION, MOST_FAT_EROSION = 0.10, 0.04


def volume(stl):
    """Of a binary STL file."""
    data = stl.read_bytes()
    triangles = int.from_bytes(data[80:84], "little")
    total = 0.0
    for i in range(triangles):
        v = array.array("f", data[84 + 50 * i + 12 : 84 + 50 * i + 48])
        total += (
            v[0] * (v[4] * v[8] - v[5] * v[7])
            + v[1] * (v[5] * v[6] - v[3] * v[8])
            + v[2] * (v[3] * v[7] - v[4] * v[6])
        )
    return total / 6


class Extraction:
    def __init__(self, leafhull, tree, options):
        with tempfile.TemporaryDirectory() as folder:
            shape = pathlib.Path(folder, "shape.stl")
            command = [leafhull, "extract", tree, "-o", shape, "--report", "-", "-q", *options]
            done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
            if done.returncode != 0:
                raise RuntimeError(done.stderr.strip())
            self.report = json.loads(done.stdout)
            self.volume = volume(shape)
        metrics, counts = self.report["metrics"], self.report["counts"]
        self.erosion, self.dilation = metrics["erosion"], metrics["dilation"]
        self.pieces, self.dropped = counts["components"], counts["dropped_components"]


def extractions(leafhull, tree, options):
    return {s: Extraction(leafhull, tree, [*options, "--style", s]) for s in STYLES}


def faults(by_style):
    thin, fat, previous = by_style["thin"], by_style["fat"], by_style["previous"]
    of_fat, of_previous = thin.volume / fat.volume, thin.volume / previous.volume
    if of_fat > MOST_OF_FAT:
        yield f"thin has {of_fat:.2f} of fat's volume"
    if of_previous > MOST_OF_PREVIOUS:
        yield f"thin has {of_previous:.2f} of previous's volume"
    if thin.erosion < LEAST_THIN_EROSION:
        yield f"thin leaves {thin.erosion:.1%} outside"
    if fat.erosion > MOST_FAT_EROSION:
        yield f"fat leaves {fat.erosion:.1%} outside"
    for style, extraction in by_style.items():
        if extraction.pieces > MOST_PIECES:
            yield f"{style} falls into {extraction.pieces} pieces"


def main():
    words = sys.argv[1:]
    at = words.index("--") if "--" in words else len(words)
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("leafhull", type=pathlib.Path)
    parser.add_argument("trees", nargs="+", type=pathlib.Path)
    parser.add_argument("--leaves", action="append", default=[], metavar="NAME=GLOB")
    parser.add_argument("--preset", default="standard")
    arguments = parser.parse_args(words[:at])
    globs = dict(entry.split("=", 1) for entry in arguments.leaves)
    found = 0
    for tree in arguments.trees:
        options = ["--preset", arguments.preset, *words[at + 1 :]]
        if tree.stem in globs:
            options += ["--leaves", globs[tree.stem]]
        by_style = extractions(arguments.leafhull, tree, options)
        fat = by_style["fat"].volume
        print(tree.name)
        for style, e in by_style.items():
            print(
                f"  {style:10} volume {e.volume / fat:5.2f} of fat"
                f"  erosion {e.erosion:6.1%}  dilation {e.dilation:6.1%}"
                f"  pieces {e.pieces:4} and {e.dropped:4} dropped"
                f"  R_max {e.report['parameters']['radius_max']:.3g}"
                f"  T {e.report['parameters']['threshold']:.3g}"
                f"  covered {e.report['metrics']['covered']:.1%}"
            )
        for fault in faults(by_style):
            found += 1
            print(f"  FAULT {fault}")
    print(f"{len(arguments.trees)} trees, {found} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
