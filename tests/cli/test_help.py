# SPDX-License-Identifier: Apache-2.0
import re

from command import CommandTest

FLAGS = """--leaves --ellipse --leaf-scale --style --method --threshold --coverage --erosion --dilation --radius-max
--radius-unit --flatness --falloff --spread --density --band-low --band-low-percent --band-high
--band-high-percent --min-component
--hollows --preset --resolution --voxel-size --dense --no-snap --mesher --adaptivity --output
--save-kernels --save-field --report --device --variant --threads --quiet --verbose --help --version""".split()


class Help(CommandTest):
    def test_version_is_one_line(self):
        self.assertRegex(self.succeed("--version").stdout, r"\Aleafhull \d+\.\d+\.\d+\n\Z")

    def test_help_names_the_verbs(self):
        for flag in ("-h", "--help"):
            page = self.succeed(flag).stdout
            for verb in ("extract", "inspect", "suggest", "sweep", "render", "forest", "devices"):
                self.assertIn(f"\n  {verb} ", page)

    def test_extract_help_has_every_flag_in_groups(self):
        page = self.succeed("extract", "--help").stdout
        for flag in FLAGS:
            self.assertRegex(page, rf"(?m)^  (-\w, )?{flag}\b")
        for group in ("Leaves", "Shape", "Resolution", "Output", "Device", "General", "Styles"):
            self.assertRegex(page, rf"(?m)^{group}$")
        self.assertIn("Examples\n  leafhull extract", page)

    def test_every_value_has_a_default(self):
        page = self.succeed("extract", "--help").stdout
        options = page[page.index("\nLeaves\n") : page.index("\n  -h, --help")]
        for entry in re.split(r"\n  (?=-)", options)[1:]:
            self.assertIn("default", entry)

    def test_pages_fit_a_terminal_of_100_columns(self):
        for verb in ("", *"extract inspect suggest sweep render forest devices".split()):
            for line in self.succeed(*verb.split(), "--help").stdout.splitlines():
                self.assertLessEqual(len(line), 100, line)
                self.assertEqual(line, line.rstrip())

    def test_help_says_nothing_on_standard_error(self):
        self.assertEqual(self.succeed("extract", "--help").stderr, "")

    def test_markdown_has_every_flag(self):
        page = self.succeed("help-options").stdout
        for flag in FLAGS:
            self.assertRegex(page, rf"(?m)^\| `(-\w, )?{flag}\b")
        for line in page.splitlines():
            if line.startswith("|"):
                self.assertEqual(line.count("|"), 6, line)
