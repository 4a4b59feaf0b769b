# SPDX-License-Identifier: Apache-2.0
import pathlib
import unittest
from unittest import mock

import contenders
import plan


def entrants():
    heats = [*plan.heats(), *plan.surveys(), *plan.quick_heats(), *plan.quick_surveys()]
    return [entrant for heat in heats for entrant in heat]


class PlanTest(unittest.TestCase):
    def test_every_contender_can_be_started_and_takes_part(self):
        not_waiting = {plan.CACHED, plan.FRESH, *contenders.SURVEYS}
        self.assertEqual({e.name for e in entrants()} - not_waiting, set(contenders.COMMANDS))

    def test_nobody_enters_a_heat_twice(self):
        for heat in plan.heats():
            keys = [(entrant.case, entrant.name) for entrant in heat]
            self.assertEqual(len(keys), len(set(keys)))

    def test_leafhull_runs_on_every_tree_at_every_size(self):
        run = {(e.case, e.name) for heat in plan.heats() for e in heat}
        for tree in plan.TREES:
            source = pathlib.Path(plan.source_of(tree)).stem.replace(":", "-")
            for resolution in plan.RESOLUTIONS:
                for style in plan.STYLES:
                    for name in (*contenders.OURS, *contenders.PUBLISHED):
                        self.assertIn((f"{source}-{resolution}-{style}", name), run)

    def test_a_tree_that_is_not_here_has_a_stand_in_of_another_name(self):
        with mock.patch.object(plan, "SHARED", pathlib.Path("/nowhere")):
            self.assertEqual(plan.stand_ins(), plan.STAND_INS)
            self.assertNotIn("birch-128-painterly", {e.case for e in entrants()})
            self.assertIn("synthetic-56740-128-painterly", {e.case for e in entrants()})
            self.assertIn("ash-128-painterly", {e.case for e in entrants()})


if __name__ == "__main__":
    unittest.main()
