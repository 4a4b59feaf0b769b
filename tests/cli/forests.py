# SPDX-License-Identifier: Apache-2.0
"""Small forests, and readers for the output of leafhull forest."""

import collections
import os
import pathlib
import struct

import glb
from command import CommandTest

MPIRUN = os.environ.get("MPIRUN", "")
UNDER_MPIRUN = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
#: Trees are about 15 voxels wide.
COARSE = ("--voxel-size", "0.3")

Surface = collections.namedtuple("Surface", "vertices triangles")


def mpirun(ranks):
    return [MPIRUN, "--oversubscribe", "--bind-to", "none", "-n", str(ranks)]


def files_in(folder):
    """The bytes of every file, by its path."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(pathlib.Path(folder).rglob("*"))
        if path.is_file()
    }


def read_glb(path):
    """The one mesh of a GLB: vertices (position and normal) and triangles (numbers of vertices)."""
    document, binary = glb.unpack(path.read_bytes())
    node = next(n for n in document["nodes"] if "mesh" in n)
    origin = node.get("translation", [0, 0, 0])
    primitive = document["meshes"][node["mesh"]]["primitives"][0]

    def elements(index):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        kind = {5126: "f", 5125: "I", 5123: "H"}[accessor["componentType"]]
        record = "<" + kind * {"VEC3": 3, "SCALAR": 1}[accessor["type"]]
        stride = view.get("byteStride", struct.calcsize(record))
        return [
            struct.unpack_from(record, binary, start + stride * i) for i in range(accessor["count"])
        ]

    positions = elements(primitive["attributes"]["POSITION"])
    normals = elements(primitive["attributes"]["NORMAL"])
    indices = [i for (i,) in elements(primitive["indices"])]
    vertices = [
        (*(o + c for o, c in zip(origin, p)), *n) for p, n in zip(positions, normals, strict=True)
    ]
    return Surface(vertices, list(zip(*[iter(indices)] * 3, strict=True)))


def read_ply(path):
    head, _, data = path.read_bytes().partition(b"end_header\n")
    lines = [line.split() for line in head.decode().splitlines()]
    count = {words[1]: int(words[2]) for words in lines if words[0] == "element"}
    kinds = {"float": "f", "double": "d"}
    record = "<" + "".join(kinds[w[1]] for w in lines if w[0] == "property" and w[1] in kinds)
    size = struct.calcsize(record) * count["vertex"]
    faces = list(struct.iter_unpack("<B3I", data[size:]))
    assert len(faces) == count["face"] and {face[0] for face in faces} <= {3}
    return Surface(list(struct.iter_unpack(record, data[:size])), [face[1:] for face in faces])


def tiles_of(folder, level=0):
    """The tiles of a level, by position."""
    return {
        tuple(map(int, path.stem.split("_"))): read_glb(path)
        for path in (folder / "tiles" / str(level)).glob("*.glb")
    }


def unordered(surface):
    """How often each vertex, and each triangle of vertices, occurs, whatever their order."""
    triangles = collections.Counter()
    for numbers in surface.triangles:
        corners = [surface.vertices[i] for i in numbers]
        first = corners.index(min(corners))
        triangles[tuple(corners[first:] + corners[:first])] += 1
    return collections.Counter(surface.vertices), triangles


class ForestTest(CommandTest):
    def setUp(self):
        super().setUp()
        for name, (count, radius, seed) in {
            "ash": (300, 2.0, 1),
            "elm": (200, 1.5, 2),
            "oak": (400, 2.5, 3),
        }.items():
            self.input(f"{name}.glb", glb.tree(*glb.cards(count, radius, seed=seed)))

    def trees(self):
        return [self.folder / f"{name}.glb" for name in ("ash", "elm", "oak")]

    def scatter(self, count, *flags):
        scene = self.folder / f"{count}.csv"
        self.succeed("scatter", *self.trees(), "--count", count, *flags, "-o", scene)
        return scene

    def stand(self, *rows, name="stand.csv"):
        """A scene of rows that all have the same columns."""
        head = "model,x,y,z,yaw,scale"[: None if rows and rows[0].count(",") == 5 else 11]
        return self.input(name, "\n".join([head, *rows, ""]).encode())

    def forest(self, scene, folder, *flags, **options):
        return self.succeed("forest", scene, "-o", self.out / folder, *flags, **options)

    def assert_same_files(self, folder, expected):
        """Compares names before bytes, so that a failure is readable."""
        found = files_in(folder)
        self.assertEqual(sorted(found), sorted(expected))
        self.assertEqual([name for name in found if found[name] != expected[name]], [])

    def assert_closed(self, surface):
        """Every edge occurs once in each direction, so no vertex of a seam occurs twice."""
        self.assertEqual(
            {i for triangle in surface.triangles for i in triangle},
            set(range(len(surface.vertices))),
            "vertices of no triangle",
        )
        edges = collections.Counter(
            edge for a, b, c in surface.triangles for edge in ((a, b), (b, c), (c, a))
        )
        self.assertEqual(max(edges.values()), 1, "an edge twice in one direction")
        self.assertEqual([e for e in edges if e[::-1] not in edges], [], "open edges")
