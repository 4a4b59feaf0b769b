# SPDX-License-Identifier: Apache-2.0
"""A small tree as a GLB: an oval crown of square cards, each seed another."""

import json
import random
import struct

LEAVES = 1_000
FLOAT, UINT16 = 5126, 5123


def card_tree(seed: int) -> bytes:
    pick = random.Random(seed)
    radius, height = pick.uniform(1.5, 3), pick.uniform(3, 7)
    corners: list[tuple[float, ...]] = []
    for _ in range(LEAVES):
        direction = [pick.gauss(0, 1) for _ in range(3)]
        part = pick.random() ** (1 / 3) / sum(d * d for d in direction) ** 0.5
        radii = (radius, height / 2, radius)
        middle = [d * part * r for d, r in zip(direction, radii, strict=True)]
        middle[1] += 1 + height / 2
        u, v = pick.sample(range(3), 2)
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            corner = list(middle)
            corner[u] += a * 0.1
            corner[v] += b * 0.1
            corners.append(tuple(corner))
    cards = range(0, len(corners), 4)
    triangles = [(c, c + i, c + i + 1) for c in cards for i in (1, 2)]
    return glb(corners, triangles)


def glb(corners: list[tuple[float, ...]], triangles: list[tuple[int, ...]]) -> bytes:
    vertices = b"".join(struct.pack("<3f", *corner) for corner in corners)
    indices = b"".join(struct.pack("<3H", *triangle) for triangle in triangles)
    columns = list(zip(*corners, strict=True))
    primitive = {"attributes": {"POSITION": 0}, "indices": 1, "material": 0}
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [primitive]}],
        "materials": [{"name": "leaves", "alphaMode": "MASK"}],
        "buffers": [{"byteLength": len(vertices) + len(indices)}],
        "bufferViews": [
            {"buffer": 0, "byteLength": len(vertices)},
            {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(indices)},
        ],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": FLOAT,
                "count": len(corners),
                "type": "VEC3",
                "min": [min(column) for column in columns],
                "max": [max(column) for column in columns],
            },
            {
                "bufferView": 1,
                "componentType": UINT16,
                "count": 3 * len(triangles),
                "type": "SCALAR",
            },
        ],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary = vertices + indices
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
