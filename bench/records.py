# SPDX-License-Identifier: Apache-2.0
"""What a bench measured: one record per value, and what the tables ask of them."""

import csv
import json
import statistics
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

WARM_UP = 0  # the round that no median counts


class Record(NamedTuple):
    case: str
    contender: str
    version: str
    round: int
    part: str
    value: float
    unit: str  # s, bytes, or empty for a count


class Results:
    """The records, and in `about` what they cannot say: date, machine, cases, who was absent."""

    def __init__(self, records: Iterable[Record] = (), about: dict | None = None) -> None:
        self.records = list(records)
        self.about = about or {}

    def values(self, case: str, contender: str, part: str) -> list[float]:
        return [
            record.value
            for record in self.records
            if (record.case, record.contender, record.part) == (case, contender, part)
            and record.round != WARM_UP
        ]

    def median(self, case: str, contender: str, part: str) -> float | None:
        values = self.values(case, contender, part)
        return statistics.median(values) if values else None

    def ratio(self, case: str, contender: str, reference: str, part: str) -> float | None:
        """How many times the reference's median the contender's is."""
        over, under = (self.median(case, name, part) for name in (contender, reference))
        return over / under if over is not None and under else None

    def cold(self, case: str, contender: str, part: str) -> float | None:
        """The value of the warm-up round."""
        for record in self.records:
            key = (record.case, record.contender, record.part, record.round)
            if key == (case, contender, part, WARM_UP):
                return record.value
        return None

    def contenders(self, case: str) -> list[str]:
        """Who ran, in the order in which they did."""
        return list(dict.fromkeys(r.contender for r in self.records if r.case == case))

    def save(self, stem: Path) -> None:
        with stem.with_suffix(".csv").open("w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(Record._fields)
            writer.writerows(
                record._replace(value=f"{record.value:.9g}") for record in self.records
            )
        stem.with_suffix(".json").write_text(json.dumps(self.about, indent=2) + "\n")


def load(stem: Path) -> Results:
    with stem.with_suffix(".csv").open(newline="") as file:
        rows = csv.DictReader(file)
        records = [
            Record(**row | {"round": int(row["round"]), "value": float(row["value"])})
            for row in rows
        ]
    return Results(records, json.loads(stem.with_suffix(".json").read_text()))
