# SPDX-License-Identifier: Apache-2.0
"""A program that waits with a case in memory and does one whole run when it is told to.

    contender CASE.json [args]   one line: {"ready": true, "name", "version", "setup": {...}}
    run                          one line: {"field": s, "mesh": s, "total": s, ...}
    quit, or end of input        it ends

What goes wrong is one line {"error": "..."}. Lines that are not JSON objects are chatter."""

import contextlib
import json
import os
import re
import subprocess
import tempfile
import threading
import time
from collections.abc import Mapping
from pathlib import Path

ANSWER_SECONDS = 300
FOREST_SECONDS = 4 * 3600


class Unavailable(Exception):
    """The contender cannot take part (any longer); the message says why."""


def call(command: list[str], environment: Mapping[str, str] | None = None) -> str:
    """What a program that runs to its end says on standard output."""
    try:
        return subprocess.run(
            command,
            check=True,
            capture_output=True,
            text=True,
            timeout=ANSWER_SECONDS,
            env={**os.environ, **(environment or {})},
        ).stdout
    except FileNotFoundError:
        raise Unavailable(f"{Path(command[0]).name} is not there") from None
    except subprocess.TimeoutExpired:
        raise Unavailable(f"not done within {ANSWER_SECONDS} s") from None
    except subprocess.CalledProcessError as error:
        raise Unavailable(f"status {error.returncode}: {error.stderr.strip()}") from None


def measure(command: list[str], environment: Mapping[str, str]) -> tuple[float, int]:
    """How long a program runs to its end, and the most bytes that one of its processes holds; the
    kernel counts those of the process that started it too, so never less than the bench's."""
    with tempfile.TemporaryFile("w+") as log:
        start = time.perf_counter()
        try:
            process = subprocess.Popen(
                command, stdout=log, stderr=log, env={**os.environ, **environment}
            )
        except FileNotFoundError:
            raise Unavailable(f"{Path(command[0]).name} is not there") from None
        patience = threading.Timer(FOREST_SECONDS, process.kill)
        patience.start()
        _, status, usage = os.wait4(process.pid, 0)  # and of the processes that it waited for
        seconds = time.perf_counter() - start
        patience.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            log.seek(0)
            raise Unavailable(f"status {process.returncode}: {complaint(log.read())}")
        return seconds, 1024 * usage.ru_maxrss


def complaint(said: str) -> str:
    """leafhull's own line out of what others, such as mpirun, say about it; else the last."""
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    own = (line for line in lines if line.startswith("leafhull: "))
    return next(own, lines[-1] if lines else "nothing said")


class Contender:
    def __init__(self, command: list[str], environment: Mapping[str, str] | None = None) -> None:
        self._log = tempfile.TemporaryFile("w+")
        try:
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._log,
                text=True,
                env={**os.environ, **(environment or {})},
            )
        except FileNotFoundError:
            self._log.close()
            raise Unavailable(f"{Path(command[0]).name} is not there") from None
        try:
            ready = self._answer()
        except Unavailable:
            self.stop()
            raise
        self.version: str = ready["version"]
        self.setup: dict = ready["setup"]

    def run(self) -> dict:
        """The answer; to it is added what memory the process held at most."""
        try:
            self._forget_peak_memory()
            self._process.stdin.write("run\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            raise Unavailable(self._last_words()) from None
        answer = self._answer()
        return answer | {"peak_memory_bytes": self._peak_memory()}

    def stop(self) -> None:
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            with contextlib.suppress(BrokenPipeError):
                stream.close()
        self._log.close()

    def _forget_peak_memory(self) -> None:
        Path(f"/proc/{self._process.pid}/clear_refs").write_text("5")

    def _peak_memory(self) -> int:
        status = Path(f"/proc/{self._process.pid}/status").read_text()
        found = re.search(r"^VmHWM:\s*(\d+) kB$", status, re.MULTILINE)
        if not found:
            raise Unavailable(self._last_words())
        return 1024 * int(found[1])

    def _answer(self) -> dict:
        overdue = threading.Event()

        def give_up() -> None:
            overdue.set()
            self._process.kill()

        patience = threading.Timer(ANSWER_SECONDS, give_up)
        patience.start()
        line = next((text for text in self._process.stdout if text.startswith("{")), None)
        patience.cancel()
        if overdue.is_set():
            raise Unavailable(f"no answer within {ANSWER_SECONDS} s")
        if line is None:
            raise Unavailable(self._last_words())
        answer = json.loads(line)
        if "error" in answer:
            raise Unavailable(answer["error"])
        return answer

    def _last_words(self) -> str:
        status = self._process.wait()
        self._log.seek(0)
        lines = self._log.read().split("\n")
        said = next((line.strip() for line in reversed(lines) if line.strip()), "nothing said")
        return f"ended with status {status}: {said}"
