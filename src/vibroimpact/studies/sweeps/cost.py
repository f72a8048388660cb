"""Predict the computing time of a sweep, and the number of jobs (tiles) into which to divide the sweep."""

import math
from collections.abc import Mapping

RUNS = ("amplitudes", "energy")
"""Observations that need one run over `cycles` per initial state; "peaks" and "regimes" need runs of other kinds."""
CYCLE = 5e-6
"""Core seconds per forcing cycle of one run, as measured by `make benchmark` (a settled cycle has four impacts)."""
POINT = 0.01
"""Core seconds that a point takes in addition to its simulations: for flow tables and fixed points."""
RETESTED = 0.1
"""Assumed share of the motions that do not repeat; these motions are tested over `retest` cycles."""
MOST_TILES = 10_000
"""Largest number of tiles, each of which is a file and a job."""


def points(axes: list[Mapping]) -> int:
    """Return the number of points of a grid; `axes` is the list of its axes in the configuration."""
    return math.prod(_values(axis) for axis in axes)


def core_seconds(request: Mapping) -> float:
    """Predict the core seconds that a sweep takes, within a factor of about two.

    request: mapping with the keys "axes" and "spec", as for `vibroimpact.studies.sweeps.spec.parsed`.
    """
    spec, observation = request["spec"], request["spec"].get("observation")
    starts, cycles = spec.get("starts", 0), spec.get("cycles", 0)
    simulated = cycles * sum(name in RUNS for name in spec["observe"])
    if "peaks" in spec["observe"]:
        simulated += cycles * _values(spec["band"])
    if "regimes" in spec["observe"]:
        settling = observation["cycles"] * observation["rounds"] + observation["blocks"] * observation["block"]
        simulated += settling + RETESTED * observation["retest"]
    return points(request["axes"]) * (POINT + CYCLE * starts * simulated)


def tiles(request: Mapping, seconds: float) -> int:
    """Return the number of tiles into which to divide a sweep, so that a tile takes about `seconds` core seconds.

    The number of tiles is at most MOST_TILES, and at most the number of points of the sweep.
    """
    return max(1, min(math.ceil(core_seconds(request) / seconds), points(request["axes"]), MOST_TILES))


def _values(axis):
    return axis.get("cells") or axis.get("values") or len(axis.get("listed") or axis["tuples"])
