# SPDX-License-Identifier: Apache-2.0
"""test_recount.py RECOUNT tests recount on hand-made kernels whose counts follow from geometry."""

import copy
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

from hand_made import (H, IDENTITY, Kernel, corners, count_cells, density, ellipsoid_mesh,
                       make_report, tilted_frame, trilinear, write_kernels, write_mesh)

RECOUNT = ""


class RecountTest(unittest.TestCase):
    def run_recount(self, kernels, report, mesh=None, leaf_kernels=None):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            write_kernels(folder / "kernels.ply", kernels)
            (folder / "report.json").write_text(json.dumps(report))
            command = [RECOUNT, folder / "kernels.ply", folder / "report.json"]
            if mesh:
                write_mesh(folder / "shape.ply", mesh)
                command.append(folder / "shape.ply")
            if leaf_kernels:
                write_kernels(folder / "leaves.ply", leaf_kernels)
                command += ["--leaf-radii", folder / "leaves.ply"]
            return subprocess.run(command, capture_output=True, text=True)

    def assert_agrees(self, *args, **kwargs):
        result = self.run_recount(*args, **kwargs)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def assert_agrees_exactly(self, *args, **kwargs):
        """The counts agree even where the table allows for rounding."""
        counts = [line for line in self.assert_agrees(*args, **kwargs).splitlines()
                  if line.startswith(("inside", "on voxels", "dilated", "off-site"))]
        self.assertEqual(len(counts), 5)
        for line in counts:
            self.assertEqual(float(line[34:].split()[2]), 0, line)

    def assert_differs(self, quantity, *args, **kwargs):
        """Recount exits with 1 and the named row differs. Returns all rows that differ."""
        result = self.run_recount(*args, **kwargs)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        rows = [line[:34].strip() for line in result.stdout.splitlines() if "DIFFERS" in line]
        self.assertIn(quantity, rows, result.stdout)
        return rows

    def assert_every_doctored_number_differs(self, kernels, report, quantities):
        for (section, key), quantity in quantities.items():
            for change in (1, -1):
                doctored = copy.deepcopy(report)
                doctored[section][key] += change
                with self.subTest(key=key, change=change):
                    rows = self.assert_differs(quantity, kernels, doctored)
                    self.assertEqual(rows, [quantity])


METRIC_ROWS = {("metrics", "inside_voxels"): "inside voxels",
               ("metrics", "on_voxels"): "on voxels",
               ("metrics", "dilated_voxels"): "dilated voxels",
               ("metrics", "off_site_exact"): "off-site vertices, exact",
               ("metrics", "off_site_sampled"): "off-site vertices, sampled",
               ("counts", "leaf_points"): "leaf points",
               ("density", "mean"): "density mean", ("density", "variance"): "density variance",
               ("density", "p1"): "p1", ("density", "p2"): "p2"}


class OneSphere(RecountTest):
    """N = (1 - r^2/R^2)^2 = T is the sphere of radius R sqrt(1 - sqrt T)."""

    def setUp(self):
        self.kernels = [Kernel((0.3, 0.2, 0.1), (1.5, 1.5, 1.5))]
        radius = 1.5 * math.sqrt(1 - math.sqrt(0.25))
        centre = self.kernels[0].centre
        inside, on = count_cells(lambda p: math.dist([H * i for i in p], centre) <= radius, 8)
        self.report = make_report("isotropic", self.kernels, 1.5, 0.25, inside, on, inside + on - 1)

    def test_agrees(self):
        self.assert_agrees_exactly(self.kernels, self.report)

    def test_every_doctored_number_differs(self):
        self.assert_every_doctored_number_differs(self.kernels, self.report, METRIC_ROWS)

    def test_radius_off_the_maximum(self):
        self.report["parameters"]["radius_max"] = self.report["parameters"]["radius_max_model"] = 1.6
        self.assert_differs("kernels off Eqs. 7 and 8", self.kernels, self.report)

    def test_wrong_frame(self):
        n, u, v = IDENTITY
        self.kernels[0].frame = (n, u, tuple(-x for x in v))
        self.assert_differs("frame error, largest", self.kernels, self.report)

    def test_value_that_is_not_finite(self):
        self.kernels[0].density = math.nan
        self.assertEqual(self.run_recount(self.kernels, self.report).returncode, 2)

    def test_missing_parameter(self):
        del self.report["parameters"]["falloff"]
        self.assertEqual(self.run_recount(self.kernels, self.report).returncode, 2)


