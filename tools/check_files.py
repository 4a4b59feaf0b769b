#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks every file's length, license line and white space; that packages.txt, which ./dev installs,
has each package that cmake/dependencies.cmake names; and that Debian's node runs every npm package,
which a machine with a newer node does not show."""

import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = (".ci", "bench", "cmake", "examples", "include", "kernels", "src", "tests", "tools", "web")
SOURCES = {".h", ".cpp", ".cl", ".clh", ".py", ".sh", ".js", ".mjs"}
TEXTS = SOURCES | {".cmake", ".css", ".html", ".in", ".json", ".md", ".supp", ".txt", ".yml"}
LINES_MAX = 600
NODE = (18, 20, 4)  # Debian 12's


def files():
    yield from (p for p in ROOT.iterdir() if p.is_file())
    for folder in FOLDERS:
        yield from (p for p in (ROOT / folder).rglob("*") if p.is_file())


def is_script(path):
    return path.suffix == "" and path.read_bytes()[:2] == b"#!"


def faults_of(file):
    source = file.suffix in SOURCES or is_script(file)
    if not source and file.suffix not in TEXTS:
        return
    path = file.relative_to(ROOT)
    lines = file.read_text(encoding="utf-8").splitlines()
    if source and len(lines) > LINES_MAX:
        yield f"{path}: {len(lines)} lines; split it, at most {LINES_MAX} are allowed"
    if source and not any("SPDX-License-Identifier: Apache-2.0" in line for line in lines[:3]):
        yield f"{path}: no SPDX-License-Identifier in the first three lines"
    if path.suffix != ".md":
        for number, line in enumerate(lines, 1):
            if line != line.rstrip():
                yield f"{path}:{number}: white space at the end of the line"


def unlisted_packages():
    listed = {
        line.split()[1]
        for line in (ROOT / "packages.txt").read_text().splitlines()
        if line and not line.startswith("#")
    }
    rows = (ROOT / "cmake/dependencies.cmake").read_text()
    for packages in re.findall(r'^ *leafhull_require\(\S+ \S+ "([^"]+)"', rows, re.MULTILINE):
        for package in sorted(set(packages.split()) - listed):
            yield f"packages.txt: lacks {package}, which cmake/dependencies.cmake names"


def admits(versions, node):
    """Whether `versions`, as in the field engines of an npm package, allows the version `node`."""

    def holds(sign, digits):
        wanted = tuple(int(part) for part in digits.split(".") if part.isdigit())
        if sign == ">=":
            return node >= wanted
        if sign == "^":
            return node >= wanted and node[0] == wanted[0]
        return node[: len(wanted)] == wanted

    return any(
        all(holds(*bound) for bound in re.findall(r"(>=|\^|)\s*([\d.*]+)", bounds))
        for bounds in versions.split("||")
    )


def packages_for_newer_node():
    for lock in ("tests/package-lock.json", "web/package-lock.json"):
        for name, package in json.loads((ROOT / lock).read_text())["packages"].items():
            versions = package.get("engines", {}).get("node", "*")
            if not admits(versions, NODE):
                yield f"{lock}: {name} wants node {versions}, Debian 12 has {NODE}"


def main():
    faults = [fault for file in sorted(files()) for fault in faults_of(file)]
    faults += [*unlisted_packages(), *packages_for_newer_node()]
    print("\n".join(faults), end="\n" if faults else "")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
