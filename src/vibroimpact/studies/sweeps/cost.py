"""Predict the cost of a sweep and its number of tiles; only the standard library is used."""

import math
from collections.abc import Mapping

RUNS = ("amplitudes", "envelopes", "energy")
"""Observations that simulate every start over `cycles`; "peaks" does so along its band, "regimes" as it settles."""
CYCLE = 5e-6
"""Core seconds of a forcing cycle of one start, observed (`make benchmark`; a settled cycle has four impacts)."""
POINT = 0.01
"""Core seconds of a point without its simulations: flow tables, fixed points, orbits."""
RETESTED = 0.1
"""Assumed share of motions that do not repeat and are tested over `retest` cycles."""
MOST_TILES = 10_000
"""Largest number of tiles, each of which is a file and a job."""


def points(axes: list[Mapping]) -> int:
    """Return the number of points of a grid over axes as the config has them."""
    return math.prod(_values(axis) for axis in axes)


def core_seconds(request: Mapping) -> float:
    """Predict the core seconds of a sweep, within a factor of about two.

    Parameters
    ----------
    request : Mapping
        "axes" and "spec", as for `vibroimpact.studies.sweeps.request.parsed`.
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
    """Return the number of tiles of about the given core seconds each, at most one per point."""
    return max(1, min(math.ceil(core_seconds(request) / seconds), points(request["axes"]), MOST_TILES))


def _values(axis):
    return axis.get("cells") or axis.get("values") or len(axis.get("listed") or axis["tuples"])