class WeightedKernels(RecountTest):
    def test_sphere(self):
        """N = w (1 - r^2/R^2)^2 = T is the sphere of radius R sqrt(1 - sqrt(T / w))."""
        for weight in (1e-3, 0.4, 1, 30):
            kernels = [Kernel((0.3, 0.2, 0.1), (1.5, 1.5, 1.5), weight=weight)]
            threshold = 0.3 * weight if weight < 0.3 else 0.3
            radius = 1.5 * math.sqrt(1 - math.sqrt(threshold / weight))
            inside, on = count_cells(
                lambda p: math.dist([H * i for i in p], kernels[0].centre) <= radius, 8)
            report = make_report("isotropic", kernels, 1.5, threshold, inside, on, inside + on - 1)
            self.assert_agrees_exactly(kernels, report)
            kernels[0].weight *= 2
            self.assert_differs("inside voxels", kernels, report)

    def test_vertices_and_normals_of_two(self):
        """The surface between two kernels moves with their weights."""
        kernels = [Kernel((x, 0.1, 0.2), (1.5, 1.5, 1.5), density=1.4096, weight=weight)
                   for x, weight in ((0, 1), (0.9, 4))]
        threshold = 0.6
        inside, on = count_cells(
            lambda p: density(kernels, [H * i for i in p]) >= threshold, 12)
        report = make_report("isotropic", kernels, 1.5, threshold, inside, on, inside + on - 2)
        self.assert_agrees_exactly(kernels, report)
        kernels[0].weight, kernels[1].weight = 1, 1
        self.assert_differs("inside voxels", kernels, report)


class SamplesOnTheSurface(RecountTest):
    """Only the 30 samples exactly on N = T, at distance 3h, may count as either inside or outside."""

    def check(self, is_inside, threshold):
        kernels = [Kernel((0, 0, 0), (1.5, 1.5, 1.5))]
        inside, on = count_cells(is_inside, 8)
        report = make_report("isotropic", kernels, 1.5, threshold, inside, on, inside + on - 1)
        return kernels, report

    def test_either_side_is_allowed_and_no_more(self):
        threshold = (1 - (3 * H / 1.5) ** 2) ** 2
        for limit in (8, 9):
            self.assert_agrees(*self.check(lambda p: sum(i * i for i in p) <= limit, threshold))
        for limit in (6, 10):  # rounding does not reach the samples at distance sqrt 8 and sqrt 10
            self.assert_differs(
                "dilated voxels", *self.check(lambda p: sum(i * i for i in p) <= limit, threshold))


