"""Simulate many initial states and systems; return summary statistics in place of events."""

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact.exact.engine.all_cores import cores, on_all_cores, stop_if_given_up
from vibroimpact.exact.engine.compiled import compiled, unfolded
from vibroimpact.exact.engine.energy import ENERGY, ENTRIES, Squares, account, energies, powers_of, squares_of
from vibroimpact.exact.engine.event_loop import (
    EARLIER,
    FAILURES,
    FINISHED,
    PAUSED,
    PLACES,
    SPELL,
    go_on,
    keep_progress,
    kept_progress,
    memory,
)
from vibroimpact.exact.engine.event_loop import MOST_AT_ONCE as MOST_EVENTS_AT_ONCE
from vibroimpact.exact.engine.flow import tables_of, unpacked
from vibroimpact.exact.engine.lane_step import APPROACH as SPEED
from vibroimpact.exact.engine.lane_step import AT, DONE, DUE, MID, NOTES, ROWS, STATE, TAIL, step_lanes
from vibroimpact.exact.engine.lane_step import COSINE as COSINE_AT
from vibroimpact.exact.engine.lane_step import PHASE as PHASE_AT
from vibroimpact.exact.engine.lane_step import RESIDUAL as MISSED
from vibroimpact.exact.engine.lane_step import SINE as SINE_AT
from vibroimpact.exact.engine.lane_step import TIME as WHEN
from vibroimpact.exact.engine.lane_step import WALL as HIT
from vibroimpact.exact.engine.lanes import WIDTH
from vibroimpact.exact.engine.motion import (
    APPROACH,
    COSINE,
    EVALUATIONS,
    EVENTS,
    FLIGHTS,
    PHASE,
    RESIDUAL,
    ROW,
    SINE,
    Log,
    pack,
)
from vibroimpact.exact.engine.motion import ENTRIES as COUNTERS
from vibroimpact.exact.engine.observation import IMPACTS, LARGEST, PATH, SEEN, SQUARE, STICKS, observe
from vibroimpact.exact.engine.phase import Instant, phase_at
from vibroimpact.exact.engine.replay import departures
from vibroimpact.exact.engine.simulation import MOST_CYCLES, checked_window, within_walls
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, reals, whole
from vibroimpact.system.state import IMPACT

INADMISSIBLE = max(FAILURES) + 1
STATUSES = {FINISHED: "finished", **FAILURES, INADMISSIBLE: "the start is not finite, or has a ball beyond a wall"}
"""Meaning of the status of a run."""

OUTCOME = np.dtype(
    [
        ("status", "i1"),
        ("final", "f8", (8,)),
        ("impacts", "i8", (2,)),
        ("sticks", "i8", (2,)),
        ("largest", "f8", (2,)),
        ("mean_square", "f8", (2,)),
        ("ball_speed", "f8", (2,)),
    ]
)
"""Outcome of a run: status, a key of STATUSES; the final state; for each module over the observed cycles the numbers of
impacts and of sticks, the largest |X_i|, the means over time of X_i^2 and of |Y_i'|."""
WITH_ENERGY = np.dtype([*OUTCOME.descr, ("energy", ENERGY)])
"""The same with the energy balance."""

FIELDS = {"impacts": IMPACTS, "sticks": STICKS, "largest": LARGEST, "mean_square": SQUARE, "ball_speed": PATH}
NO_POWERS = np.empty((0, 0, 0, 0))
NOTHING = Squares(NO_POWERS, np.empty((0, 0)), NO_POWERS)
FEWEST = 3
"""Least number of runs for a step of all lanes."""
MOST_AT_ONCE, SHARES = 1024, 4
"""Runs in a piece of work; pieces per core if there are fewer runs."""


