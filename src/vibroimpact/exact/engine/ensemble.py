"""Simulate many initial states and systems; return summary statistics instead of events."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from vibroimpact.exact.engine import event_loop as kernel
from vibroimpact.exact.engine import march
from vibroimpact.exact.engine.all_cores import cores, on_all_cores, stop_if_given_up
from vibroimpact.exact.engine.compiled import compiled, in_place, inlined, inlined_source
from vibroimpact.exact.engine.energy import (
    ENERGY,
    OBSERVED,
    Squares,
    accumulate_energy,
    energies,
    potentials_of,
    work_tables,
)
from vibroimpact.exact.engine.energy import ENTRIES as ACCOUNTED
from vibroimpact.exact.engine.event_loop import FAILURES, FINISHED, PAUSED, Progress, Sampling, Span, run_until
from vibroimpact.exact.engine.flow import OMEGA, RATE, flow_of, numbers_of, unpacked
from vibroimpact.exact.engine.flow_tables import ORDERS, fill_table
from vibroimpact.exact.engine.lanes import WIDTH
from vibroimpact.exact.engine.motion import ENTRIES, EVENTS, ROW, Log, Motion, mode_of
from vibroimpact.exact.engine.phase import TWO_PI, Instant, continues, phase_at
from vibroimpact.exact.engine.replay import FORCING, Departure, first_departure
from vibroimpact.exact.engine.simulation import MOST_CYCLES, NO_TIMES, attempt, checked_window, within_walls
from vibroimpact.exact.engine.statistics import (
    IMPACTS,
    INTEGRALS,
    LARGEST,
    LOST,
    PATH,
    STATISTICS,
    STICKS,
    STORED,
    accumulate_statistics,
    discount_rests,
    open_or_close,
)
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
        ("sticks", "i8", (2,)),
        ("largest", "f8", (2,)),
        ("mean_square", "f8", (2,)),
        ("ball_speed", "f8", (2,)),
    ]
)
"""Data type of the outcome of a run: status, a key of STATUSES; the final state; and, for each module over the observed
cycles, the numbers of impacts and sticks, the largest |X_i|, and the time averages of X_i^2 and |Y_i'|."""
WITH_ENERGY = np.dtype([*OUTCOME.descr, ("energy", ENERGY)])
"""OUTCOME with the energy balance."""

