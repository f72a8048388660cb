"""Simulate many initial states and systems; return summary statistics instead of events."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact.exact.engine import energy as energy_balance
from vibroimpact.exact.engine.all_cores import cores, on_all_cores, stop_if_cancelled
from vibroimpact.exact.engine.energy import ENERGY, OBSERVED, energies
from vibroimpact.exact.engine.event_loop import FAILURES, FINISHED
from vibroimpact.exact.engine.flow import OMEGA, RATE, Instant, numbers_of, phase_at
from vibroimpact.exact.engine.simulation import MOST_CYCLES, NO_TIMES, attempt, checked_window, within_walls
from vibroimpact.exact.engine.variation import FORCING
from vibroimpact.exact.engine.vectors import WIDTH
from vibroimpact.exact.lanes import loop
from vibroimpact.exact.lanes.rows import IMPACTS, INTEGRALS, LARGEST, PATH, STATISTICS
from vibroimpact.exact.lanes.statistics import accumulate_run
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, whole
from vibroimpact.system.state import states_array

INADMISSIBLE = max(FAILURES) + 1
STATUSES = {FINISHED: "finished", **FAILURES, INADMISSIBLE: "the start is not finite, or has a ball beyond a wall"}
"""Meaning of the status of a run."""

OUTCOME = np.dtype(
    [
        ("status", "i1"),
        ("final", "f8", (8,)),
        ("impacts", "i8", (2,)),
        ("largest", "f8", (2,)),
        ("mean_square", "f8", (2,)),
        ("ball_speed", "f8", (2,)),
    ]
)
"""Data type of the outcome of a run: the status (a key of STATUSES) and the final state; then, for each module and over
the observed cycles: numbers of impacts, largest |X_i|, and time averages of X_i^2 and |Y_i'|."""
WITH_ENERGY = np.dtype([*OUTCOME.descr, ("energy", ENERGY)])
"""OUTCOME with the energy balance."""

FIELDS = {"impacts": IMPACTS, "largest": LARGEST, "ball_speed": PATH, "mean_square": INTEGRALS}
"""For each statistic in OUTCOME, its index for module 1 in a row of statistics; module 2 follows."""
MEANS = slice(PATH, INTEGRALS + 2)
"""Indices of the statistics that become time averages when they are divided by the observed time."""
MOST_RUNS, SHARES = 1024, 4
"""Largest number of runs in a piece of work; number of pieces per core if there are many runs."""
DEFERRED = INADMISSIBLE + 1
"""Status of a run that the lanes skip and `_single_run` computes."""
MOST_LOG_RATIO = np.log(4.0)
"""Largest |log(rate of the boxes / forcing frequency)| for a run in lanes. Beyond this limit a flight consists of many
steps, whose rounding errors add up."""


