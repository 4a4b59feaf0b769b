#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""hills.py FILE.png: a height map of hills that rise, ridge behind ridge, to the picture's top."""

import math
import random
import struct
import sys
import zlib

SIZE = 512
LATTICE = 16  # cells along the edge of the noise's period


def smooth(t: float) -> float:
    return t * t * (3 - 2 * t)


class Noise:
    """Random values on a lattice, 0..1, smooth between them."""

    def __init__(self, seed: int) -> None:
        pick = random.Random(seed)
        self._values = [[pick.random() for _ in range(LATTICE)] for _ in range(LATTICE)]

    def __call__(self, x: float, y: float) -> float:
        column, row = math.floor(x), math.floor(y)
        s, t = smooth(x - column), smooth(y - row)

        def at(i: int, j: int) -> float:
            return self._values[(row + j) % LATTICE][(column + i) % LATTICE]

        top = at(0, 0) + s * (at(1, 0) - at(0, 0))
        bottom = at(0, 1) + s * (at(1, 1) - at(0, 1))
        return top + t * (bottom - top)


broad, fine = Noise(11), Noise(12)


def height(u: float, v: float) -> float:
    """0..1; u from left to right and v from the top down, 0..1."""
    bend = broad(2 * u, 2 * v)
    ridge = 0.5 + 0.5 * math.cos(2 * math.pi * (2.2 * v + 1.2 * u + 0.9 * bend))
    rise = smooth(1 - v)
    return (
        0.3 * rise
        + (0.15 + 0.45 * rise) * ridge * (0.1 + 1.3 * broad(3 * u + 7, 3 * v))
        + 0.05 * fine(9 * u, 9 * v)
    )


def chunk(kind: bytes, data: bytes) -> bytes:
    check = struct.pack(">I", zlib.crc32(kind + data))
    return struct.pack(">I", len(data)) + kind + data + check


def main() -> None:
    rows = [
        [height((i + 0.5) / SIZE, (j + 0.5) / SIZE) for i in range(SIZE)] for j in range(SIZE)
    ]
    low, high = min(map(min, rows)), max(map(max, rows))
    grey = [[round(65535 * (h - low) / (high - low)) for h in row] for row in rows]
    lines = b"".join(b"\0" + struct.pack(f">{SIZE}H", *row) for row in grey)
    header = struct.pack(">2I5B", SIZE, SIZE, 16, 0, 0, 0, 0)  # 16 bits of grey
    with open(sys.argv[1], "wb") as file:
        file.write(
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(lines, 9))
            + chunk(b"IEND", b"")
        )


if __name__ == "__main__":
    main()
