# SPDX-License-Identifier: Apache-2.0
"""Table 2 of the paper beside today's machine.

Source: Shiraishi, Kamimura and Shinya, Journal of the Society for Art and Science 10(2), 2011,
p. 57: seconds on an AMD Athlon 64 3200+ (2.01 GHz, 1 GB)."""

from collections.abc import Iterator
from typing import NamedTuple

from records import Results

PAPER = {
    "isotropic": {32: 1.297, 64: 5.164, 128: 35.382},
    "controlled": {32: 2.029, 64: 7.676, 128: 41.208},
}
TREE = "aspen-52648"  # as many leaf vertices as the paper's tree


class Row(NamedTuple):
    method: str
    resolution: int
    paper: float
    published: float
    ours: float

    @property
    def values(self) -> tuple[float, ...]:
        """The seconds, and the two ratios."""
        seconds = (self.paper, self.published, self.ours)
        return (*seconds, self.paper / self.ours, self.published / self.ours)


def rows(results: Results, style: str) -> Iterator[Row]:
    for method, seconds in PAPER.items():
        for resolution, paper in seconds.items():
            case = f"{TREE}-{resolution}-{style}"
            ours = results.median(case, f"leafhull {method}", "total")
            published = results.median(case, f"published {method}", "total")
            if ours is not None and published is not None:
                yield Row(method, resolution, paper, published, ours)