FIELDS = {"impacts": IMPACTS, "sticks": STICKS, "largest": LARGEST, "ball_speed": PATH, "mean_square": INTEGRALS}
MEANS = slice(PATH, INTEGRALS + 2)
ENERGIES = [*range(INTEGRALS + 2, STATISTICS), LOST, LOST + 1, STORED]
UNOBSERVED = np.empty((1, 4, 0, 6, 6)), np.empty((1, 4, 0))
"""Indices of time integrals, and of a row of `energy.energies`; empty tables for runs without observation."""
MOST_RUNS, SHARES = 1024, 4
"""Largest number of runs in a piece of work; pieces per core if there are many runs."""
DEFERRED = INADMISSIBLE + 1
MOST_LOG_RATIO = np.log(4.0)  # of the rates of boxes and forcing; beyond it a flight takes many steps, each rounded
TABLE = 64  # times in the flow tables of the event loop, which handles the few events that the lanes cannot
NEAR = 1e-6  # distance from a wall beyond which a ball cannot rest on it
INTERRUPT_INTERVAL = 500_000  # steps of all lanes between two checks for an interrupt, about 20 ms


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
        Initial states, shape (..., 8), by position or by name as for `simulate`. Systems and states broadcast: n
        systems and n states pair by pair, one state with every system, or systems (m, 1) with states (n, 8) in all
        combinations.
    cycles, tau0
        As for `simulate`.
    settle : int, default 0
        Cycles before the observation, from 0 to `cycles`. If settle equals cycles, only the final state is returned.
    progress : bool, default False
        Count finished runs on standard error, about once a second.
    energy : bool, default False
        Add the energy balance over the observed cycles (`Run.energy`) as the field `energy` (ENERGY).
    by_cycle : bool, default False
        Return an outcome for each observed cycle along an additional last axis, with the state at the end of the cycle.

    Returns
    -------
    ndarray
        Structured array (OUTCOME, or WITH_ENERGY) in the broadcast shape. If a run fails, its status (STATUSES) gives
        the reason, its numbers are nan and its counts 0; other runs are not affected. Statistics of a run without
        observed cycles are nan. The largest |X_i| is exact except for turns of a box almost at rest (1e-5 of its path);
        the averages are exact to rounding.

    Raises
    ------
    ValueError
        If an argument is malformed, or if systems and states do not broadcast.

    Notes
    -----
    Impacts and sticks equal those of `simulate`, except for grazing contacts that its certificate counts as undecided,
    and for impacts after which the ball hops by less than four units of rounding. The error of the final state of a
    decided run is at most 2.6 times the estimate of that certificate (docs/engine.md). Use `simulate` for events,
    samples or a certificate.

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
    order = np.argsort(numbers, axis=None, kind="stable")  # runs of one system share its tables
    share = -(-numbers.size // cores())
    size = max(min(MOST_RUNS, share, max(share // SHARES, 8 * WIDTH)), 1)
    pieces = [
        (
            known,
            begins,
            numbers.ravel(),
            starts,
            (settle, cycles, 1 if by_cycle else cycles - settle),
            filled,
            order[first : first + size],
        )
        for first in range(0, len(order), size)
    ]
    on_all_cores(_run, pieces, [len(piece[-1]) for piece in pieces], progress)
    return outcomes[..., : cycles - settle] if by_cycle else outcomes[..., 0]


def finals(system: System, states: ArrayLike, cycles: int) -> np.ndarray:
    """Return the final states (n, 8) of runs of one system from initial states (n, 8) at tau = 0.

    Raises
    ------
    ArithmeticError
        If a run could not be finished.
    ValueError
        As for `ensemble`.
    """
    outcomes = ensemble(system, states, cycles, settle=cycles)
    failed = np.flatnonzero(outcomes["status"] != FINISHED)
    if len(failed):
        raise ArithmeticError(f"start {failed[0]}: {STATUSES[int(outcomes['status'][failed[0]])]}")
    return outcomes["final"]


def _combined(systems, states):
    """Return the distinct systems and, in the broadcast shape, each run's system index and initial state."""
    states = states_array("states", states)
    if states.ndim == 0 or states.shape[-1] != 8:
        raise ValueError(f"states: needs shape (..., 8), got {states.shape}")
    systems, known = np.array(systems, dtype=object), {}
    numbers = [known.setdefault(instance("systems", system, System), len(known)) for system in systems.flat]
    try:
        shape = np.broadcast_shapes(systems.shape, states.shape[:-1])
    except ValueError:
        raise ValueError(
            f"states: their shape {states.shape[:-1]} does not broadcast with that of systems, {systems.shape}"
        ) from None
    numbers = np.array(numbers, dtype=int).reshape(systems.shape)
    return list(known), np.broadcast_to(numbers, shape), np.broadcast_to(states, (*shape, 8))


def _run(known, begins, numbers, starts, stages, outcomes, places):
    """Run the initial states at these places and write their outcomes.

    `stages` is as for `_loop`.
    """
    (settle, cycles, length), first, starts = stages, numbers[places[0]], np.ascontiguousarray(starts[places])
    owners, energy, shape = numbers[places] - first, "energy" in outcomes.dtype.names, (len(places), outcomes.shape[1])
    systems, begins = known[first : first + owners[-1] + 1], begins[first : first + owners[-1] + 1]
    scalars, rates = numbers_of(systems, TABLE)
    alone = abs(np.log(scalars[:, RATE] / scalars[:, OMEGA])) > MOST_LOG_RATIO
    statistics, final = np.zeros((*shape, STATISTICS)), np.full((*shape, 8), np.nan)
    status = np.where(within_walls(starts), FINISHED, INADMISSIBLE)
    potentials, drifts = UNOBSERVED
    if settle < cycles:
        potentials, drifts, sound = potentials_of(rates[:, 0], OBSERVED if energy else OBSERVED[:2])
        alone |= ~sound
    phases = np.array([phase_at(begin, system.Omega) for begin, system in zip(begins, systems, strict=True)])
    single = np.flatnonzero(alone[owners] & (status == FINISHED))
    status[single] = DEFERRED
    runs = owners, starts, stages, status, final, statistics, continues(begins[0])
    piece = Piece(scalars, rates, phases, potentials, drifts, *runs)
    memory = _memory()
    while not _loop(piece, memory):
        stop_if_given_up()
    for n in single:
        status[n] = _single_run(
            systems[owners[n]], starts[n], begins[owners[n]], stages, energy, final[n], statistics[n]
        )
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
            outcomes["energy"][places[owners == owner]] = energies(system, statistics[owners == owner][..., ENERGIES])


def _single_run(system, state, begin, stages, energy, final, statistics):
    """Return the status of a run by `simulate`; write its final states (k, 8) and statistics (k, STATISTICS).

    This is for systems with fast and slow rates, whose flights would take many steps, and for systems whose potentials
    lose accuracy by cancellation.
    """
    (settle, cycles, length), flow = stages, flow_of(system)
    stops = [0] * (settle > 0 or not cycles) + [*range(settle, cycles + 1, max(length, 1))]
    for cycle, stop in pairwise(stops):
        status, run = attempt(system, state, stop - cycle, begin, NO_TIMES, 0.0)
        if status != FINISHED:
            return status
        state, begin, k = run.final.copy(), run.end, max(cycle - settle, 0) // max(length, 1)
        final[k] = run.final
        if settle < stop:
            _, flights, rows = run.trajectory
            end = run.cycles * system.period, flights[0, FORCING]
            observed, squares = statistics[k], Squares(*(part[0] for part in UNOBSERVED))
            _watch(flow, squares, run.start, rows, run.final, end, continues(run.begin), observed)
            if energy:
                energy_rows = np.zeros((1, ACCOUNTED))
                accumulate_energy(flow, work_tables(system), flights, rows, np.zeros(1), energy_rows)
                observed[INTEGRALS + 2 :] = energy_rows[0, : STATISTICS - INTEGRALS - 2]
    return FINISHED


@compiled
def _watch(flow, squares, start, rows, final, end, continued, statistics):
    """Add the statistics of a finished run.

    end: its duration and phase; continued: True if it continues another run.
    """
    leaving, (duration, phase) = first_departure(start, end[1]), end
    last = Motion(*first_departure(final, phase)[:3], (0, 0), np.sin(phase), np.cos(phase))
    open_or_close(flow, squares, Motion(*leaving[:3], (0, 0), last.sine, last.cosine), -1.0, statistics)
    accumulate_statistics(flow, squares, leaving, rows, len(rows), (last.boxes, duration, phase), statistics)
    open_or_close(flow, squares, last, 1.0, statistics)
    if continued:
        discount_rests(rows, len(rows), statistics)


class Piece(NamedTuple):
    """Runs to be computed, and their results.

    numbers, rates, phases, potentials, drifts: of each system. owners (n,): the system of each initial state. starts
    (n, 8). stages: cycles before the observation, cycles in all, and cycles in each of its k windows. status (n,);
    final (n, k, 8); statistics (n, k, STATISTICS). continued: the runs continue others.
    """

    numbers: np.ndarray
    rates: np.ndarray
    phases: np.ndarray
    potentials: np.ndarray
    drifts: np.ndarray
    owners: np.ndarray
    starts: np.ndarray
    stages: tuple[int, int, int]
    status: np.ndarray
    final: np.ndarray
    statistics: np.ndarray
    continued: bool = False


class Memory(NamedTuple):
    """Runs in the lanes and their data, between two calls of the loop.

    runs, constants: rows of `march`; work: its workspace. members: the initial state in each lane, or -1; begun: number
    of initial states processed. slots: position of the tables of each lane's system; owners: their systems; made:
    contact states with tables. series, rotations: `flow_tables.tables`; known: constants. rows, counters, statistics,
    change: workspace.
    """

    runs: np.ndarray
    constants: np.ndarray
    work: np.ndarray
    members: np.ndarray
    begun: np.ndarray
    slots: np.ndarray
    owners: np.ndarray
    made: np.ndarray
    series: np.ndarray
    rotations: np.ndarray
    known: np.ndarray
    rows: np.ndarray
    counters: np.ndarray
    statistics: np.ndarray
    change: np.ndarray


def _memory():
    return Memory(
        np.zeros((march.STATES, WIDTH)),
        np.zeros((march.CONSTANTS, WIDTH)),
        np.empty((2 * march.ORDER + 2, WIDTH)),
        np.full(WIDTH, -1),
        np.zeros(1, dtype=int),
        np.zeros(WIDTH, dtype=int),
        np.full(WIDTH, -1),
        np.zeros((WIDTH, 4), dtype=bool),
        np.empty((WIDTH, 4, TABLE, 6, 2 * ORDERS)),
        np.empty((WIDTH, TABLE, 2)),
        np.zeros((WIDTH, march.CONSTANTS)),
        np.empty((2 * kernel.MOST_AT_ONCE, ROW)),
        np.zeros((WIDTH, ENTRIES)),
        np.zeros(STATISTICS),
        np.zeros((2, 6, 6)),
    )


@compiled
def _loop(piece, memory):
    """Run the initial states of a piece whose status is FINISHED, as many at once as there are lanes.

    Writes their status, final states and statistics. Returns False if it pauses for an interrupt; then call it again.
    """
    m, stages, steps = memory, piece.stages, 0
    integrals = piece.drifts.shape[2] if stages[0] < stages[1] else 0
    squares = Squares(piece.potentials[0], piece.drifts[0])  # gives the compiler the type
    while True:
        alive = 0
        for lane in range(WIDTH):
            while m.members[lane] < 0 and m.begun[0] < len(piece.starts):
                n = m.begun[0]
                m.begun[0] += 1
                if piece.status[n] == FINISHED:
                    _begin(piece, n, lane, m)
            alive += m.members[lane] >= 0
            if m.members[lane] < 0:
                m.runs[march.ALIVE, lane] = 0.0
        if alive == 0:
            return True
        if steps > INTERRUPT_INTERVAL:
            _stop_crowded(piece, m)
            return False
        steps += march.advance_lanes(m.runs, m.constants, m.work, max(3 * alive // 4, 1)) + 16
        if march.step_to_event(m.runs, m.constants, m.work, integrals) == 0:
            continue
        for lane in range(WIDTH):
            outcome, n = m.runs[march.OUTCOME, lane], m.members[lane]
            if n < 0 or outcome == march.NOTHING:
                continue
            steps += 64
            owner, slot = piece.owners[n], m.slots[lane]
            flow = unpacked(piece.numbers[owner], m.series[slot], m.rotations[slot])
            if integrals > 0:
                squares = Squares(piece.potentials[owner], piece.drifts[owner])
            if outcome == march.DOUBTFUL:
                ended = _by_events(piece, flow, squares, n, lane, m)
            else:
                stop, motion = m.runs[march.STOP, lane], _motion_of(m.runs, lane)
                ended = FINISHED if _is_last(piece, flow, squares, motion, n, lane, m) else PAUSED
                m.runs[march.PHASE, lane], m.runs[march.TAIL, lane] = piece.phases[owner]
                m.runs[march.TURNS, lane], m.runs[march.TRIAL, lane], m.runs[march.REACH, lane] = stop, 0.0, 0.0
            if ended != PAUSED:
                piece.status[n], m.members[lane] = ended, -1


@in_place
def _is_last(piece, flow, squares, motion, n, lane, m):
    """Return True if a run is at its end.

    Closes the window of its observation that ends there, or opens the next.
    """
    settle, cycles, length = piece.stages
    stop, watched = int(m.runs[march.STOP, lane]), m.runs[march.WATCHED, lane] > 0.0
    if watched or stop == cycles:
        k = (stop - settle) // length - 1 if watched else 0
        for i in range(4):
            piece.final[n, k, 2 * i], piece.final[n, k, 2 * i + 1] = motion.boxes[i], motion.balls[i]
        if watched:
            march.find_turns(m.runs, m.constants, m.work)
            _read(m, lane)
            open_or_close(flow, squares, motion, 1.0, m.statistics)
            for place in range(STATISTICS):
                piece.statistics[n, k, place] = m.statistics[place]
    if stop == cycles:
        return True
    m.runs[march.STOP, lane], m.runs[march.WATCHED, lane] = stop + length, 1.0
    m.statistics[:] = 0.0
    open_or_close(flow, squares, motion, -1.0, m.statistics)
    _write(m, lane)
    return False


@in_place
def _stop_crowded(piece, m):
    """Stop runs with too many events."""
    most = kernel.MOST_EVENTS + kernel.MOST_EVENTS_PER_CYCLE * float(piece.stages[1])
    for lane in range(WIDTH):
        if m.members[lane] >= 0 and m.runs[march.EVENTS, lane] > most:
            piece.status[m.members[lane]], m.members[lane] = kernel.CROWDED, -1


@inlined_source
def _begin(piece, n, lane, m):
    """Put an initial state into a lane."""
    owner, slot, stages = piece.owners[n], -1, piece.stages
    for k in range(WIDTH):
        if m.owners[k] == owner:
            slot = k
    if slot < 0:
        for k in range(WIDTH):
            free = True
            for other in range(WIDTH):
                free = free and not (m.members[other] >= 0 and m.slots[other] == k)
            if free:
                slot = k
        m.owners[slot], m.made[slot, 0] = owner, True
        m.made[slot, 1:] = False
        flow = unpacked(piece.numbers[owner], m.series[slot], m.rotations[slot])
        j = int(march.LONGEST_STEP / max(flow.rate, flow.coefficients.omega) * flow.density)
        fill_table(piece.rates[owner], np.intp(0), flow.spacing, flow.series, flow.rotations, j, m.change)
        _fill_constants(piece, owner, flow, m.change, j * flow.spacing, m.known[slot])
    m.members[lane], m.slots[lane], m.counters[lane] = n, slot, 0.0
    m.constants[:, lane], m.runs[:, lane] = m.known[slot], 0.0
    for i in range(4):
        m.runs[march.X1 + i, lane], m.runs[march.Y1 + i, lane] = piece.starts[n, 2 * i], piece.starts[n, 2 * i + 1]
    m.runs[march.PHASE, lane], m.runs[march.TAIL, lane] = piece.phases[owner]
    m.runs[march.ALIVE, lane], m.runs[march.DUE, lane], m.runs[march.STOP, lane] = 1.0, -1.0, stages[0]
    m.runs[march.SINE, lane], m.runs[march.COSINE, lane] = (
        np.sin(piece.phases[owner, 0]),
        np.cos(piece.phases[owner, 0]),
    )
    if stages[0] == 0 < stages[1]:
        flow = unpacked(piece.numbers[owner], m.series[slot], m.rotations[slot])
        squares = Squares(piece.potentials[owner], piece.drifts[owner])
        _is_last(piece, flow, squares, _motion_of(m.runs, lane), n, lane, m)


@inlined
def _motion_of(runs, lane):
    r, k = runs[:, lane], march.Y1
    boxes, balls = (r[0], r[1], r[2], r[3]), (r[k], r[k + 1], r[k + 2], r[k + 3])
    return Motion(boxes, balls, (0, 0), (0, 0), r[march.SINE], r[march.COSINE])


@inlined
def _read(m, lane):
    for k in range(STATISTICS):
        m.statistics[k] = m.runs[march.STATISTICS_AT + k, lane]


@inlined
def _write(m, lane):
    for k in range(STATISTICS):
        m.runs[march.STATISTICS_AT + k, lane] = m.statistics[k]


@inlined_source
def _fill_constants(piece, owner, flow, change, step, c):
    """Write the constants (CONSTANTS,) of a system."""
    q, phase = flow.coefficients, piece.phases[owner]
    for row in range(4):
        for k in range(6):
            c[6 * row + k] = change[0, row, k]
        for k in range(4):
            c[march.LOW_PARTS + 4 * row + k] = change[1, row, k]
    c[march.CA], c[march.SA], c[march.STEP] = change[0, 4, 4], change[0, 4, 5], step
    c[march.K11], c[march.K12], c[march.K22], c[march.C11], c[march.C12], c[march.C22] = (
        q.k11, q.k12, q.k22, q.c11, q.c12, q.c22
    )  # fmt: skip
    c[march.F1], c[march.F2], c[march.OMEGA], c[march.EPSILON], c[march.KAPPA] = q.f1, q.f2, q.omega, q.epsilon, q.kappa
    c[march.IMPULSE], c[march.REST], c[march.GROUND], c[march.DRIVE] = q.impulse, q.impulse_rest, q.ground, q.drive
    far, w, rate = max(1.0, 1.0 / np.sqrt(q.ground)), q.omega, flow.rate
    c[march.BEND] = far * rate**4 / 72
    c[march.BEND_FORCE] = far * q.drive * (rate**3 + rate * rate * w + rate * w * w + w**3) / 72
    c[march.ROUNDING], c[march.LEAST_ROUNDING] = march.ROUNDED * 6.0 * far, march.ROUNDED * (2.0 + q.shift)
    c[march.UNIT], c[march.FIRST], c[march.FIRST_TAIL] = flow.unit, phase[0], phase[1]
    c[march.LOSS] = 0.5 * q.epsilon * q.inverse_mass * (1.0 - q.kappa) * (1.0 + q.kappa)
    for k in range(piece.drifts.shape[2]):
        c[march.DRIFTS + k] = piece.drifts[owner, 0, k]
        for i in range(2):
            for z in range(6):
                c[march.DROPS + 12 * k + 6 * i + z] = piece.potentials[owner, 0, k, 2 + i, z]


@inlined_source
def _by_events(piece, flow, squares, n, lane, m):
    """Continue the run of a lane by the event loop until both balls fly.

    Returns PAUSED, or the status of a finished run.
    """
    runs, counters, unsampled = m.runs, m.counters[lane], Sampling(0.0, np.empty(0), np.empty((0, 8)))
    first = m.constants[march.FIRST, lane], m.constants[march.FIRST_TAIL, lane]
    phase, tail, turns = runs[march.PHASE, lane], runs[march.TAIL, lane], int(runs[march.TURNS, lane])
    elapsed = (turns * TWO_PI + ((phase - first[0]) + (tail - first[1]))) / flow.coefficients.omega
    stalled, due = int(runs[march.STALLED, lane]), int(runs[march.DUE, lane])
    progress = Progress(_motion_of(runs, lane), due, phase, tail, turns, elapsed, 0, stalled)
    while True:
        _make_tables(flow, piece.rates[piece.owners[n]], progress, m.made[m.slots[lane]], m.change)
        stop = int(runs[march.STOP, lane])
        counters[EVENTS] = 0.0
        motion, log, earlier = progress.motion, Log(m.rows, counters), runs[march.EVENTS, lane]
        leaving = Departure(motion.boxes, motion.balls, motion.walls, progress.elapsed, progress.phase)
        progress, ended = run_until(flow, progress, Span(*first, stop), unsampled, log, earlier, np.int64(0))
        noted, motion = int(counters[EVENTS]), progress.motion
        runs[march.EVENTS, lane] += noted
        if runs[march.WATCHED, lane] > 0.0:
            _read(m, lane)
            accumulate_statistics(
                flow, squares, leaving, m.rows, noted, (motion.boxes, progress.elapsed, progress.phase), m.statistics
            )
            if piece.continued:
                discount_rests(m.rows, noted, m.statistics)
            _write(m, lane)
        sine, cosine = np.sin(progress.phase), np.cos(progress.phase)
        motion = Motion(motion.boxes, motion.balls, motion.walls, (0, 0), sine, cosine)
        if ended == FINISHED and not _is_last(piece, flow, squares, motion, n, lane, m):
            continue
        if ended != PAUSED or mode_of(motion.walls) == 0:
            break
    for i in range(4):
        runs[march.X1 + i, lane], runs[march.Y1 + i, lane] = motion.boxes[i], motion.balls[i]
    runs[march.PHASE, lane], runs[march.TAIL, lane], runs[march.TURNS, lane] = (
        progress.phase, progress.tail, progress.revolutions
    )  # fmt: skip
    runs[march.SINE, lane], runs[march.COSINE, lane] = motion.sine, motion.cosine
    runs[march.DUE, lane], runs[march.STALLED, lane] = progress.due, progress.stalled
    runs[march.TRIAL, lane] = runs[march.REACH, lane] = runs[march.PASSED, lane] = 0.0
    runs[march.TOUCH1, lane] = runs[march.TOUCH2, lane] = runs[march.Y1_LOW, lane] = runs[march.Y2_LOW, lane] = 0.0
    return ended


@inlined_source
def _make_tables(flow, rates, progress, made, change):
    """Compute the tables of the contact states that the next events can lead to."""
    motion = progress.motion
    modes = mode_of(motion.walls)
    for i in range(2):
        near = abs(motion.boxes[i] - motion.balls[i]) > 1.0 - NEAR
        modes |= (1 << i) if near or progress.due == i else 0
    for mode in range(4):
        if mode | modes == modes and not made[mode]:
            fill_table(rates, np.intp(mode), flow.spacing, flow.series, flow.rotations, np.intp(0), change)
            made[mode] = True
