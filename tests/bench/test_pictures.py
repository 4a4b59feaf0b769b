# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
import unittest
from unittest import mock

import contenders
import pictures
import plan
import report
import targets
from test_results import results_of

CASE = "pictures-birch"
MIB = 2**20


def measured(on_gpu=0):
    values = {}
    for name, (surface, look, size) in contenders.PICTURES.items():
        rays = (size / 1024) ** 2 * (0.5 if surface == "direct" else 0.25)
        paint = {"phong": 0.05, "watercolour": 0.5}[look]
        stages = {"hash": 0.01, "field": 0.02, "scene": 0.05, "rays": rays, "paint": paint}
        for stage, seconds in stages.items():
            values[CASE, name, f"stages: {stage}"] = [seconds]
        total = sum(stages.values())
        values[CASE, name, "total"] = [total, 2 * total, total]
        values[CASE, name, "redraw_seconds"] = [rays + paint / 2]
        values[CASE, name, "repaint_seconds"] = [paint / 2]
        values[CASE, name, "peak_memory_bytes"] = [100 * MIB + 100 * size**2]
        values[CASE, name, "on_gpu"] = [on_gpu]
    return results_of(values)


class PicturesTest(unittest.TestCase):
    def test_direct_over_mesh_is_of_whole_runs(self):
        (ratio,) = pictures.direct_over_mesh(measured()).values()
        self.assertAlmostEqual(ratio, 0.63 / 0.38)

    def test_the_passes_of_a_watercolour_are_its_stage_that_paints(self):
        passes = pictures.watercolour_passes(measured())
        self.assertEqual(passes, {"birch, first picture": 500, "birch, next picture": 250})

    def test_bytes_are_of_further_pixels(self):
        self.assertEqual(
            pictures.bytes_per_pixel(measured()),
            {"birch, 512 to 1024": 100, "birch, 1024 to 2048": 100},
        )

    def test_frames_are_counted_on_a_gpu_alone(self):
        self.assertEqual(pictures.frames_on_gpu(measured()), {})
        (frames,) = pictures.frames_on_gpu(measured(on_gpu=1)).values()
        self.assertAlmostEqual(frames, 1 / 0.525)

    def test_a_row_parts_the_surface_from_the_drawing(self):
        self.assertIn(
            "| direct phong, 1024x1024 | 630 (630 to 1,260) | 30.0 | 50.0 | 500 | 50.0 "
            "| 525 (one run) | 200 |",
            list(pictures.section(measured())),
        )

    def test_nothing_is_said_of_pictures_that_were_not_drawn(self):
        results = results_of({})
        self.assertEqual(list(pictures.section(results)), [])
        self.assertIsNone(self.target("redraws", results).met)

    def test_their_stages_stay_out_of_the_table_of_extractions(self):
        results = measured()
        name = contenders.OURS[0]
        case = "birch-128-painterly"
        more = results_of(
            {(case, name, "total"): [0.1], (case, name, "stages: hash"): [0.01]}
        ).records
        results.records += more
        results.about["cases"] = {case: {"resolution": 128, "style": "painterly"}}
        self.assertNotIn("rays", " ".join(report.stages_section(results)))

    def test_targets(self):
        results = measured()
        self.assertIs(self.target("over extracting", results).met, True)
        self.assertIs(self.target("passes", results).met, False)
        self.assertIs(self.target("each of its pixels", results).met, True)

    def target(self, what, results):
        return next(t for t in targets.targets(results) if what in t.what)


class PicturePlanTest(unittest.TestCase):
    def heats(self):
        """The heats that `--case pictures` runs, with only their matching entries."""
        found = ([e for e in heat if re.search("pictures", e.case)] for heat in plan.heats())
        return [heat for heat in found if heat]

    def test_they_can_be_run_alone_and_side_by_side(self):
        (heat,) = self.heats()
        self.assertEqual([e.name for e in heat], list(contenders.PICTURES))

    def test_memory_is_told_at_every_size(self):
        for size in contenders.PICTURE_SIZES:
            self.assertIn(contenders.picture("direct", "phong", size), contenders.PICTURES)

    def test_a_stand_in_is_named(self):
        with mock.patch.object(plan, "SHARED", pathlib.Path("/nowhere")):
            (heat,) = self.heats()
            self.assertEqual({e.case for e in heat}, {"pictures-synthetic-56740"})


if __name__ == "__main__":
    unittest.main()
