# SPDX-License-Identifier: Apache-2.0
"""Hand-made kernels, meshes and reports in the file formats that recount reads."""

import itertools
import math
import struct

KERNEL_PROPERTIES = "x y z nx ny nz ux uy uz vx vy vz ru rv rn density weight".split()
H = 0.25
IDENTITY = ((0, 0, 1), (1, 0, 0), (0, 1, 0))  # n, u, v


def as_float(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


def normalized(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def tilted_frame():
    n, u = normalized((1, 2, 2)), normalized((2, 1, -2))
    return n, u, cross(n, u)


class Kernel:
    def __init__(self, centre, radii, frame=IDENTITY, density=1.0, weight=1.0):
        self.centre = tuple(map(as_float, centre))
        self.frame, self.radii, self.density = frame, tuple(map(as_float, radii)), density
        self.weight = as_float(weight)

    def xi(self, p):
        n, u, v = self.frame
        offset = [a - b for a, b in zip(p, self.centre)]
        return sum((sum(a * b for a, b in zip(offset, axis)) / radius) ** 2
                   for axis, radius in zip((u, v, n), self.radii))

    def row(self):
        n, u, v = self.frame
        return (*self.centre, *n, *u, *v, *self.radii, self.density, self.weight)


def header(properties, vertex_count, triangle_count=None):
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {vertex_count}"]
    lines += [f"property float {name}" for name in properties]
    if triangle_count is not None:
        lines += [f"element face {triangle_count}", "property list uchar int vertex_indices"]
    return ("\n".join(lines) + "\nend_header\n").encode()


def write_kernels(path, kernels):
    rows = b"".join(struct.pack("<17f", *kernel.row()) for kernel in kernels)
    path.write_bytes(header(KERNEL_PROPERTIES, len(kernels)) + rows)


def write_mesh(path, mesh):
    vertices = b"".join(struct.pack("<6f", *p, *n) for p, n in mesh["vertices"])
    faces = b"".join(struct.pack("<B3i", 3, *t) for t in mesh["triangles"])
    properties = "x y z nx ny nz".split()
    path.write_bytes(header(properties, len(mesh["vertices"]), len(mesh["triangles"])) +
                     vertices + faces)


def count_cells(is_inside, reach):
    """The number of inside and on cells of the lattice within `reach` samples of the origin."""
    samples = {p: is_inside(p) for p in itertools.product(range(-reach, reach + 2), repeat=3)}
    inside = on = 0
    for i, j, k in itertools.product(range(-reach, reach + 1), repeat=3):
        corners = sum(samples[i + a, j + b, k + c]
                      for a, b, c in itertools.product((0, 1), repeat=3))
        inside += corners == 8
        on += 0 < corners < 8
    return inside, on


def density(kernels, p):
    return sum(kernel.weight * (1 - kernel.xi(p)) ** 2 for kernel in kernels if kernel.xi(p) < 1)


def corners(p):
    """The corner samples of the cell of p, with their trilinear weights."""
    cell = [math.floor(x / H) for x in p]
    for corner in itertools.product((0, 1), repeat=3):
        yield ([H * (c + d) for c, d in zip(cell, corner)],
               math.prod(x / H - c if d else 1 - x / H + c for x, c, d in zip(p, cell, corner)))


def trilinear(kernels, p):
    return sum(weight * density(kernels, q) for q, weight in corners(p))


def make_report(method, kernels, radius_max, threshold, inside, on, dilated, **changes):
    densities = [kernel.density for kernel in kernels]
    mean = sum(densities) / len(densities)
    variance = sum((d - mean) ** 2 for d in densities) / len(densities)
    longest = max(max(k.centre[i] for k in kernels) - min(k.centre[i] for k in kernels)
                  for i in range(3))
    return {
        "parameters": {
            "points": "vertices", "method": method, "threshold": threshold,
            "threshold_percent": None, "coverage": None,
            "radius_max": radius_max, "radius_unit": "model", "radius_max_model": radius_max,
            "flatness": 0.5, "falloff": 2, "spread": "stddev", "density": "exact", "band_low": 0,
            "band_low_percent": None, "band_high": 2, "band_high_percent": None, "min_component": 0, "adaptivity": 0, "snap": True,
            "resolution": round((longest + 2 * radius_max) / H), "voxel_size": H},
        "counts": {"leaf_points": len(kernels), "evaluated_voxels": 100000, "mesh_vertices": 0,
                   "mesh_triangles": 0, "components": 1},
        "density": {"mean": mean, "variance": variance, "p1": mean,
                    "p2": mean + 2 * math.sqrt(variance)},
        "metrics": {"inside_voxels": inside, "on_voxels": on, "dilated_voxels": dilated,
                    "off_site_exact": 0, "off_site_sampled": 0} | changes}


def octahedral_sphere(steps):
    """Unit vectors and outward triangles of a finely divided octahedron."""
    points, triangles = [], []
    index = {}

    def vertex(p):
        if p not in index:
            index[p] = len(points)
            points.append(normalized(p))
        return index[p]

    for sx, sy, sz in itertools.product((1, -1), repeat=3):
        def at(i, j):
            return vertex((sx * i, sy * j, sz * (steps - i - j)))
        for i in range(steps):
            for j in range(steps - i):
                faces = [(at(i, j), at(i + 1, j), at(i, j + 1))]
                if i + j < steps - 1:
                    faces.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
                triangles += [f if sx * sy * sz > 0 else f[::-1] for f in faces]
    return points, triangles


def ellipsoid_mesh(kernel, scale):
    """The level set xi = scale^2 of one kernel."""
    points, triangles = octahedral_sphere(24)
    n, u, v = kernel.frame
    vertices = []
    for p in points:
        offset = [scale * sum(c * r * axis[i] for c, r, axis in zip(p, kernel.radii, (u, v, n)))
                  for i in range(3)]
        normal = normalized([sum(c / r * axis[i] for c, r, axis in zip(p, kernel.radii, (u, v, n)))
                             for i in range(3)])
        vertices.append((tuple(a + b for a, b in zip(kernel.centre, offset)), normal))
    return {"vertices": vertices, "triangles": triangles}
