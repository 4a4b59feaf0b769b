# SPDX-License-Identifier: Apache-2.0
"""How near leafhull's stages come to what the device can do."""

from collections.abc import Iterator

import contenders as who
from records import Results
from text import number, table

STAGES = ("isotropic density", "threshold", "field", "snap")
Values = dict[str, float | None]


def surveyed(results: Results) -> dict[str, tuple[str, str]]:
    """The case and the contender of every survey, by the tree's and the method's name."""
    keys = dict.fromkeys((record.case, record.contender) for record in results.records)
    return {
        f"{case.removesuffix('-128-painterly')} {contender.removeprefix('bench_limit ')}": (
            case,
            contender,
        )
        for case, contender in keys
        if contender in who.SURVEYS
    }


def of_stage(results: Results, key: tuple[str, str], stage: str, part: str) -> float | None:
    return results.median(*key, f"stages: {stage}: {part}")


def percent_of_peak(results: Results) -> Values:
    shares = {
        name: of_stage(results, key, "field", "share_of_peak")
        for name, key in surveyed(results).items()
    }
    return {name: None if share is None else 100 * share for name, share in shares.items()}


def evaluated_over_inside(results: Results, key: tuple[str, str], stage: str) -> float | None:
    evaluated = of_stage(results, key, stage, "pairs_evaluated")
    inside = of_stage(results, key, stage, "pairs_inside")
    return evaluated / inside if evaluated and inside else None


def pairs_per_inside(results: Results) -> Values:
    return {
        name: evaluated_over_inside(results, key, "field")
        for name, key in surveyed(results).items()
    }


def row(results: Results, name: str, key: tuple[str, str], stage: str) -> tuple[str, ...] | None:
    seconds = of_stage(results, key, stage, "device_seconds")
    if not seconds:
        return None
    evaluated = of_stage(results, key, stage, "pairs_evaluated")
    share = of_stage(results, key, stage, "share_of_peak")
    return (
        f"{name}, {stage}",
        number(1000 * seconds),
        number(evaluated and 1e-9 * evaluated / seconds),
        number(evaluated_over_inside(results, key, stage)),
        number(of_stage(results, key, stage, "gflops")),
        number(share and 100 * share),
    )


def section(results: Results) -> Iterator[str]:
    surveys = surveyed(results)
    if not surveys:
        return
    peaks = [results.median(*key, "fma_gflops") for key in surveys.values()]
    bandwidths = [results.median(*key, "bandwidth_gbs") for key in surveys.values()]
    yield "## The limit"
    yield ""
    yield (
        f"Chains of fused multiply-adds reach {number(max(peaks))} GFLOP/s on this device, a triad "
        f"{number(max(bandwidths))} GB/s. Times are the device's own for its kernels, the best of "
        "five runs; a fused multiply-add counts as two operations."
    )
    yield ""
    header = (
        "case, stage",
        "device, ms",
        "G pairs/s",
        "evaluated per pair inside",
        "GFLOP/s",
        "% of peak",
    )
    every = (row(results, name, key, stage) for name, key in surveys.items() for stage in STAGES)
    yield from table(header, filter(None, every))
