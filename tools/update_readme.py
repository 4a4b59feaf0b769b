#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts the option tables of `leafhull help-options` between README.md's option markers."""

import argparse
import pathlib
import subprocess
import sys

BEGIN, END = "<!-- options -->\n", "<!-- /options -->"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing, fail where stale")
    parser.add_argument("leafhull", help="the built command")
    parser.add_argument("readme", type=pathlib.Path, help="the file with the markers")
    arguments = parser.parse_args()

    page = arguments.readme.read_text(encoding="utf-8")
    if page.count(BEGIN) != 1 or page.count(END) != 1:
        sys.exit(f"{arguments.readme}: the markers {BEGIN.strip()} and {END} must stand there once")
    before, rest = page.split(BEGIN)
    after = rest.split(END)[1]
    tables = subprocess.run(
        [arguments.leafhull, "help-options"], check=True, capture_output=True, text=True
    ).stdout
    updated = f"{before}{BEGIN}\n{tables}\n{END}{after}"
    if updated == page:
        return
    if arguments.check:
        sys.exit(
            f"{arguments.readme}: the option tables are out of date. "
            f"Run: {sys.argv[0]} {arguments.leafhull} {arguments.readme}"
        )
    arguments.readme.write_text(updated, encoding="utf-8")


if __name__ == "__main__":
    main()
