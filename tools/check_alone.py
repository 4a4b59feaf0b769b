#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that every source and header of src/, include/ and bench/ compiles alone and uses everything
that it defines for itself; a unity build does not show that. The arguments are a folder where CMake has
written compile_commands.json for a build without unity files, and how many files to check at a time."""

import concurrent.futures
import json
import pathlib
import re
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Where the names of headers in #include lines start.
FOLDERS = {ROOT / "include": ROOT / "include", ROOT / "src": ROOT / "src", ROOT / "bench": ROOT}
INCLUDE = re.compile(r'^#include [<"]([^>"]+)[>"]', re.MULTILINE)
CHECK = ("-fsyntax-only", "-Wno-everything", "-Wunused", "-Werror")


def flags_of(entry):
    words = shlex.split(entry["command"])[1:]
    output = words.index("-o")
    return [word for word in words[:output] + words[output + 2 :] if word not in ("-c", entry["file"])]


def room_of(file):
    top, *below = file.relative_to(ROOT).parts
    return below[0] if top == "src" else top


def checks(build):
    """Pairs of a file's name and the command that compiles it."""
    database = json.loads((build / "compile_commands.json").read_text())
    sources = {pathlib.Path(e["file"]): flags_of(e) for e in database}
    sources = {file: flags for file, flags in sources.items() if set(FOLDERS) & set(file.parents)}
    rooms, seen = {}, set()
    for file, flags in sources.items():
        rooms.setdefault(room_of(file), flags)
        # The header that a source includes first compiles alone there.
        seen.update(INCLUDE.findall(file.read_text(encoding="utf-8"))[:1])
        yield file, ["clang++-16", *flags, *CHECK, str(file)]
    for folder, included_from in FOLDERS.items():
        for header in sorted(folder.rglob("*.h")):
            if header.relative_to(included_from).as_posix() not in seen:
                flags = rooms.get(room_of(header), next(iter(rooms.values())))
                only_it = ("-include", str(header), "-x", "c++", "/dev/null")
                yield header, ["clang++-16", *flags, *CHECK, *only_it]


def main():
    def fails(check):
        file, command = check
        done = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode:
            print(f"{file.relative_to(ROOT)} does not compile by itself:\n{done.stderr}")
        return done.returncode

    build = pathlib.Path(sys.argv[1])
    with concurrent.futures.ThreadPoolExecutor(int(sys.argv[2])) as pool:
        results = list(pool.map(fails, checks(build)))
    return not results or any(results)


if __name__ == "__main__":
    sys.exit(main())
