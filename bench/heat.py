# SPDX-License-Identifier: Apache-2.0
"""Contenders side by side: a warm-up run each, then rounds of one run each, always in the same
order, so that what disturbs the machine disturbs them all."""

import sys
from collections.abc import Callable, Iterator
from typing import NamedTuple, Protocol

from contender import Unavailable
from records import WARM_UP, Record, Results

SECONDS = ("field", "mesh", "total")


class Runner(Protocol):
    version: str
    setup: dict

    def run(self) -> dict: ...

    def stop(self) -> None: ...


class Entrant(NamedTuple):
    case: str
    name: str
    start: Callable[[], Runner]


class Limits(NamedTuple):
    rounds: int
    seconds: float  # an entrant whose rounds would take longer runs fewer, one at least
    warm_up: bool = True

    def rounds_of(self, warm_up: float) -> int:
        return max(1, min(self.rounds, int(self.seconds / warm_up)))


class Job(NamedTuple):
    entrants: list[Entrant]
    limits: Limits


def unit_of(part: str) -> str:
    *groups, name = part.split(": ")
    if name.endswith("_bytes"):
        return "bytes"
    seconds = name in SECONDS or name.endswith("_seconds") or groups in (["stages"], ["setup"])
    return "s" if seconds else ""


def parts_of(answer: dict, prefix: str = "") -> Iterator[tuple[str, float]]:
    """The numbers of an answer; those of a nested object carry its name, as in `stages: field`."""
    for key, value in answer.items():
        if isinstance(value, dict):
            yield from parts_of(value, f"{prefix}{key}: ")
        elif isinstance(value, int | float) and not isinstance(value, bool):
            yield prefix + key, value


class Heat:
    def __init__(self, limits: Limits, results: Results) -> None:
        self._limits = limits
        self._results = results
        self._running: dict[Entrant, Runner] = {}
        self._rounds: dict[Entrant, int] = {}

    def run(self, entrants: list[Entrant]) -> None:
        try:
            for entrant in entrants:
                self._start(entrant)
            first = WARM_UP if self._limits.warm_up else WARM_UP + 1
            for number in range(first, self._limits.rounds + 1):
                for entrant in list(self._running):
                    if number <= self._rounds.get(entrant, self._limits.rounds):
                        self._run(entrant, number)
        finally:
            for runner in self._running.values():
                runner.stop()
            self._running.clear()

    def _start(self, entrant: Entrant) -> None:
        try:
            runner = entrant.start()
        except Unavailable as reason:
            self._note_absent(entrant, reason)
        else:
            self._running[entrant] = runner
            self._note(entrant, WARM_UP, {"setup": runner.setup})

    def _run(self, entrant: Entrant, number: int) -> None:
        try:
            answer = self._running[entrant].run()
        except Unavailable as reason:
            self._running.pop(entrant).stop()
            self._note_absent(entrant, reason)
        else:
            self._note(entrant, number, answer)
            if number == WARM_UP:
                self._rounds[entrant] = self._limits.rounds_of(answer["total"])

    def _note(self, entrant: Entrant, number: int, answer: dict) -> None:
        version = self._running[entrant].version
        self._results.records += [
            Record(entrant.case, entrant.name, version, number, part, value, unit_of(part))
            for part, value in parts_of(answer)
        ]

    def _note_absent(self, entrant: Entrant, reason: Unavailable) -> None:
        print(f"  {entrant.name}: {reason}", file=sys.stderr)
        absent = {"case": entrant.case, "contender": entrant.name, "reason": str(reason)}
        self._results.about["absent"].append(absent)
