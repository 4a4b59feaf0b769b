# SPDX-License-Identifier: Apache-2.0
import pathlib
import tempfile
import unittest

import limit
import plan
import report
import slopes
import targets
from records import WARM_UP, Record, Results, load

CASE = "birch-128-painterly"


def results_of(values, about=None):
    """`values` holds a list of values for each case, contender and part."""
    records = [
        Record(case, contender, "1", number, part, value, "s")
        for (case, contender, part), rounds in values.items()
        for number, value in enumerate(rounds, WARM_UP + 1)
    ]
    return Results(records, about)


class RecordsTest(unittest.TestCase):
    def test_come_back_as_they_were_saved(self):
        results = results_of({(CASE, "a, b", "total"): [0.125, 3]}, {"date": "today"})
        with tempfile.TemporaryDirectory() as folder:
            results.save(pathlib.Path(folder, "stem"))
            again = load(pathlib.Path(folder, "stem"))
        self.assertEqual(again.records, results.records)
        self.assertEqual(again.about, results.about)

    def test_ratios_are_of_medians(self):
        results = results_of({(CASE, "a", "total"): [6, 1, 9], (CASE, "b", "total"): [2, 2, 8]})
        self.assertEqual(results.ratio(CASE, "a", "b", "total"), 3)
        self.assertIsNone(results.ratio(CASE, "a", "nobody", "total"))


class SlopesTest(unittest.TestCase):
    def test_a_line_with_a_fixed_cost_is_a_line(self):
        points = {count: 0.5 + 2e-6 * count for count in plan.SERIES}
        self.assertAlmostEqual(slopes.departure_from_line(points), 0)

    def test_a_parabola_is_none(self):
        points = {count: count**2 for count in plan.SERIES}
        self.assertGreater(slopes.departure_from_line(points), 0.5)

    def test_a_fixed_cost_is_not_negative(self):
        # They lie on the line 2 x - 10, but a fixed cost may not be negative.
        points = {10: 10, 20: 30, 30: 50}
        self.assertGreater(slopes.departure_from_line(points), 0.2)

    def test_memory_beside_the_mesh(self):
        name = "leafhull isotropic"
        values = {}
        voxels = {f"birch-{n}-painterly": n**2 for n in plan.RESOLUTIONS}
        leaf_vertices = {plan.series_case(n).name: n for n in plan.SERIES}
        for case in (*voxels, *leaf_vertices):
            evaluated = voxels.get(case, 1000)
            mesh = 24 * 10 + 12 * 20
            peak = 5e6 + mesh + 11 * evaluated + 150 * leaf_vertices.get(case, 0)
            values[case, name, "vertices"] = [10]
            values[case, name, "faces"] = [20]
            values[case, name, "evaluated_voxels"] = [evaluated]
            values[case, name, "peak_memory_bytes"] = [peak]
        results = results_of(values)
        per_voxel = slopes.bytes_per_voxel(results, "birch", name)
        self.assertAlmostEqual(per_voxel, 11)
        self.assertAlmostEqual(slopes.bytes_per_leaf_vertex(results, name, per_voxel), 150)
        self.assertIsNone(slopes.bytes_per_voxel(results, "ash", name))


class TargetsTest(unittest.TestCase):
    def target(self, what, values):
        return next(t for t in targets.targets(results_of(values)) if what in t.what)

    def test_met_means_every_value(self):
        blender = {}
        for tree, seconds in {"birch": 6, "ash": 5, "aspen-52648": 7}.items():
            blender[f"{tree}-128-painterly", "Blender", "total"] = [seconds]
            blender[f"{tree}-128-painterly", "leafhull isotropic", "total"] = [1]
        self.assertIs(self.target("Blender", blender).met, True)
        blender["ash-128-painterly", "Blender", "total"] = [4.9]
        self.assertIs(self.target("Blender", blender).met, False)

    def test_at_most(self):
        seconds = {("startup-bush-draft", plan.CACHED, "total"): [0.16, 0.14, 0.15]}
        self.assertIs(self.target("kernels cached", seconds).met, True)
        seconds["startup-bush-draft", plan.CACHED, "total"] = [0.16, 0.14, 0.16]
        self.assertIs(self.target("kernels cached", seconds).met, False)

    def test_what_was_not_measured_is_not_met(self):
        self.assertIsNone(self.target("Blender", {}).met)


class LimitTest(unittest.TestCase):
    def test_shares_and_pairs_are_of_the_field(self):
        name = "bench_limit isotropic"
        results = results_of(
            {
                (CASE, name, "fma_gflops"): [200],
                (CASE, name, "bandwidth_gbs"): [30],
                (CASE, name, "stages: field: device_seconds"): [0.01],
                (CASE, name, "stages: field: pairs_inside"): [5e7],
                (CASE, name, "stages: field: pairs_evaluated"): [1e8],
                (CASE, name, "stages: field: gflops"): [90],
                (CASE, name, "stages: field: share_of_peak"): [0.45],
            }
        )
        self.assertEqual(limit.percent_of_peak(results), {"birch isotropic": 45})
        self.assertEqual(limit.pairs_per_inside(results), {"birch isotropic": 2})
        self.assertIn(
            "| birch isotropic, field | 10.0 | 10.0 | 2.00 | 90.0 | 45.0 |",
            list(limit.section(results)),
        )


class ReportTest(unittest.TestCase):
    def setUp(self):
        about = {
            "date": "2026-11-22",
            "machine": {"CPU": "Abacus", "cores": "2"},
            "stand_ins": {"aspen-52648": "synthetic:52648"},
            "cases": {
                name: {"resolution": resolution, "style": "painterly", "count": 9}
                for name, resolution in ((CASE, 128), ("birch-256-painterly", 256))
            },
            "absent": [{"case": CASE, "contender": "CGAL alpha_wrap_3", "reason": "no CGAL"}],
        }
        self.page = report.page(
            results_of(
                {
                    (CASE, "leafhull isotropic", "total"): [0.04, 0.05, 0.07],
                    (CASE, "Blender", "total"): [0.3],
                    ("birch-256-painterly", "leafhull isotropic", "total"): [0.2, 0.2, 0.2],
                },
                about,
            )
        ).splitlines()

    def test_a_cell_has_median_spread_and_ratio(self):
        self.assertIn(
            "| leafhull isotropic | 50.0 (40.0 to 70.0), 1.00x | 200 (200 to 200), 1.00x |",
            self.page,
        )

    def test_a_size_that_was_not_run_says_so(self):
        self.assertIn("| Blender | 300 (one run), 6.00x | not run |", self.page)

    def test_who_could_not_be_run_is_listed_with_the_reason(self):
        self.assertIn(f"| CGAL alpha_wrap_3 | no CGAL | {CASE} |", self.page)

    def test_a_tree_that_is_not_here_is_said_loudly(self):
        self.assertIn(
            "**There was no aspen-52648 here: synthetic:52648 ran in its place.**", self.page
        )


if __name__ == "__main__":
    unittest.main()