class OneEllipsoid(RecountTest):
    def setUp(self):
        self.kernels = [Kernel((0.3, 0.2, 0.1), (2.0, 1.5, 0.75), tilted_frame())]
        self.scale = math.sqrt(1 - math.sqrt(0.25))
        kernel = self.kernels[0]
        inside, on = count_cells(
            lambda p: kernel.xi([H * i for i in p]) <= self.scale ** 2, 10)
        self.report = make_report("uncontrolled", self.kernels, 1.5, 0.25, inside, on,
                                  inside + on - 1)
        self.mesh = ellipsoid_mesh(kernel, self.scale)
        self.report["counts"] |= {"mesh_vertices": len(self.mesh["vertices"]),
                                  "mesh_triangles": len(self.mesh["triangles"])}

    def test_agrees(self):
        self.assert_agrees_exactly(self.kernels, self.report, self.mesh)

    def test_every_doctored_number_differs(self):
        self.assert_every_doctored_number_differs(self.kernels, self.report, METRIC_ROWS)
        for key, row in {"mesh_vertices": "mesh vertices", "mesh_triangles": "mesh triangles",
                         "components": "components"}.items():
            doctored = copy.deepcopy(self.report)
            doctored["counts"][key] += 1
            self.assert_differs(row, self.kernels, doctored, self.mesh)

    def test_flatness(self):
        self.report["parameters"]["flatness"] = 0.51
        self.assert_differs("kernels off Eqs. 7 and 8", self.kernels, self.report)

    def test_hole(self):
        self.mesh["triangles"].pop()
        self.assert_differs("edges not used once each way", self.kernels, self.report, self.mesh)

    def test_one_flipped_triangle(self):
        self.mesh["triangles"][5] = self.mesh["triangles"][5][::-1]
        self.assert_differs("edges not used once each way", self.kernels, self.report, self.mesh)

    def test_inside_out(self):
        self.mesh["triangles"] = [t[::-1] for t in self.mesh["triangles"]]
        rows = self.assert_differs("components facing inward", self.kernels, self.report, self.mesh)
        self.assertIn("mesh volume, voxels", rows)

    def test_vertex_of_no_triangle(self):
        self.mesh["vertices"].append(self.mesh["vertices"][0])
        self.assert_differs("vertices of no triangle", self.kernels, self.report, self.mesh)

    def move_vertices(self, every, voxels):
        moved = [(tuple(a + voxels * H * b for a, b in zip(p, n)) if i % every == 0 else p, n)
                 for i, (p, n) in enumerate(self.mesh["vertices"])]
        return {"vertices": moved, "triangles": self.mesh["triangles"]}

    def test_vertices_off_the_surface(self):
        self.assert_agrees(self.kernels, self.report, self.move_vertices(1, 0.01))
        self.assert_agrees(self.kernels, self.report, self.move_vertices(200, 0.05))
        for every in (1, 50):
            self.assert_differs("vertex distance, voxels, 99%", self.kernels, self.report,
                                self.move_vertices(every, 0.05))

    def test_normals(self):
        vertices = self.mesh["vertices"]
        self.mesh["vertices"] = [(p, tuple(-x for x in n)) for p, n in vertices]
        self.assert_differs("normal angle, degrees, 99%", self.kernels, self.report, self.mesh)
        self.mesh["vertices"] = [(p, tuple(2 * x for x in n)) for p, n in vertices]
        self.assert_differs("normal length error, largest", self.kernels, self.report, self.mesh)

    def test_half_the_volume(self):
        self.mesh = ellipsoid_mesh(self.kernels[0], 0.5 * self.scale)
        self.assert_differs("mesh volume, voxels", self.kernels, self.report, self.mesh)


