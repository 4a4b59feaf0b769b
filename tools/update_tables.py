#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts the tables that the command prints between the markers of a page: the output of `leafhull VERB`
goes between <!-- VERB --> and <!-- /VERB -->."""

import argparse
import pathlib
import re
import subprocess
import sys

TABLE = re.compile(r"<!-- (help-\w+) -->\n.*?<!-- /\1 -->\n", re.DOTALL)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="writes nothing; fails if a table is stale")
    parser.add_argument("leafhull", help="the built command")
    parser.add_argument("page", type=pathlib.Path, help="the file with the markers")
    arguments = parser.parse_args()

    def table(match):
        verb = match[1]
        text = subprocess.run(
            [arguments.leafhull, verb], check=True, capture_output=True, text=True
        ).stdout
        return f"<!-- {verb} -->\n\n{text}\n<!-- /{verb} -->\n"

    page = arguments.page.read_text(encoding="utf-8")
    updated, tables = TABLE.subn(table, page)
    if tables == 0:
        sys.exit(f"{arguments.page}: no markers such as <!-- help-options -->")
    if updated == page:
        return
    if arguments.check:
        sys.exit(
            f"{arguments.page}: the tables are out of date. "
            f"Run: {sys.argv[0]} {arguments.leafhull} {arguments.page}"
        )
    arguments.page.write_text(updated, encoding="utf-8")


if __name__ == "__main__":
    main()
