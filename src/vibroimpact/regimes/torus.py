"""The torus that a periodic motion leaves behind at a Neimark-Sacker point: its size on a section, swept both ways."""

import numpy as np

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.regimes.basins import stable_response

NUDGE = 1e-3


def size(system, state, cycles: int, discarded: int) -> tuple[float, np.ndarray]:
    """Root mean square distance of the displacements, once per cycle, from their mean; and the state (8,) at the end.

    Zero for a motion that repeats every cycle. `discarded` cycles come before those that count.
    """
    begin = simulate(system, state, discarded).final
    run = simulate(system, begin, cycles, sample_times=np.arange(cycles) * system.period)
    return float(np.sqrt(run.samples[:, :4].var(axis=0).sum())), run.final


def sweep(path, values, cycles: int, discarded: int) -> list[tuple[str, float, float]]:
    """(sweep, value, size) for "down" along falling values from the stable asymmetric orbit, then "up" the same way.

    Each value starts where the last one ended, a little pushed: a jump or a hysteresis shows as a difference. Without
    such an orbit at the largest value the sweep starts from rest.
    """
    values = sorted(values, reverse=True)
    orbit = stable_response(path(values[0]))
    state, rows = np.zeros(8) if orbit is None else orbit.state, []
    for name, order in (("down", values), ("up", values[::-1])):
        for value in order:
            found, state = size(path(value), _pushed(state), cycles, discarded)
            rows.append((name, value, found))
    return rows


def onset(values, sizes) -> tuple[float, float]:
    """Parameter at which a torus sets in, by a straight line through its squared sizes; with standard error.

    Args:
        values, sizes: of at least 3 tori.
    """
    fit, covariance = np.polyfit(np.square(sizes), values, 1, cov=True)
    return float(fit[1]), float(np.sqrt(covariance[1, 1]))


def _pushed(state):
    """The state with every box speed a little changed; the balls stay between the walls."""
    pushed = np.array(state)
    pushed[[4, 6]] += NUDGE
    return pushed
