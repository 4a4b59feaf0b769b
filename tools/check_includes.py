#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks who includes whom: each room of src/, and bench/, knows only the rooms and the third-party
libraries of its row in ROOMS, and the public headers know nothing but the standard library. No two
headers define a type of one name, which a linker would take for one type."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Room: the rooms it may include beside itself, and the third-party libraries it may know.
ROOMS = {
    "colour": ((), ()),
    "input": (("colour", "text"), ("tinygltf", "tinyobjloader", "json", "draco", "meshoptimizer", "stb", "tbb", "ufbx", "webp")),
    "leaves": ((), ("eigen", "tbb")),
    "foliage": (("colour", "leaves"), ("eigen", "tbb")),
    "points": (("leaves",), ("eigen", "tbb")),
    "density": ((), ("openvdb", "tbb")),
    "options": (("density",), ()),
    "device": (("density",), ("opencl",)),
    "surface": (("density",), ("openvdb", "tbb")),
    "output": (("colour", "density", "surface", "text"), ("tinygltf", "openvdb", "json")),
    "pipeline": (("density", "device", "points", "surface"), ("tbb",)),
    "text": ((), ()),
    "process": ((), ()),
    "render": (("colour", "text"), ("embree", "openexr", "stb", "tbb")),
    "watercolour": (("colour", "device", "render", "text"), ("json",)),
    "chart": (("process", "text"), ()),
    "sweep": (("chart", "output"), ("json",)),
    "study": ((), ()),
    "page": (("chart", "output", "study", "text"), ("json", "meshoptimizer", "mustache")),
    "picture": (
        (
            "density", "device", "foliage", "output", "pipeline", "process", "render", "surface",
            "text", "watercolour",
        ),
        ("tbb",),
    ),
    "scene": (("foliage", "input", "text"), ("json", "stb")),
    "ranks": ((), ("mpi",)),
    "forest": (
        ("density", "device", "output", "pipeline", "surface", "text"),
        ("eigen", "json", "openvdb", "openssl", "tbb", "tinygltf"),
    ),
    "cli": (("text",), ("cli11", "json")),
    "bench": (
        ("density", "device", "picture", "pipeline", "points", "surface"),
        ("cgal", "cli11", "gtest", "json", "opencl", "openvdb", "tbb"),
    ),
}

# Library: how the paths of its headers begin.
LIBRARIES = {
    "cgal": ("CGAL/",),
    "cli11": ("CLI/",),
    "draco": ("draco/",),
    "eigen": ("Eigen/",),
    "embree": ("embree3/",),
    "gtest": ("gtest/",),
    "json": ("nlohmann/",),
    "meshoptimizer": ("meshoptimizer.h",),
    "mustache": ("kainjow/",),
    "opencl": ("CL/",),
    "mpi": ("mpi.h",),
    "openexr": ("OpenEXR/",),
    "openssl": ("openssl/",),
    "openvdb": ("openvdb/",),
    "stb": ("stb/", "stb_"),
    "tbb": ("tbb/", "oneapi/"),
    "tinygltf": ("tiny_gltf.h",),
    "tinyobjloader": ("tiny_obj_loader.h",),
    "ufbx": ("ufbx.h",),
    "webp": ("webp/",),
}

# Of POSIX and the C library, for files, processes, signals, memory and shared libraries.
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
    for name, beginnings in LIBRARIES.items():
        if header.startswith(beginnings):
            return name
    return None


def fault_in_room(room, header):
    rooms, libraries = ROOMS[room]
    first = header.split("/")[0]
    if is_standard(header) or header.startswith(SYSTEM) or first == "leafhull":
        return None
    if first in ROOMS and "/" in header:
        return None if first == room or first in rooms else f"{room} may not know the room {first}"
    library = library_of(header)
    if library:
        return None if library in libraries else f"{room} may not know the library {library}"
    return "neither leafhull's, nor standard, nor in this checker's tables"


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
    for path in sorted((ROOT / "include").rglob("*.h")):
        faults += check(path, fault_in_public)
    for path in sorted([*(ROOT / "src").glob("*/**/*"), *(ROOT / "bench").rglob("*")]):
        if path.suffix not in {".h", ".cpp"}:
            continue
        room = path.relative_to(ROOT / "src" if ROOT / "src" in path.parents else ROOT).parts[0]
        if room in ROOMS:
            faults += check(path, lambda header: fault_in_room(room, header))
        else:
            faults.append(f"{path.relative_to(ROOT)}: {room} has no row in tools/check_includes.py")
    print("\n".join(faults), end="\n" if faults else "")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