def ensemble(
    systems: System | Sequence[System] | Sequence[Sequence[System]] | ArrayLike,
    states: ArrayLike,
    cycles: int,
    tau0: float | Fraction | Instant = 0.0,
    settle: int = 0,
    progress: bool = False,
    energy: bool = False,
    by_cycle: bool = False,
) -> np.ndarray:
    """Simulate many initial states and systems on all cores; return summary statistics.

    Parameters
    ----------
    systems : System or array_like of System
        One System, or an array of them (a list or nested lists).
    states : array_like
        Initial states, shape (..., 8). The axes before the last axis are broadcast with the axes of `systems`. For
        example, systems of shape (m, 1) and states of shape (n, 8) give m n runs.
    cycles, tau0
        As for `simulate`.
    settle : int, default 0
        Number of cycles before the observation, at most `cycles`. If settle equals cycles, only final states are
        computed.
    progress : bool, default False
        Show the number of finished runs on standard error.
    energy : bool, default False
        Add a field `energy` (data type ENERGY) with the energy balance of the observed cycles.
    by_cycle : bool, default False
        Return one outcome for each observed cycle, along an additional last axis. The final state of an outcome is then
        the state at the end of its cycle.

    Returns
    -------
    ndarray
        Outcomes of the runs in the broadcast shape. The data type is OUTCOME, or WITH_ENERGY if `energy` is True. If a
        run fails, its status is not 0 (STATUSES gives the meaning), its numbers are nan and its counts are 0. Other
        runs are not affected. If settle equals cycles, the statistics of each run are nan and its counts are 0. The
        averages and the largest |X_i| are exact to rounding, with one exception. If a box is almost at rest near a
        turning point, its largest |X_i| is less exact.

    Raises
    ------
    ValueError
        If an argument is malformed, or if the shapes of systems and states cannot be broadcast.

    Notes
    -----
    `simulate` gives the same numbers of impacts, with two exceptions. First, a grazing contact may be counted
    differently if the certificate of the run counts it as undecided. Second, an impact may be counted differently if
    the ball returns to the same wall from a distance of less than four units of rounding. If a run has no undecided
    contacts, the error of its final state is at most 2.6 times the estimate in the certificate (docs/engine.md). Use
    `simulate` for events, samples or a certificate.

    Examples
    --------
    >>> outcome = vi.ensemble(system, np.zeros((4, 8)), cycles=200, settle=100)
    >>> outcome["largest"].shape
    (4, 2)
    """
    known, numbers, states = _combined(systems, states)
    cycles = whole("cycles", cycles, 0, MOST_CYCLES)
    settle = whole("settle", settle, 0, cycles)
    begins = [checked_window(system, cycles, tau0)[0] for system in known]
    windows = max(cycles - settle, 1) if by_cycle else 1
    outcomes = np.empty((*numbers.shape, windows), WITH_ENERGY if energy else OUTCOME)
    filled, starts = outcomes.reshape(numbers.size, windows), states.reshape(-1, 8)
    # The runs of one system come next to each other, so that they share the flow tables of this system.
    order = np.argsort(numbers, axis=None, kind="stable")
    share = -(-numbers.size // cores())
    size = max(min(MOST_RUNS, share, max(share // SHARES, 8 * WIDTH)), 1)
    shared = known, begins, numbers.ravel(), starts, (settle, cycles, 1 if by_cycle else cycles - settle), filled
    pieces = [(*shared, order[first : first + size]) for first in range(0, len(order), size)]
    on_all_cores(_run, pieces, [len(piece[-1]) for piece in pieces], progress)
    return outcomes[..., : cycles - settle] if by_cycle else outcomes[..., 0]


def finals(system: System, states: ArrayLike, cycles: int) -> np.ndarray:
    """Return the final states of one system after `cycles` cycles, shape (n, 8).

    states: initial states at tau = 0, shape (n, 8). Raise ArithmeticError if a run fails.
    """
    outcomes = ensemble(system, states, cycles, settle=cycles)
    failed = np.flatnonzero(outcomes["status"] != FINISHED)
    if len(failed):
        raise ArithmeticError(f"run of initial state {failed[0]} failed: {STATUSES[outcomes['status'][failed[0]]]}")
    return outcomes["final"]


def _combined(systems, states):
    """Return the distinct systems, the system index of each run and the initial state of each run.

    The indices have the broadcast shape of the runs. The initial states have this shape with an additional last axis
    of length 8.
    """
    states = states_array("states", states)
    if states.ndim == 0 or states.shape[-1] != 8:
        raise ValueError(f"states: needs shape (..., 8), got {states.shape}")
    systems, known = np.array(systems, dtype=object), {}
    numbers = [known.setdefault(instance("systems", system, System), len(known)) for system in systems.flat]
    try:
        shape = np.broadcast_shapes(systems.shape, states.shape[:-1])
    except ValueError:
        raise ValueError(
            f"states: the shape {states.shape} does not fit; all axes but the last must broadcast with the shape "
            f"{systems.shape} of systems"
        ) from None
    numbers = np.array(numbers, dtype=int).reshape(systems.shape)
    return list(known), np.broadcast_to(numbers, shape), np.broadcast_to(states, (*shape, 8))


def _run(known, begins, numbers, starts, stages, outcomes, places):
    """Simulate the runs whose indices are in `places`, and write their results to `outcomes`.

    known: distinct systems.
    begins: initial time of the runs of each system.
    numbers: index of the system of each run.
    starts: initial state of each run.
    stages: numbers of cycles as in `loop.Piece`.
    """
    (settle, cycles, length), first, starts = stages, numbers[places[0]], np.ascontiguousarray(starts[places])
    owners, energy, shape = numbers[places] - first, "energy" in outcomes.dtype.names, (len(places), outcomes.shape[1])
    systems, begins = known[first : first + owners[-1] + 1], begins[first : first + owners[-1] + 1]
    scalars, rates = numbers_of(systems, loop.TABLE)
    # A system is not suitable for lanes if its flights need too many steps or if its potentials lose digits.
    alone = abs(np.log(scalars[:, RATE] / scalars[:, OMEGA])) > MOST_LOG_RATIO
    potentials, drifts = np.empty((len(systems), 4, 0, 6, 6)), np.empty((len(systems), 4, 0))
    if settle < cycles:
        potentials, drifts, sound = energy_balance.potentials_of(rates[:, 0], OBSERVED if energy else OBSERVED[:2])
        alone |= ~sound
    statistics, final = np.zeros((*shape, STATISTICS)), np.full((*shape, 8), np.nan)
    status = np.where(within_walls(starts), FINISHED, INADMISSIBLE)
    phases = np.array([phase_at(begin, system.Omega) for begin, system in zip(begins, systems, strict=True)])
    single = np.flatnonzero(alone[owners] & (status == FINISHED))
    status[single] = DEFERRED
    runs = owners, starts, stages, status, final, statistics
    piece, memory = loop.Piece(scalars, rates, phases, potentials, drifts, *runs), loop.memory()
    while not loop.run_lanes(piece, memory):
        stop_if_cancelled()
    for n in single:
        status[n] = _single_run(systems[owners[n]], starts[n], begins[owners[n]], stages, final[n], statistics[n])
    failed = status != FINISHED
    final[failed], statistics[failed, :, :LARGEST], statistics[failed, :, LARGEST:] = np.nan, 0.0, np.nan
    if settle == cycles:
        statistics[..., LARGEST:] = np.nan
    else:
        statistics[..., MEANS] /= length * np.array([system.period for system in systems])[owners, None, None]
    outcomes["status"][places], outcomes["final"][places] = status[:, None], final
    for name, place in FIELDS.items():
        outcomes[name][places] = statistics[..., place : place + 2]
    if energy:
        for owner, system in enumerate(systems):
            outcomes["energy"][places[owners == owner]] = energies(system, statistics[owners == owner][..., INTEGRALS:])


def _single_run(system, state, begin, stages, final, statistics):
    """Compute a run by the event loop instead of in a lane; return its status.

    final: array for the states at the ends of the k observation windows, shape (k, 8).
    statistics: array for the statistics of each window, shape (k, STATISTICS).
    """
    (settle, cycles, length), squares = stages, energy_balance.squares_of(system)
    stops = [0] * (settle > 0 or not cycles) + [*range(settle, cycles + 1, max(length, 1))]
    for cycle, stop in pairwise(stops):
        status, run = attempt(system, state, stop - cycle, begin, NO_TIMES, 0.0)
        if status != FINISHED:
            return status
        state, begin, k = run.final.copy(), run.end, max(cycle - settle, 0) // max(length, 1)
        final[k] = run.final
        if settle < stop:
            flow, flights, rows = run.trajectory
            end = run.cycles * system.period, flights[0, FORCING]
            accumulate_run(flow, squares, run.start, rows, run.final, end, statistics[k])
            if squares.drifts.size == 0:
                row = np.zeros((1, energy_balance.ENTRIES))
                energy_balance.accumulate_energy(flow, flights, rows, squares, end[0], row)
                statistics[k, INTEGRALS : INTEGRALS + len(OBSERVED)] = row[0, : len(OBSERVED)]
    return FINISHED
