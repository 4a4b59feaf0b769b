# SPDX-License-Identifier: Apache-2.0
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import contender
from contender import Contender, Unavailable
from heat import Entrant, Heat, Limits
from records import Results

FAKE = pathlib.Path(__file__).with_name("fake_contender.py")


class FakeTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.log = pathlib.Path(folder.name, "log")
        self.log.touch()

    def start(self, name="A", fault=""):
        return Contender([sys.executable, str(FAKE), name, str(self.log), fault])


class ContenderTest(FakeTest):
    def assert_unavailable(self, reason, act):
        with self.assertRaises(Unavailable) as caught:
            act()
        self.assertRegex(str(caught.exception), reason)

    def test_answers_every_run(self):
        fake = self.start()
        self.addCleanup(fake.stop)
        self.assertEqual((fake.version, fake.setup), ("7", {"open": 0.5}))
        self.assertEqual([fake.run()["total"] for _ in range(3)], [2, 3, 4])
        self.assertGreater(fake.run()["peak_memory_bytes"], 2**20)

    def test_an_error_is_the_reason(self):
        self.assert_unavailable("^out of order$", lambda: self.start(fault="refuse"))

    def test_the_last_words_are_the_reason(self):
        fake = self.start(fault="crash:1")
        self.addCleanup(fake.stop)
        self.assert_unavailable("^ended with status 1: the roof fell in$", fake.run)

    def test_what_is_not_there_is_said(self):
        self.assert_unavailable(
            "^no-such-program is not there$", lambda: Contender(["/nowhere/no-such-program"])
        )

    def test_nobody_waits_for_ever(self):
        with mock.patch.object(contender, "ANSWER_SECONDS", 0.3):
            self.assert_unavailable("^no answer within 0.3 s$", lambda: self.start(fault="mute"))


class HeatTest(FakeTest):
    def heat(self, entrants, rounds=3):
        results = Results(about={"absent": []})
        Heat(Limits(rounds=rounds, seconds=30), results).run(
            [Entrant("case", n, lambda n=n, f=f: self.start(n, f)) for n, f in entrants.items()]
        )
        return results

    def test_takes_turns(self):
        self.heat({"A": "", "B": "", "C": ""}, rounds=2)
        self.assertEqual(self.log.read_text(), "ABC" * 3)

    def test_medians_leave_the_warm_up_out(self):
        results = self.heat({"A": ""})
        self.assertEqual(results.values("case", "A", "total"), [3, 4, 5])
        self.assertEqual(results.median("case", "A", "total"), 4)

    def test_records_every_number_with_its_unit(self):
        results = self.heat({"A": ""}, rounds=1)
        units = {r.part: r.unit for r in results.records}
        self.assertEqual(
            units,
            {
                "setup: open": "s",
                "field": "s",
                "total": "s",
                "vertices": "",
                "stages: hash": "s",
                "peak_memory_bytes": "bytes",
            },
        )

    def test_the_slow_run_fewer_rounds(self):
        results = self.heat({"A": "", "B": "slow"})
        self.assertEqual(self.log.read_text(), "AB" + "AB" + "A" + "A")
        self.assertEqual(len(results.values("case", "B", "total")), 1)

    def test_who_fails_is_noted_and_the_others_go_on(self):
        results = self.heat({"A": "refuse", "B": "crash:2", "C": ""})
        self.assertEqual(self.log.read_text(), "BCCCC")
        reasons = {entry["contender"]: entry["reason"] for entry in results.about["absent"]}
        self.assertEqual(
            reasons, {"A": "out of order", "B": "ended with status 1: the roof fell in"}
        )


if __name__ == "__main__":
    unittest.main()
