#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the table of src/rooms.cmake. Run as a program, it rewrites the column "knows" of
ARCHITECTURE.md from that table."""

import dataclasses
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "ARCHITECTURE.md"
ROW = re.compile(r"^\| `(?:src/)?(\w+)` \| .* \| (.*) ?\|$", re.MULTILINE)


@dataclasses.dataclass
class Library:
    title: str
    headers: tuple  # the first parts of its headers' paths


@dataclasses.dataclass
class Room:
    rooms: tuple  # the rooms that it may include beside itself
    libraries: tuple  # the libraries that it may use


def read():
    """The libraries and the rooms, by name."""
    text = re.sub(r"^#.*$", "", (ROOT / "src/rooms.cmake").read_text(), flags=re.MULTILINE)
    libraries = {
        name: Library(title, tuple(headers.split()))
        for name, title, headers in re.findall(
            r'library\((\w+) "([^"]+)" TARGETS[^)]*?HEADERS ([^)]+)\)', text
        )
    }
    rooms = {
        name: Room(tuple(knows.split()), tuple(uses.split()))
        for name, knows, uses in re.findall(
            r"room\((\w+)\s+\w+\s+ROOMS([^)]*?)LIBRARIES([^)]*)\)", text
        )
    }
    return libraries, rooms


def knows(room, libraries):
    names = [f"`{other}`" for other in room.rooms]
    return ", ".join(names + [libraries[library].title for library in room.libraries])


def page_with_table():
    libraries, rooms = read()

    def row(match):
        if match[1] not in rooms:
            return match[0]
        start = match.start(2) - match.start()
        text = knows(rooms[match[1]], libraries)
        return f"{match[0][:start]}{text}{' ' if text else ''}|"

    return ROW.sub(row, PAGE.read_text(encoding="utf-8"))


if __name__ == "__main__":
    PAGE.write_text(page_with_table(), encoding="utf-8")
    sys.exit(0)
