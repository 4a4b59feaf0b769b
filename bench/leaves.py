#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How well leaves are found: precision and recall by area of the files in tests/leaves.json, as the
table of docs/leaves.md; ends with 1 where one of them is below 0.95.

bench/leaves.py LEAFHULL FOLDER    the folder that holds the files of the list
"""

import argparse
import json
import pathlib
import subprocess
import sys

LIST = pathlib.Path(__file__).parent.parent / "tests" / "leaves.json"
LEAST = 0.95


def measure(leafhull, file, right):
    """Precision, recall and what was said."""
    command = [leafhull, "inspect", file, "--json"]
    page = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    found = missed = wrong = 0.0
    for candidate in page["candidates"]:
        is_leaf = candidate["colour" if candidate["is_part"] else "material"] in right
        if candidate["leaves"]:
            found += candidate["area"] * is_leaf
            wrong += candidate["area"] * (not is_leaf)
        # What is passed over for being finer, or a part of a meadow, is no leaf that was missed.
        elif candidate["verdict"] == "no":
            missed += candidate["area"] * is_leaf
    said = page["chosen"].removeprefix("leaves: ").replace("|", "\\|")
    return found / (found + wrong or 1), found / (found + missed or 1), said


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("leafhull", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    arguments = parser.parse_args()
    good = True
    print("| file | precision | recall | leaves |\n|---|---|---|---|")
    for name, right in json.loads(LIST.read_text())["files"].items():
        file = arguments.folder / name
        if not file.exists():
            print(f"SKIPPED: there is no {file}", file=sys.stderr)
            continue
        precision, recall, said = measure(arguments.leafhull, file, right)
        good = good and min(precision, recall) >= LEAST
        print(f"| `{name}` | {precision:.3f} | {recall:.3f} | {said} |")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
