"""Compute the observations of a sweep at one point of its grid."""

import numpy as np

from vibroimpact.exact.engine.event_loop import FINISHED
from vibroimpact.exact.lanes.ensemble import ensemble
from vibroimpact.studies.absorbers.peaks import by_cycle, peak_of
from vibroimpact.studies.regimes.classification import REGIMES
from vibroimpact.studies.regimes.classification import starts as spread_starts
from vibroimpact.studies.regimes.families import FixedPoints
from vibroimpact.studies.regimes.settling import Observation, settle
from vibroimpact.studies.sweeps.cost import RUNS
from vibroimpact.studies.sweeps.grid import Grid, axis
from vibroimpact.studies.sweeps.spec import Spec
from vibroimpact.system.state import inactive_at_rest
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points

FROM_REST = "from_rest"


def observed(system, spec: Spec) -> dict:
    """Return the values of all observations at one point, by name of the column.

    An inactive module is put at rest.
    """
    simulates = not {"peaks", "regimes", *RUNS}.isdisjoint(spec.observe)
    states = inactive_at_rest(system, spread_starts(spec.starts, spec.seed)) if simulates else None
    row = {}
    for columns, values in map(OBSERVATIONS.get, spec.observe):
        row |= zip(columns, values(system, states, spec), strict=True)
    return {name: value.item() if isinstance(value, np.generic) else value for name, value in row.items()}


def _regimes(system, states, spec):
    """Return the share of initial states that end in each regime, and the regime in which the state at rest ends."""
    names = [regime.name for regime in settle(system, states, Observation(**spec.observation))]
    return *(names.count(name) / len(names) for name in REGIMES), names[0]


def _amplitudes(system, states, spec):
    """Return three quantities of each module from all finished runs, and the number of unfinished runs.

    The quantities are the largest |X_i|, the root mean square of X_i, and the mean speed of ball i.
    """
    runs = ensemble(system, states, spec.cycles, settle=spec.settle)
    done = runs[runs["status"] == FINISHED]
    if not len(done):
        return *[np.nan] * 6, len(runs)
    rms = np.sqrt(done["mean_square"].mean(axis=0))
    return *done["largest"].max(axis=0), *rms, *done["ball_speed"].mean(axis=0), len(runs) - len(done)


def _peaks(system, states, spec):
    """Return the highest displacement peak among all parameter values in `spec.band`, and three further numbers.

    The further numbers are the largest root mean square of X_1 or X_2, the parameter value that gives the highest peak,
    and the number of unfinished runs.
    """
    band = Grid(system, [axis(**spec.band)])
    systems = np.array([band.system(number) for number in range(len(band))])
    runs = by_cycle(systems, states, spec.cycles, spec.settle)
    if runs.unfinished == len(systems) * len(states):
        return np.nan, np.nan, np.nan, runs.unfinished
    peaks = peak_of(runs.largest)
    at = next(iter(band.place(int(np.nanargmax(peaks))).values()))
    return np.nanmax(peaks), runs.rms, at, runs.unfinished


def _energy(system, states, spec):
    """Return (energy that impacts dissipate) / (work of the forces), and the number of runs without impacts.

    Energy and work are summed over all finished runs with impacts. The number of runs without impacts does not include
    unfinished runs.
    """
    runs = ensemble(system, states, spec.cycles, settle=spec.settle, energy=True)
    done = runs[runs["status"] == FINISHED]
    hits = done["impacts"].any(axis=1)
    energy = done["energy"][hits]
    work = energy["work"].sum()
    return energy["impacts"].sum() / work if work else np.nan, np.count_nonzero(~hits)


def fixed_point_counts(system) -> tuple[int, int]:
    """Return the number of fixed points of the slow flow, and how many of them the theory calls stable."""
    points = fixed_points(system)
    return len(points), sum(FixedPoints.stable(system, point) for point in points)


OBSERVATIONS = {
    "regimes": ((*REGIMES, FROM_REST), _regimes),
    "amplitudes": (
        ("largest_X1", "largest_X2", "rms_X1", "rms_X2", "ball_speed_1", "ball_speed_2", "unfinished"),
        _amplitudes,
    ),
    "peaks": (("peak", "peak_rms", "peak_at", "peak_unfinished"), _peaks),
    "energy": (("impact_share", "starts_without_impacts"), _energy),
    "fixed_points": (("fixed_points", "stable_points"), lambda system, states, spec: fixed_point_counts(system)),
}
"""Columns of each observation, in order, and the function of (system, states, spec) that returns their values."""
