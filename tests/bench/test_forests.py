# SPDX-License-Identifier: Apache-2.0
import argparse
import json
import pathlib
import stat
import struct
import sys
import tempfile
import unittest
from unittest import mock

import contenders as who
import forest_plan
import forests
import plan
import report
import targets
from card_tree import LEAVES, card_tree
from contender import Unavailable, complaint
from heat import Heat, Limits
from records import Results
from test_results import results_of

FAKE = pathlib.Path(__file__).with_name("fake_leafhull.py")
MIB = 2**20


def canopies(seconds, peak):
    """Results whose `seconds` and `peak` are functions of the number of trees."""
    values = {}
    for count in forest_plan.SERIES:
        key = (f"forest-birch-{count}", forest_plan.CANOPY)
        values[*key, "total"] = [seconds(count)]
        values[*key, "peak_memory_bytes"] = [peak(count)]
        values[*key, "leaf_vertices"] = [50_000 * count]
        values[*key, "written_bytes"] = [MIB * count]
    return values


class TargetsTest(unittest.TestCase):
    def target(self, what, values):
        found = targets.targets(results_of(values, {"forests": True}))
        return next(t for t in found if what in t.what)

    def test_rate_and_memory_are_of_the_largest(self):
        values = canopies(lambda n: 20 * n / 1000, lambda n: (3 if n == 20_000 else 5) * 2**30)
        self.assertEqual(self.target("20,000 trees", values).measured, {"20,000 trees": 2.5})
        self.assertIs(self.target("20,000 trees", values).met, False)
        self.assertIs(self.target("memory of that", values).met, True)

    def test_a_line_with_a_fixed_cost_is_linear(self):
        straight = canopies(lambda n: 2 + 0.02 * n, lambda n: MIB)
        self.assertIs(self.target("departure", straight).met, True)
        bent = canopies(lambda n: n**1.3, lambda n: MIB)
        self.assertIs(self.target("departure", bent).met, False)

    def test_a_tree_may_take_a_hundred_bytes(self):
        flat = canopies(lambda n: n, lambda n: 300 * MIB + 100 * n)
        grown = self.target("growth", flat)
        self.assertEqual(list(grown.measured)[0], "2,000 trees")
        self.assertLess(max(abs(value) for value in grown.measured.values()), 1e-9)
        steep = canopies(lambda n: n, lambda n: 300 * MIB + 1000 * n)
        self.assertAlmostEqual(
            self.target("growth", steep).measured["20,000 trees"],
            100 * 900 * 19_000 / (300 * MIB + 1_000_000),
        )
        self.assertIs(self.target("growth", steep).met, False)

    def test_ranks_and_instances(self):
        case = "forest-birch-2000"
        values = {
            (case, forest_plan.ONE_RANK, "total"): [10, 12, 11],
            (case, forest_plan.TWO_RANKS, "total"): [12, 13, 11],
            ("forest-30-models-1000000", forest_plan.INSTANCED, "total"): [61],
        }
        self.assertEqual(self.target("2 ranks", values).measured, {case: 12 / 11})
        self.assertIs(self.target("2 ranks", values).met, True)
        self.assertIs(self.target("30 models", values).met, False)
        self.assertIsNone(self.target("departure", values).met)

    def test_fewer_or_smaller_forests_meet_no_target(self):
        values = canopies(lambda n: n, lambda n: MIB)
        for part in ("total", "peak_memory_bytes"):
            del values["forest-birch-20000", forest_plan.CANOPY, part]
        values["forest-3-models-1000", forest_plan.INSTANCED, "total"] = [1]
        for name in (forest_plan.ONE_RANK, forest_plan.TWO_RANKS):
            values["forest-birch-200", name, "total"] = [1]
        for target in targets.targets(results_of(values, {"forests": True})):
            self.assertIsNone(target.met, target.what)

    def test_trees_one_by_one_have_targets_of_their_own(self):
        self.assertFalse(any("canopy" in t.what for t in targets.targets(results_of({}))))


class CardTreeTest(unittest.TestCase):
    def test_is_a_glb_and_another_for_each_seed(self):
        data = card_tree(3)
        magic, version, size = struct.unpack_from("<4sII", data)
        self.assertEqual((magic, version, size), (b"glTF", 2, len(data)))
        text = struct.unpack_from("<I", data, 12)[0]
        positions, indices = json.loads(data[20 : 20 + text])["accessors"]
        self.assertEqual((positions["count"], indices["count"]), (4 * LEAVES, 6 * LEAVES))
        self.assertEqual(data, card_tree(3))
        self.assertNotEqual(data, card_tree(4))


