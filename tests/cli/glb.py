# SPDX-License-Identifier: Apache-2.0
"""Small GLB files with square cards as leaves, and a reader for the output."""

import json
import random
import struct

FLOAT, UINT32 = 5126, 5125


def pack(document, binary=b""):
    """Packs a glTF document and its one buffer into a GLB."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    if binary:
        chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def unpack(data):
    """The document and the buffer of a GLB."""
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + size]), data[28 + size :]


def cards(count=300, radius=2.0, half=0.125, seed=1):
    """Square cards in a ball, at coordinates that floats hold exactly even 10 km away."""
    pick = random.Random(seed)
    positions, triangles = [], []
    while len(positions) < 4 * count:
        centre = [round(pick.uniform(-radius, radius) * 64) / 64 for _ in range(3)]
        if sum(c * c for c in centre) > radius * radius:
            continue
        u, v = pick.sample(range(3), 2)
        first = len(positions)
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            corner = list(centre)
            corner[u] += a * half
            corner[v] += b * half
            positions.append(corner)
        triangles += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    return positions, triangles


def tree(
    positions, triangles, *, material="leaf", alpha="MASK", translation=(0, 0, 0), change=None
):
    """A GLB with one primitive in one node. `change` may edit the document before it is packed."""
    vertices = b"".join(struct.pack("<3f", *p) for p in positions)
    indices = b"".join(struct.pack("<3I", *t) for t in triangles)
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "Tree", "mesh": 0, "translation": list(translation)}],
        "meshes": [
            {
                "name": "Crown",
                "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}],
            }
        ],
        "materials": [{"name": material, "alphaMode": alpha}],
        "buffers": [{"byteLength": len(vertices) + len(indices)}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(vertices)},
            {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(indices)},
        ],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": FLOAT,
                "count": len(positions),
                "type": "VEC3",
                "min": [min(p[i] for p in positions) for i in range(3)],
                "max": [max(p[i] for p in positions) for i in range(3)],
            },
            {
                "bufferView": 1,
                "componentType": UINT32,
                "count": 3 * len(triangles),
                "type": "SCALAR",
            },
        ],
    }
    if change:
        change(document)
    return pack(document, vertices + indices)


def vertices(data):
    """The vertex positions of a GLB with one mesh, its node's translation applied."""
    document, binary = unpack(data)
    node = next(n for n in document["nodes"] if "mesh" in n)
    origin = node.get("translation", [0, 0, 0])
    accessor = document["accessors"][
        document["meshes"][node["mesh"]]["primitives"][0]["attributes"]["POSITION"]
    ]
    view = document["bufferViews"][accessor["bufferView"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    stride = view.get("byteStride", 12)
    return [
        tuple(o + c for o, c in zip(origin, struct.unpack_from("<3f", binary, start + stride * i)))
        for i in range(accessor["count"])
    ]
