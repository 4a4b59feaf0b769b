# SPDX-License-Identifier: Apache-2.0
"""How near leafhull's field comes to what the machine can do."""

from collections.abc import Iterator

from records import Results

PROGRAM = "bench_limit"


def percent_of_peak(results: Results) -> dict[str, float | None]:
    return {}


def pairs_per_inside(results: Results) -> dict[str, float | None]:
    return {}


def section(results: Results) -> Iterator[str]:
    yield ""
