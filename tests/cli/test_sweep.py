# SPDX-License-Identifier: Apache-2.0
import csv
import json
import os
import signal
import subprocess
import time

from command import ASH, CommandTest

COARSE = ("--preset", "paper-32")
METRICS = "dilated_voxels inside_voxels on_voxels off_site_exact off_site_sampled".split()
COUNTS = "components mesh_vertices mesh_triangles leaves leaf_vertices".split()
NINE = ("--threshold", "1:3:1", "--radius-max", "1.5,2.5,4", "--preset", "draft")


def listen_to_interrupts():
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


class SweepTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.sweep = self.out / "sweep"

    def table(self, folder=None):
        with open((folder or self.sweep) / "sweep.csv", newline="") as file:
            return list(csv.DictReader(file))

    def files(self, folder=None):
        folder = folder or self.sweep
        return sorted(str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file())

    def run_sweep(self, *flags, tree=None, **options):
        return self.succeed("sweep", tree or self.tree, *flags, "-o", self.sweep, **options)


class Results(SweepTest):
    def test_every_row_is_a_single_extraction(self):
        self.run_sweep(
            "--method", "isotropic,uncontrolled,controlled", "--threshold", "1,1.5",
            "--radius-max", "2:4:2", *COARSE, tree=ASH,
        )  # fmt: skip
        rows = self.table()
        self.assertEqual(len(rows), 12)
        for row in rows:
            single = json.loads(
                self.succeed(
                    "extract", ASH, *COARSE, "--report", "-", "--method", row["method"],
                    "--threshold", row["threshold"], "--radius-max", row["radius_max"],
                ).stdout
            )  # fmt: skip
            self.assertEqual(float(row["T"]), single["parameters"]["threshold"])
            for part, keys in (("metrics", METRICS), ("counts", COUNTS)):
                for key in keys:
                    self.assertEqual(int(row[key]), single[part][key], (key, row))
            for key in ("mean", "variance", "p1", "p2"):
                self.assertEqual(float(row["density_" + key]), single["density"][key])

    def test_coverage_gives_the_threshold_of_a_single_extraction(self):
        self.run_sweep("--coverage", "0.8:0.9:0.1", *COARSE, tree=ASH)
        for row in self.table():
            report = self.succeed(
                "extract", ASH, *COARSE, "--report", "-", "--coverage", row["coverage"]
            )
            self.assertEqual(
                float(row["T"]), json.loads(report.stdout)["parameters"]["threshold"]
            )

    def test_rows_are_in_the_order_of_the_options_whatever_was_typed_first(self):
        self.run_sweep("--radius-max", "3,2", "--threshold", "2,1", *COARSE)
        order = [(row["threshold"], row["radius_max"]) for row in self.table()]
        self.assertEqual(order, [("2", "3"), ("2", "2"), ("1", "3"), ("1", "2")])

    def test_the_folder(self):
        result = self.run_sweep("--threshold", "1,2", "--method", "isotropic,controlled", *COARSE)
        self.assertEqual(result.stdout, "")
        self.assertIn("4 combinations", result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        pictures = [name for name in self.files() if name.startswith("pictures/")]
        self.assertEqual(pictures[0], "pictures/1-method-isotropic-threshold-1.png")
        self.assertEqual([row["picture"] for row in self.table()], pictures)
        self.assertEqual(
            set(self.files()) - set(pictures),
            {"contact-sheet.png", "plot-threshold.svg", "sweep.csv", "sweep.json", "sweep.jsonl"},
        )
        for name in [*pictures, "contact-sheet.png"]:
            self.assertEqual((self.sweep / name).read_bytes()[:4], b"\x89PNG")
        self.assertIn("<svg", (self.sweep / "plot-threshold.svg").read_text())

    def test_json(self):
        self.run_sweep("--threshold", "30%:60%:30%", *COARSE)
        page = json.loads((self.sweep / "sweep.json").read_text())
        self.assertEqual(page["schema"], "leafhull-sweep/1")
        self.assertEqual(page["input"], str(self.tree))
        self.assertEqual(page["command"][1], "sweep")
        self.assertEqual(page["swept"], ["threshold-percent"])
        self.assertEqual(page["options"]["threshold_percent"], [30, 60])
        self.assertEqual(len(page["rows"]), 2)
        for row, line in zip(page["rows"], self.table()):
            self.assertEqual(row["parameters"]["method"], "controlled")
            percent = row["parameters"]["threshold_percent"]
            self.assertAlmostEqual(
                row["parameters"]["threshold"], percent / 100 * row["density"]["mean"]
            )
            self.assertEqual(row["metrics"]["dilated_voxels"], int(line["dilated_voxels"]))
            self.assertEqual(row["seconds"]["total"], float(line["seconds_total"]))

    def test_a_combination_without_a_surface_is_a_row(self):
        result = self.run_sweep("--threshold", "1,1e6", "--points", "vertices", *COARSE)
        self.assertIn("1 without a surface", result.stderr)
        some, none = self.table()
        self.assertEqual((some["empty"], none["empty"]), ("false", "true"))
        self.assertEqual((float(none["T"]), none["components"]), (1e6, "0"))
        self.assertEqual(none["off_site_exact"], none["leaf_vertices"])

    def test_a_combination_that_does_not_fit_is_a_row(self):
        result = self.run_sweep("--threshold", "1", "--resolution", "16,900000,20")
        self.assertIn("1 that failed", result.stderr)
        some, none, other = self.table()
        self.assertIn("GiB", none["failure"])
        self.assertEqual((none["T"], none["dilated_voxels"]), ("", ""))
        self.assertEqual((some["failure"], other["failure"]), ("", ""))
        again = self.run_sweep("--threshold", "1", "--resolution", "16,900000,20")
        self.assertIn("2 of 3 done", again.stderr)

    def test_a_range_of_one_value(self):
        self.run_sweep("--threshold", "2:2:1", *COARSE)
        self.assertEqual([row["threshold"] for row in self.table()], ["2"])

    def test_quiet_and_verbose(self):
        self.assertEqual(self.run_sweep("--threshold", "1,2", "-q", *COARSE).stderr, "")
        again = self.run_sweep("--threshold", "1,2", "-v", *COARSE)
        self.assertIn("device ", again.stderr)

    def test_threads_do_not_change_the_table(self):
        flags = ("--threshold", "1,2", "--radius-max", "2,3", *COARSE)
        self.run_sweep(*flags, "--threads", "1")
        first = timeless(self.table())
        self.run_sweep(*flags, "--restart")
        self.assertEqual(timeless(self.table()), first)


def timeless(rows):
    return [{k: v for k, v in row.items() if not k.startswith("seconds")} for row in rows]


class Resuming(SweepTest):
    def start(self, folder):
        return subprocess.Popen(
            [os.environ["LEAFHULL"], "sweep", str(ASH), *NINE, "-o", str(folder)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=listen_to_interrupts,
        )

    def rows_done(self, folder):
        journal = folder / "sweep.jsonl"
        return max(0, journal.read_bytes().count(b"\n") - 1) if journal.exists() else 0

    def cut_off(self, number):
        """A sweep that got the signal after at least two rows, and what it printed."""
        for attempt in range(10):
            folder = self.out / f"cut-{number}-{attempt}"
            process = self.start(folder)
            while process.poll() is None and self.rows_done(folder) < 2:
                time.sleep(0.0005)
            process.send_signal(number)
            _, text = process.communicate(timeout=60)
            if process.returncode == -number and self.rows_done(folder) < 9:
                return folder, text
        self.fail("no run could be caught in its middle")

    def test_what_was_cut_off_ends_as_if_it_had_not_been(self):
        self.run_sweep(*NINE, tree=ASH)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            with self.subTest(number):
                folder, words = self.cut_off(number)
                done = self.rows_done(folder)
                self.assertGreaterEqual(done, 2)
                self.assertFalse((folder / "sweep.csv").exists())
                if number != signal.SIGKILL:
                    self.assertIn("the same command continues", words)
                again = self.succeed("sweep", ASH, *NINE, "-o", folder)
                self.assertIn(f"resuming: {done} of 9 done", again.stderr)
                self.assertEqual(timeless(self.table(folder)), timeless(self.table()))
                self.assertEqual(self.files(folder), self.files())
                for name in self.files():
                    if name.endswith((".png", ".svg")):
                        self.assertEqual(
                            (folder / name).read_bytes(), (self.sweep / name).read_bytes(), name
                        )

    def test_done_is_done(self):
        flags = ("--threshold", "1,2", *COARSE)
        self.run_sweep(*flags)
        table = (self.sweep / "sweep.csv").read_bytes()
        (self.sweep / "sweep.csv").unlink()
        again = self.run_sweep(*flags)
        self.assertIn("resuming: 2 of 2 done", again.stderr)
        self.assertEqual((self.sweep / "sweep.csv").read_bytes(), table)  # even the seconds

    def test_a_lost_picture_is_drawn_again(self):
        flags = ("--threshold", "1,2", *COARSE)
        self.run_sweep(*flags)
        picture = self.sweep / self.table()[1]["picture"]
        before = picture.read_bytes()
        picture.unlink()
        self.assertIn("1 of 2 done", self.run_sweep(*flags).stderr)
        self.assertEqual(picture.read_bytes(), before)

    def test_a_damaged_picture_is_drawn_again(self):
        flags = ("--threshold", "1,2", *COARSE)
        self.run_sweep(*flags)
        picture = next((self.sweep / "pictures").iterdir())
        whole = picture.read_bytes()
        for damaged in (b"", b"x", whole[: len(whole) // 2]):
            picture.write_bytes(damaged)
            self.assertIn("1 of 2 done", self.run_sweep(*flags).stderr)
            self.assertEqual(picture.read_bytes(), whole)

    def test_a_row_that_cannot_be_written_keeps_the_others(self):
        flags = ("--threshold", "1,2,3", *COARSE)
        self.run_sweep(*flags)
        journal = self.sweep / "sweep.jsonl"
        *kept, last = journal.read_bytes().splitlines(keepends=True)
        journal.write_bytes(b"".join(kept))
        obstacle = self.sweep / json.loads(last)["picture"]
        obstacle.unlink()
        obstacle.mkdir()
        result = self.run_command("sweep", self.tree, *flags, "-o", self.sweep)
        self.assertEqual(result.returncode, 5, result.stderr)
        self.assertIn(f"cannot write {obstacle}", result.stderr.splitlines()[-1])
        self.assertEqual(journal.read_bytes(), b"".join(kept))
        obstacle.rmdir()
        self.assertIn("resuming: 2 of 3 done", self.run_sweep(*flags).stderr)
        self.assertEqual(len(self.table()), 3)

    def refuse(self, words, *flags, tree=None):
        before = {name: (self.sweep / name).read_bytes() for name in self.files()}
        result = self.run_command("sweep", tree or self.tree, *flags, "-o", self.sweep)
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in [*words, "--restart"]:
            self.assertIn(word, result.stderr)
        self.assertEqual(
            {name: (self.sweep / name).read_bytes() for name in self.files()}, before
        )

    def test_another_sweep_is_refused(self):
        self.run_sweep("--threshold", "1,2", *COARSE)
        self.refuse(["--threshold is 1.0, 2.0, not 1.0, 3.0"], "--threshold", "1,3", *COARSE)
        self.refuse(["--flatness"], "--threshold", "1,2", "--flatness", "0.5", *COARSE)
        self.refuse(["tree"], "--threshold", "1,2", *COARSE, tree=ASH)

    def test_a_sweep_whose_journal_is_damaged_is_refused_and_can_be_replaced(self):
        flags = ("--threshold", "1,2", *COARSE)
        self.run_sweep(*flags)
        journal = self.sweep / "sweep.jsonl"
        whole = journal.read_bytes()
        old = b'{"schema":"leafhull-sweep-journal/1","version":"0.1.0"}\n{"row":0,"picture":"p"}\n'
        for damaged in (whole.replace(b"version", b"wersion", 1), old):
            journal.write_bytes(damaged)
            self.refuse(["sweep.jsonl", "damaged", "--restart"], *flags)
            self.assertEqual(journal.read_bytes(), damaged)
        self.run_sweep(*flags, "--restart")
        self.assertEqual(len(self.table()), 2)

    def test_restart_replaces_it_and_nothing_else(self):
        self.run_sweep("--radius-max", "1,2", *COARSE)
        (self.sweep / "pictures" / "mine.png").write_text("mine")
        (self.sweep / "plot-mine.svg").write_text("mine")
        self.run_sweep("--threshold", "1,3", "--restart", *COARSE)
        names = self.files()
        self.assertIn("pictures/mine.png", names)
        self.assertIn("plot-mine.svg", names)
        self.assertIn("plot-threshold.svg", names)
        self.assertNotIn("plot-radius-max.svg", names)
        self.assertEqual(len([n for n in names if n.startswith("pictures/")]), 3)
        self.assertEqual([row["threshold"] for row in self.table()], ["1", "3"])

    def test_restart_with_what_cannot_be_keeps_the_old_sweep(self):
        self.run_sweep("--threshold", "1,2", *COARSE)
        before = self.files()
        flags = ("--radius-max", "1,1e9", "--restart", *COARSE)
        result = self.run_command("sweep", self.tree, *flags, "-o", self.sweep)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(self.files(), before)

    def test_files_of_others_are_left_alone(self):
        self.sweep.mkdir()
        (self.sweep / "notes.txt").write_text("mine")
        self.run_sweep("--threshold", "1,2", *COARSE)
        self.assertEqual((self.sweep / "notes.txt").read_text(), "mine")

    def test_a_table_from_elsewhere_is_not_overwritten(self):
        self.sweep.mkdir()
        (self.sweep / "sweep.csv").write_text("mine")
        self.refuse(["sweep.csv", "already exists"], "--threshold", "1,2", *COARSE)
        self.run_sweep("--threshold", "1,2", "--restart", *COARSE)
        self.assertEqual(len(self.table()), 2)

    def test_a_journal_from_elsewhere_is_not_overwritten(self):
        self.sweep.mkdir()
        (self.sweep / "sweep.jsonl").write_text("mine\n")
        for flags in ((), ("--restart",)):
            result = self.run_command(
                "sweep", self.tree, "--threshold", "1,2", *flags, "-o", self.sweep
            )
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertEqual((self.sweep / "sweep.jsonl").read_text(), "mine\n")


class Refusals(SweepTest):
    def refuse(self, words, *flags, code=2):
        self.fail_with(code, words, "sweep", self.tree, *flags, "-o", self.sweep)

    def test_nothing_is_swept(self):
        for flags in ((), ("--threshold", "2")):
            self.refuse(["--threshold 1.5:2.5:0.25 -o"], *flags)

    def test_a_number_that_is_none_says_so(self):
        self.refuse(["--threshold nan", "finite"], "--threshold", "nan")

    def test_no_folder(self):
        self.fail_with(2, ["no folder", "-o out"], "sweep", self.tree, "--threshold", "1,2")

    def test_ranges(self):
        for words, text in (
            (["backwards", "1:2:0.5"], "2:1:0.5"),
            (["step"], "1:2:0"),
            (["step"], "1:2:-1"),
            (["'1:2:nan'", "first:last:step"], "1:2:nan"),
            (["first:last:step"], "1:2"),
            (["first:last:step"], "::"),
            (["list"], "1,x"),
            (["list"], "1,,2"),
            (["1.5 twice"], "1.5,2,1.50"),
            (["mixes", "30%:60%:10%"], "30,40%"),
            (["range"], "0:2:1"),
            (["values"], "1:2:1e-12"),
        ):
            self.refuse(["--threshold", *words], "--threshold", text)
        self.refuse(["thin twice"], "--style", "thin,thin")
        self.refuse(["Did you mean controlled?"], "--method", "isotropic,controled")
        self.refuse(["whole"], "--resolution", "32:64:0.5")

    def test_two_kinds_of_threshold(self):
        for other in (("--coverage", "0.8,0.9"), ("--coverage", "0.9"),
                      ("--threshold-percent", "40,50"), ("--threshold-percent", "40")):  # fmt: skip
            for own in ("1,2", "30%,40%"):
                self.refuse(["contradict"], "--threshold", own, *other)

    def test_a_combination_that_contradicts_itself(self):
        self.refuse(["--adaptivity"], "--mesher", "vdb,bricks", "--adaptivity", "0,0.5")

    def test_many_combinations(self):
        flags = ("--threshold", "1:2:0.01", "--radius-max", "1:2:0.01")
        self.refuse(["10,201", "--yes"], *flags)
        missing = self.run_command("sweep", "no.glb", *flags, "--yes", "-o", self.sweep)
        self.assertEqual(missing.returncode, 3, "agreed to, and on to the tree")
        self.refuse(["more than a sweep can hold"], *flags, "--flatness", "0.1:1:0.01", "--yes")

    def test_folders(self):
        flags = ("sweep", self.tree, "--threshold", "1,2", "-o")
        self.fail_with(5, ["is a file"], *flags, self.tree)
        self.fail_with(5, ["is a file"], *flags, self.tree / "below")
        self.fail_with(5, ["cannot write"], *flags, "/proc/leafhull/sweep")

    def test_errors_come_before_the_tree_is_read(self):
        self.fail_with(2, ["step"], "sweep", "no.glb", "--threshold", "1:2:0", "-o", self.sweep)
        self.fail_with(5, ["file"], "sweep", "no.glb", "--threshold", "1,2", "-o", self.tree)

    def test_a_missing_tree_leaves_no_folder(self):
        self.fail_with(3, ["no.glb"], "sweep", "no.glb", "--threshold", "1,2", "-o", self.sweep)
