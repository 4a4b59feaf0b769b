# SPDX-License-Identifier: Apache-2.0
import os
import signal
import subprocess
import time

from command import ASH, CommandTest


def listen_to_interrupts():
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def ignore_hangups():
    signal.signal(signal.SIGHUP, signal.SIG_IGN)


class Interrupt(CommandTest):
    def start(self, *flags, before=listen_to_interrupts):
        names = ("a.obj", "a.gltf", "a.vdb")
        outputs = [word for name in names for word in ("-o", self.out / name)]
        command = [os.environ["LEAFHULL"], "extract", ASH, *outputs, *flags]
        return subprocess.Popen(
            [str(word) for word in command],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            preexec_fn=before,
        )

    def interrupt(self, process, number):
        process.send_signal(number)
        _, text = process.communicate(timeout=60)
        self.assertEqual(process.returncode, -number, text)
        self.assertEqual(self.written(), [])

    def test_at_any_moment(self):
        for number, delay in (
            (signal.SIGINT, 0.1),
            (signal.SIGTERM, 0.2),
            (signal.SIGHUP, 0.4),
            (signal.SIGINT, 0.8),
        ):
            with self.subTest(delay=delay):
                process = self.start("--preset", "film", "--dense")
                time.sleep(delay)
                self.interrupt(process, number)

    def test_a_signal_that_is_ignored(self):  # as under nohup
        process = self.start("--preset", "fine", before=ignore_hangups)
        time.sleep(0.3)
        self.assertIsNone(process.poll(), "ended before it could be told")
        process.send_signal(signal.SIGHUP)
        _, text = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, text)
        self.assertEqual(self.written(), ["a.gltf", "a.obj", "a.vdb"])

    def test_while_files_are_written(self):
        for _ in range(5):
            process = self.start("--preset", "fine")
            while process.poll() is None and not self.written():
                time.sleep(0.0005)
            if process.poll() is None:
                return self.interrupt(process, signal.SIGINT)
            process.communicate()
            for name in self.written():
                (self.out / name).unlink()
        self.fail("no run could be caught while writing")