def ensemble(
    systems: System | Sequence[System] | Sequence[Sequence[System]] | ArrayLike,
    states: ArrayLike,
    cycles: int,
    tau0: float | Fraction | Instant = 0.0,
    settle: int = 0,
    progress: bool = False,
    energy: bool = False,
) -> np.ndarray:
    """Simulate many initial states, of one system or of many, on all cores; return summary statistics.

    Final states are those of `simulate`, bit by bit; for events, samples or a certificate use `simulate`. Each core
    holds the events of eight runs, about a kilobyte per cycle and run. The tables of a system take one or two
    milliseconds, several more with the energy.

    Args:
        systems: a System, or an array of them (a list, or lists in a list).
        states: (..., 8) starts, as for `simulate`. Systems and starts are combined as NumPy combines arrays: n systems
            and n starts pair by pair, one start with every system, systems (m, 1) with starts (n, 8) all with all.
        cycles, tau0: as for `simulate`.
        settle: cycles before the observation, from 0 to cycles; if all, only the final state is returned.
        progress: count finished runs on standard error, about once a second.
        energy: add the energy balance over the observed cycles (`Run.energy`) as the field energy (ENERGY).

    Returns:
        A structured array (OUTCOME, or WITH_ENERGY) in the shape of the combination. The status (STATUSES) of a run
        that failed gives the reason; its numbers are nan and its counts 0, and other runs are not affected. Numbers of
        a run that was not observed are nan, too. The largest |X_i| is exact except for turns of a box almost at rest
        (1e-5 of its path); the means are exact to rounding.

    Raises:
        ValueError: an argument is malformed, or systems and states cannot be combined.
    """
    known, numbers, states = _combined(systems, states)
    cycles = whole("cycles", cycles, 0, MOST_CYCLES)
    settle = whole("settle", settle, 0, cycles)
    begins = [checked_window(system, cycles, tau0)[0] for system in known]
    outcomes = np.empty(numbers.shape, WITH_ENERGY if energy else OUTCOME)
    filled, starts = outcomes.reshape(-1), states.reshape(-1, 8)
    order = np.argsort(numbers, axis=None, kind="stable")
    ends = np.cumsum([0, *np.bincount(numbers.ravel(), minlength=len(known))])
    pieces, most = [], min(MOST_AT_ONCE, -(-numbers.size // (SHARES * cores())))
    for system, begin, first, end in zip(known, begins, ends[:-1], ends[1:], strict=True):
        if end - first > most:
            tables_of(system), squares_of(system), energy and powers_of(system)  # once, before the threads share them
        pieces += [
            (system, starts, cycles, begin, settle, filled, order[place : min(place + most, end)])
            for place in range(first, end, max(most, 1))
        ]
    on_all_cores(_run, pieces, [len(piece[-1]) for piece in pieces], progress)
    return outcomes


def finals(system: System, states: ArrayLike, cycles: int) -> np.ndarray:
    """Return the final states (n, 8) of runs of one system from initial states (n, 8) at tau = 0.

    Raises:
        ArithmeticError: one of them could not be finished.
        ValueError: as for `ensemble`.
    """
    outcomes = ensemble(system, states, cycles, settle=cycles)
    failed = np.flatnonzero(outcomes["status"] != FINISHED)
    if len(failed):
        raise ArithmeticError(f"start {failed[0]}: {STATUSES[int(outcomes['status'][failed[0]])]}")
    return outcomes["final"]


def _combined(systems, states):
    """Return the distinct systems and, in the combined shape, the index of each run's system and its initial state."""
    states = reals("states", states)
    if states.ndim == 0 or states.shape[-1] != 8:
        raise ValueError(f"states: needs shape (..., 8), got {states.shape}")
    systems, known = np.array(systems, dtype=object), {}
    numbers = [known.setdefault(instance("systems", system, System), len(known)) for system in systems.flat]
    try:
        shape = np.broadcast_shapes(systems.shape, states.shape[:-1])
    except ValueError:
        raise ValueError(
            f"states: starts in the shape {states.shape[:-1]} do not combine with systems in the shape {systems.shape}"
        ) from None
    numbers = np.array(numbers, dtype=int).reshape(systems.shape)
    return list(known), np.broadcast_to(numbers, shape), np.broadcast_to(states, (*shape, 8))


def _run(system, starts, cycles, begin, settle, outcomes, places):
    """Run the initial states at these places and fill in their outcomes."""
    starts = np.ascontiguousarray(starts[places])
    table, seen = np.empty(len(places), outcomes.dtype), np.zeros((len(places), SEEN))
    spent = np.zeros((len(places) if "energy" in table.dtype.names else 0, 1, ENTRIES))
    observed = cycles - settle
    status, final = np.where(within_walls(starts), FINISHED, INADMISSIBLE), np.full((len(places), 8), np.nan)
    squares = squares_of(system) if observed else NOTHING
    powers = powers_of(system) if observed and len(spent) else NO_POWERS
    phase = phase_at(begin, system.Omega)
    tables = tables_of(system)
    given = *tables, squares, powers, starts, *phase, cycles, system.period, settle, status, final, seen, spent
    members, runs, counts = np.full(WIDTH, -1), np.zeros((ROWS, WIDTH)), np.zeros((WIDTH, COUNTERS))
    rows, begun = np.empty((WIDTH, len(memory(cycles)[0]), ROW)), np.zeros(1, dtype=int)
    while not _loop(*given, members, begun, runs, counts, rows):
        if (counts[:, EVENTS] + MOST_EVENTS_AT_ONCE > rows.shape[1]).any():
            rows = np.concatenate((rows, np.empty_like(rows)), axis=1)
        stop_if_given_up()
    seen[:, SQUARE:] /= observed * system.period or np.nan
    table["status"], table["final"] = status, final
    for name, place in FIELDS.items():
        table[name] = seen[:, place : place + 2]
    if len(spent):
        spent[np.isnan(seen[:, LARGEST])] = np.nan
        table["energy"] = energies(system, spent[:, 0])
    outcomes[places] = table


@compiled
def _loop(
    numbers, series, rotations, squares, powers, starts, phase, tail, cycles, period, settle, status, final, seen,
    spent, members, begun, runs, counts, rows
):  # fmt: skip
    """Run the initial states (n, 8) of a piece whose status is FINISHED, as many at once as there are lanes; fill in
    their outcomes.

    members: the start in each lane, or -1; begun: how many starts were looked at; runs, counts, rows: of each lane.
    Returns False where rows are full, or after a while (`integrate`): then call again.
    """
    opening, flow, steps = np.array([settle * period]), unpacked(numbers, series, rotations), 0
    no_times, no_samples, notes, where = np.empty(0), np.empty((0, 8)), np.empty((NOTES, WIDTH)), np.empty(PLACES)
    while True:
        alive = _fill(starts, status, seen, phase, tail, members, begun, runs, counts)
        if alive == 0:
            return True
        together = alive >= FEWEST
        if together:
            step_lanes(flow, runs, (phase, tail), float(cycles), notes)
        full, steps = False, steps + WIDTH
        for lane in range(WIDTH):
            n, counters = members[lane], counts[lane]
            if n < 0:
                continue
            if together and notes[DONE, lane] == 2.0:
                counters[EVALUATIONS] += 1.0
            elif together and notes[DONE, lane] == 1.0:
                _note(notes, lane, settle < cycles, rows[lane], counters, runs)
            else:
                _read(runs, lane, where)
                progress, outcome = go_on(
                    flow, kept_progress(where), (phase, tail), cycles, 0.0, no_times, no_samples,
                    Log(rows[lane], counters), where[EARLIER], 0 if together else SPELL
                )  # fmt: skip
                keep_progress(progress, where)
                _write(where, lane, runs)
                runs[MID, lane] = 0.0
                if outcome != PAUSED:
                    status[n], members[lane] = outcome, -1
                    if outcome == FINISHED:
                        pack(progress.motion.boxes, progress.motion.balls, final[n])
                    if outcome != FINISHED or settle == cycles:
                        seen[n, LARGEST:] = np.nan
                    else:
                        s, events, end = starts[n], rows[lane, : int(counters[EVENTS])], progress.motion.boxes
                        observe(flow, squares, s, events, end, phase, (settle * period, cycles * period), seen[n])
                        if len(powers) > 0:
                            flights = departures(flow.coefficients, s, events, phase, cycles * period)
                            account(flow, powers, flights, events, opening, spent[n])
                    continue
                steps += 0 if together else SPELL
            if counters[EVENTS] + MOST_EVENTS_AT_ONCE > rows.shape[1]:
                if settle < cycles:
                    full = True
                else:  # nobody looks at the events
                    runs[EARLIER, lane] += counters[EVENTS]
                    counters[EVENTS] = 0.0
        if full or steps > SPELL:
            return False


@unfolded
def _fill(starts, status, seen, phase, tail, members, begun, runs, counts):
    """Begin the next runs in free lanes; return the number of lanes in use."""
    alive = 0
    for lane in range(WIDTH):
        while members[lane] < 0 and begun[0] < len(starts):
            n = begun[0]
            begun[0] += 1
            if status[n] == INADMISSIBLE:
                seen[n, LARGEST:] = np.nan
                continue
            members[lane] = n
            for k in range(ROWS):
                runs[k, lane] = 0.0
            for i in range(4):
                runs[i, lane], runs[4 + i, lane] = starts[n, 2 * i], starts[n, 2 * i + 1]
            runs[DUE, lane], runs[PHASE_AT, lane], runs[TAIL, lane] = -1.0, phase, tail
            for k in range(COUNTERS):
                counts[lane, k] = 0.0
        if members[lane] >= 0:
            alive += 1
        else:
            runs[DUE, lane], runs[MID, lane] = -1.0, 0.0
    return alive


@unfolded
def _note(notes, lane, observed, rows, counters, runs):
    """Record an impact and a flight of a lane."""
    counters[FLIGHTS] += 1.0
    counters[EVALUATIONS] += 1.0
    counters[RESIDUAL] = max(counters[RESIDUAL], notes[MISSED, lane])
    if not observed:
        runs[EARLIER, lane] += 1.0
        return
    row, wall = rows[int(counters[EVENTS])], notes[HIT, lane]
    module = abs(wall)
    row[0], row[1], row[2], row[3] = notes[WHEN, lane], module, wall / module, IMPACT
    for k in range(8):
        row[4 + k] = notes[STATE + k, lane]
    row[PHASE], row[APPROACH], row[SINE], row[COSINE] = (
        notes[AT, lane],
        notes[SPEED, lane],
        notes[SINE_AT, lane],
        notes[COSINE_AT, lane],
    )
    counters[EVENTS] += 1.0


@unfolded
def _read(runs, lane, where):
    for k in range(PLACES):
        where[k] = runs[k, lane]


@unfolded
def _write(where, lane, runs):
    for k in range(PLACES):
        runs[k, lane] = where[k]
