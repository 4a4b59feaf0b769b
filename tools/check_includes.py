#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks who includes whom: each room of src/, and bench/, uses the rooms and third-party libraries of
its row in src/rooms.cmake and no others; public headers use only the standard library. No two headers
may define types of the same name, which a linker would take for one type."""

import pathlib
import re
import sys

import rooms as table

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIBRARIES, ROOMS = table.read()

# Headers of POSIX and the C library for files, processes, signals, memory and shared libraries.
SYSTEM = (
    "sys/", "dlfcn.h", "fcntl.h", "fnmatch.h", "malloc.h", "poll.h", "sched.h", "signal.h",
    "spawn.h", "unistd.h",
)

NAMESPACE = re.compile(r"^namespace ([\w:]+) \{", re.MULTILINE)
TYPE = re.compile(r"^(?:struct|class|enum class) ([\w:]+)[^;{]*\{", re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def is_standard(header):
    return re.fullmatch(r"[a-z_0-9]+", header) is not None


def library_of(header):
    for name, library in LIBRARIES.items():
        if header.startswith(library.headers):
            return name
    return None


def fault_in_room(name, header, used):
    """What is wrong with the header in that room. Adds what it uses of the room's row to `used`."""
    room = ROOMS[name]
    first = header.split("/")[0]
    if is_standard(header) or header.startswith(SYSTEM) or first in ("leafhull", name):
        return None
    if first in ROOMS and "/" in header:
        used.add((name, first))
        return None if first in room.rooms else f"{name} may not know the room {first}"
    library = library_of(header)
    if library:
        used.add((name, library))
        return None if library in room.libraries else f"{name} may not know the library {library}"
    return "neither leafhull's, nor standard, nor in the tables of src/rooms.cmake"


def granted_and_unused(used):
    for name, room in ROOMS.items():
        for known in (*room.rooms, *room.libraries):
            if (name, known) not in used:
                yield f"src/rooms.cmake: {name} may know {known} but does not use it"


def fault_in_public(header):
    if is_standard(header) or header.startswith("leafhull/"):
        return None
    return "a public header includes only the standard library and leafhull/"


def check(path, judge):
    for header in INCLUDE.findall(path.read_text(encoding="utf-8")):
        fault = judge(header)
        if fault:
            yield f'{path.relative_to(ROOT)}: #include "{header}": {fault}'


def types_of_two_headers():
    definers = {}
    for path in sorted([*(ROOT / "include").rglob("*.h"), *(ROOT / "src").rglob("*.h")]):
        text = path.read_text(encoding="utf-8")
        for name in TYPE.findall(text):
            qualified = f"{NAMESPACE.search(text)[1]}::{name}"
            first = definers.setdefault(qualified, path.relative_to(ROOT))
            if first != path.relative_to(ROOT):
                yield f"{path.relative_to(ROOT)}: {first} defines another {qualified}"


def main():
    faults = list(types_of_two_headers())
    used = set()
    for path in sorted((ROOT / "include").rglob("*.h")):
        faults += check(path, fault_in_public)
    for path in sorted([*(ROOT / "src").glob("*/**/*"), *(ROOT / "bench").rglob("*")]):
        if path.suffix not in {".h", ".cpp"}:
            continue
        room = path.relative_to(ROOT / "src" if ROOT / "src" in path.parents else ROOT).parts[0]
        if room in ROOMS:
            faults += check(path, lambda header: fault_in_room(room, header, used))
        else:
            faults.append(f"{path.relative_to(ROOT)}: {room} has no row in src/rooms.cmake")
    faults += granted_and_unused(used)
    if table.page_with_table() != table.PAGE.read_text(encoding="utf-8"):
        faults.append("ARCHITECTURE.md: the column \"knows\" is out of date; run tools/rooms.py")
    print("\n".join(faults), end="\n" if faults else "")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