class RunTest(unittest.TestCase):
    """A bench of forests with a fake leafhull."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        leafhull = self.folder / "leafhull"
        leafhull.write_text(f"#!/bin/sh\nexec {sys.executable} {FAKE} \"$@\"\n")
        leafhull.chmod(leafhull.stat().st_mode | stat.S_IXUSR)
        tree = self.folder / "shared/birch.glb"
        tree.parent.mkdir()
        tree.write_bytes(bytes(500))
        for module, name, value in (
            (who, "LEAFHULL", leafhull),
            (plan, "CASES", self.folder / "cases"),
            (plan, "SHARED", tree.parent),
        ):
            patch = mock.patch.object(module, name, value)
            patch.start()
            self.addCleanup(patch.stop)
        for made in (forest_plan.make, forest_plan.file_of, forest_plan.leaf_vertices):
            made.cache_clear()
            self.addCleanup(made.cache_clear)

    def run_heat(self, entrants):
        results = Results(about={"absent": []})
        Heat(Limits(rounds=2, seconds=30), results).run(entrants)
        return results

    def test_a_canopy_is_measured_whole(self):
        entrant = forest_plan.canopy(40)
        results = self.run_heat([entrant])
        self.assertEqual(results.about["absent"], [])
        self.assertEqual(results.median(*entrant[:2], "leaf_vertices"), 40 * 500)
        self.assertEqual(results.median(*entrant[:2], "written_bytes"), 1000)
        self.assertGreater(results.median(*entrant[:2], "peak_memory_bytes"), 200 * MIB)
        self.assertGreater(results.median(*entrant[:2], "total"), 0.01)

    def test_nothing_is_left_of_a_forest(self):
        entrant = forest_plan.canopy(40)
        self.run_heat([entrant])
        scene = plan.CASES / entrant.case
        self.assertEqual([file.name for file in scene.iterdir()], ["scene.csv"])

    def test_models_are_made_and_counted(self):
        entrant = forest_plan.instanced(3, 8)
        results = self.run_heat([entrant])
        sizes = [len(card_tree(seed)) for seed in range(3)]
        expected = 3 * (sizes[0] + sizes[1]) + 2 * sizes[2]
        self.assertEqual(results.median(*entrant[:2], "leaf_vertices"), expected)

    def test_an_error_is_the_reason(self):
        scene = forest_plan.Scene("forest-broken-1", (str(plan.SHARED / "birch.glb"),), 1)
        results = self.run_heat([forest_plan.entrant(scene, "canopy", ())])
        (absent,) = results.about["absent"]
        self.assertEqual(absent["reason"], "status 1: leafhull: the roof fell in")

    def test_leafhulls_own_line_is_the_reason(self):
        said = "leafhull: error: too little memory\n-----\nmpirun: a process has ended\n"
        self.assertEqual(complaint(said), "leafhull: error: too little memory")
        self.assertEqual(complaint("\nSegmentation fault\n"), "Segmentation fault")

    def test_ranks_are_started_by_mpirun(self):
        (_, two) = forest_plan.ranks(10)
        started = []

        def measured(command, environment):
            started.append(command)
            raise Unavailable("enough seen")

        with mock.patch("commands.measure", measured):
            self.run_heat([two])
        self.assertEqual(started[0][:3], ["mpirun", "-n", "2"])
        self.assertIn("--threads", started[0])

    def test_a_stand_in_is_named_and_has_voxels_of_its_own(self):
        with mock.patch.object(plan, "SHARED", pathlib.Path("/nowhere")):
            self.assertEqual(forest_plan.stand_ins(), {"birch": "ash"})
            self.assertEqual(forest_plan.canopy(10).case, "forest-ash-10")

    def test_the_page_of_a_quick_bench(self):
        results = Results(
            about={"absent": [], "date": "2026-11-25", "machine": {"CPU": "Abacus"}}
            | {"stand_ins": {}, "cases": {}, "forests": True}
        )
        for job in forest_plan.quick_jobs():
            chosen = [e for e in job.entrants if e.name != forest_plan.TWO_RANKS]
            Heat(job.limits, results).run(chosen)
        page = report.page(results)
        self.assertIn("| forest-birch-200, canopy, 2 threads | 0.100 |", page)
        self.assertIn("at most 60 s", page)
        self.assertNotIn("voxels along the longest side", page)


class PlanTest(unittest.TestCase):
    def names(self, jobs):
        return [(e.case, e.name) for job in jobs for e in job.entrants]

    def test_the_series_is_whole_and_nobody_runs_twice(self):
        names = self.names(forest_plan.jobs())
        self.assertEqual(len(names), len(set(names)))
        for count in forest_plan.SERIES:
            self.assertIn((forest_plan.stand(count).name, forest_plan.CANOPY), names)
        self.assertIn(("forest-30-models-1000000", forest_plan.INSTANCED), names)

    def test_ranks_take_turns(self):
        (job,) = [j for j in forest_plan.jobs() if len(j.entrants) == 2 and "rank" in str(j)]
        self.assertEqual(
            [e.name for e in job.entrants], [forest_plan.ONE_RANK, forest_plan.TWO_RANKS]
        )

    def test_forests_are_asked_for(self):
        with mock.patch.dict(sys.modules, {"plot": mock.Mock()}):  # needs matplotlib
            import run

        asked = argparse.Namespace(quick=True, forest=False, case="")
        self.assertFalse(any("forest" in case for case, _ in self.names(run.jobs(asked))))
        asked = argparse.Namespace(quick=True, forest=True, case="200$")
        self.assertEqual(
            {case for case, _ in self.names(run.jobs(asked))}, {forest_plan.stand(200).name}
        )


if __name__ == "__main__":
    unittest.main()
