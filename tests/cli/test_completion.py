# SPDX-License-Identifier: Apache-2.0
"""Shells complete the command, and the manual page has everything that the help has."""

import os
import re
import shutil
import subprocess

from command import CommandTest



class CompletionTest(CommandTest):
    def verbs(self):
        """The verbs on the help page."""
        page = self.succeed("--help").stdout
        verbs = re.findall(r"(?m)^  (\w+) ", page[page.index("Verbs") : page.index("General")])
        self.assertGreater(len(verbs), 8)
        return verbs

    def flags_of(self, verb):
        """The long flags on the verb's help page."""
        return set(re.findall(r"(?m)^  (?:-\w, )?(--[\w-]+)", self.succeed(verb, "--help").stdout))

    def script(self, shell):
        return self.succeed("completion", shell).stdout

    def run_shell(self, *words):
        if not shutil.which(words[0]):
            self.skipTest(f"NOT CHECKED: {words[0]} is not installed")
        result = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        return result.stdout


class Completion(CompletionTest):
    def test_usage(self):
        self.fail_with(2, ["SHELL 'tcsh'", "bash, zsh, fish"], "completion", "tcsh")
        self.fail_with(2, ["no SHELL", "leafhull completion bash"], "completion")

    def test_scripts_have_every_verb_and_flag(self):
        for shell in ("bash", "zsh", "fish"):
            script = self.script(shell)
            for verb in self.verbs():
                self.assertRegex(script, rf"\b{verb}\b")
                for flag in self.flags_of(verb):
                    spelling = f"-l {flag[2:]} " if shell == "fish" else flag
                    self.assertIn(spelling, script, f"{verb} in {shell}")
            self.assertNotIn("help-options", script)


class Bash(CompletionTest):
    def complete(self, *words):
        """The completions that bash offers for the last word, in a folder with some files."""
        (self.folder / "my trees").mkdir(exist_ok=True)
        (self.folder / "completion").write_text(self.script("bash"))
        return self.run_shell(
            "bash",
            "--norc",
            "-uc",
            'source ./completion; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _leafhull\n'
            'for word in "${COMPREPLY[@]}"; do echo "$word"; done',
            "bash",
            "leafhull",
            *words,
        ).splitlines()

    def test_verbs(self):
        self.assertEqual(set(self.complete("")), {*self.verbs(), "--help", "--version"})
        self.assertEqual(self.complete("s"), ["suggest", "sweep", "study", "scatter"])

    def test_flags_of_each_verb(self):
        for verb in self.verbs():
            found = self.complete(verb, "--")
            self.assertEqual(len(found), len(set(found)))
            self.assertEqual(set(found), self.flags_of(verb), verb)
        self.assertEqual(self.complete("extract", "tree.glb", "--no-s"), ["--no-snap"])
        self.assertEqual(self.complete("extract", "--quiet", "--verb"), ["--verbose"])

    def test_names_are_values(self):
        self.assertEqual(self.complete("extract", "--points", ""), ["area", "vertices"])
        self.assertEqual(self.complete("extract", "--style", "pai"), ["painterly"])
        self.assertEqual(self.complete("extract", "--style", "=", "pai"), ["painterly"])
        self.assertEqual(self.complete("extract", "--points", "="), ["area", "vertices"])
        self.assertEqual(self.complete("forest", "--merge", ""), ["none", "canopy"])
        self.assertEqual(self.complete("render", "--as", ""), ["tree", "shape"])
        self.assertEqual(self.complete("render", "--camera", "t"), ["three-quarter", "top", "tree.glb"])
        self.assertEqual(self.complete("extract", "--variant", ""), ["vector", "work-item"])
        self.assertLessEqual({"bash", "zsh", "fish"}, set(self.complete("completion", "")))
        self.assertIn("paper", self.complete("render", "--figure17", ""))

    def test_numbers_are_the_users(self):
        for flag in ("--threshold", "--resolution", "--device"):
            self.assertEqual(self.complete("extract", flag, ""), [])
        self.assertEqual(self.complete("forest", "--memory", ""), [])

    def test_files_and_folders(self):
        self.assertIn("tree.glb", self.complete("extract", "t"))
        self.assertIn("tree.glb", self.complete("extract", "-o", ""))
        self.assertIn("my trees", self.complete("extract", "--report", "my"))
        self.assertEqual(self.complete("sweep", "--output", "t"), [])
        self.assertEqual(set(self.complete("forest", "-o", "")), {"out", "my trees"})
        self.assertNotIn("tree.glb", self.complete("devices", ""))


class OtherShells(CompletionTest):
    def test_zsh_understands_its_script(self):
        path = self.folder / "_leafhull"
        path.write_text(self.script("zsh"))
        self.run_shell("zsh", "-n", str(path))

    def test_fish_completes(self):
        path = self.folder / "leafhull.fish"
        path.write_text(self.script("fish"))

        def complete(line):
            told = self.run_shell("fish", "-N", "-c", f"source {path}; complete -C '{line}'")
            return [entry.split("\t")[0] for entry in told.splitlines()]

        self.assertIn("extract", complete("leafhull "))
        self.assertEqual(complete("leafhull extract --points "), ["area", "vertices"])
        self.assertIn("--band-low-percent", complete("leafhull extract --band"))


class Manual(CompletionTest):
    def test_it_tells_what_the_help_tells(self):
        page = self.succeed("help-manual").stdout
        self.assertTrue(page.startswith('.TH LEAFHULL 1 "" "leafhull '))
        for section in ("NAME", "SYNOPSIS", "DESCRIPTION", "VERBS", "EXIT STATUS"):
            self.assertIn(f"\n.SH {section}\n", page)
        self.assertEqual(re.findall(r"(?m)^\.SS (\S+)$", page), self.verbs())
        plain = page.replace("\\-", "-")
        for verb in self.verbs():
            for flag in self.flags_of(verb):
                self.assertRegex(plain, rf"(?m)^\.B (-\w, )?{flag}( \S+)?$", verb)
        self.assertEqual(plain.count("\n.B --coverage X\n"), 1, "what verbs share stands once")

    def test_roff_has_no_complaint(self):
        path = self.folder / "leafhull.1"
        path.write_text(self.succeed("help-manual").stdout)
        if not shutil.which("groff"):
            self.skipTest("NOT CHECKED: groff is not installed")
        result = subprocess.run(
            ["groff", "-man", "-Tascii", "-ww", "-rLL=100n", str(path)],
            capture_output=True,
            text=True,
            env=os.environ | {"GROFF_NO_SGR": "1"},
        )
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        text = re.sub(r"\s+", " ", re.sub(".\x08", "", result.stdout))
        self.assertIn("--threshold X", text)
        self.assertIn("(density; > 0; default by style)", text)
        self.assertIn("leafhull extract birch.glb -o shape.glb leafhull", text)