class ThreeInARow(RecountTest):
    """The centres are 0.6 R_max apart. N_iso is 1 + 0.64^2 at the ends and 1 + 2 * 0.64^2 in the
    middle, sqrt 2 deviations above the mean, so Eq. (8)'s weight there is sqrt 2 / 2."""

    R_MAX, LEAF_U, LEAF_V = 1.5, 0.9, 0.6

    def setUp(self):
        self.leaves = [Kernel((x, 0.1, 0.2), (self.LEAF_U, self.LEAF_V, 0.5 * self.LEAF_V),
                              tilted_frame()) for x in (-0.9, 0, 0.9)]
        weight = math.sqrt(2) / 2
        controlled = [self.R_MAX + (r - self.R_MAX) * weight for r in self.leaves[1].radii]
        end = [self.R_MAX] * 3
        self.kernels = [Kernel(leaf.centre, radii, leaf.frame, density) for leaf, radii, density in
                        zip(self.leaves, (end, controlled, end), (1.4096, 1.8192, 1.4096))]
        self.threshold = 1.3
        inside, on = count_cells(
            lambda p: density(self.kernels, [H * i for i in p]) >= self.threshold, 13)
        off_site = sum(density(self.kernels, k.centre) < self.threshold for k in self.kernels)
        sampled = sum(trilinear(self.kernels, k.centre) < self.threshold for k in self.kernels)
        held = sum(self.touches(k.centre) for k in self.kernels)
        self.report = make_report("controlled", self.kernels, self.R_MAX, self.threshold, inside,
                                  on, inside + on - held, off_site_exact=off_site,
                                  off_site_sampled=sampled)

    def touches(self, p):
        return any(density(self.kernels, q) >= self.threshold for q, _ in corners(p))

    def test_agrees(self):
        self.assertEqual(self.report["metrics"]["off_site_exact"], 2)
        self.assert_agrees_exactly(self.kernels, self.report, leaf_kernels=self.leaves)

    def test_every_doctored_number_differs(self):
        self.assert_every_doctored_number_differs(self.kernels, self.report, METRIC_ROWS)

    def test_variance_reading(self):
        self.report["parameters"]["spread"] = "variance"
        self.assert_differs("p2", self.kernels, self.report)

    def test_coverage(self):
        self.report["parameters"]["coverage"] = 1 / 3
        self.assert_agrees(self.kernels, self.report)
        self.report["parameters"]["coverage"] = 0.92
        self.assert_differs("coverage", self.kernels, self.report)

    def test_threshold_percent(self):
        percent = 100 * self.threshold / self.report["density"]["mean"]
        self.report["parameters"]["threshold_percent"] = percent
        self.assert_agrees(self.kernels, self.report)
        self.report["parameters"]["threshold_percent"] = percent + 0.1
        self.assert_differs("threshold by percent", self.kernels, self.report)

    def test_band_by_shares(self):
        parameters, density = self.report["parameters"], self.report["density"]
        for end, share, value in (("low", 0, min), ("high", 100, max)):
            parameters[f"band_{end}"] = None
            parameters[f"band_{end}_percent"] = share
            self.assert_differs("p1" if end == "low" else "p2", self.kernels, self.report)
            density["p1" if end == "low" else "p2"] = value(k.density for k in self.kernels)
        rows = self.run_recount(self.kernels, self.report).stdout.splitlines()
        told = {line[:34].strip() for line in rows if "DIFFERS" not in line}
        self.assertLessEqual({"p1", "p2"}, told)

    def test_density_property(self):
        self.kernels[0].density *= 1.0001
        self.assert_differs("N_iso, largest relative error", self.kernels, self.report)

    def test_density_from_the_grid_is_another(self):
        self.report["parameters"]["density"] = "grid"
        self.assert_differs("N_iso, largest relative error", self.kernels, self.report)

    def test_radii_off_equation_8(self):
        for index in (0, 1):
            kernels = copy.deepcopy(self.kernels)
            ru, rv, rn = kernels[index].radii
            kernels[index].radii = (ru, rv, rn * 1.001)
            self.assert_differs("kernels off Eqs. 7 and 8", kernels, self.report)
        self.leaves[1].radii = (self.LEAF_U * 1.001, self.LEAF_V, 0.5 * self.LEAF_V)
        self.assert_differs("kernels off Eq. 8 by leaf radii", self.kernels, self.report,
                            leaf_kernels=self.leaves)


class DensityFromTheGrid(RecountTest):
    def test_interpolated_density(self):
        kernels = [Kernel((x, 0.1, 0.2), (1.5, 1.5, 1.5)) for x in (-0.9, 0, 0.7)]
        for kernel in kernels:
            kernel.density = trilinear(kernels, kernel.centre)
        report = make_report("isotropic", kernels, 1.5, 10, 0, 0, 0, off_site_exact=3,
                             off_site_sampled=3)
        report["parameters"]["density"] = "grid"
        self.assert_agrees(kernels, report)
        report["parameters"]["density"] = "exact"
        self.assert_differs("N_iso, largest relative error", kernels, report)


if __name__ == "__main__":
    RECOUNT = sys.argv.pop(1)
    unittest.main()
