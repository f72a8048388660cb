"""Simulate many runs, eight at a time in vector lanes; leave events that lanes cannot handle to the event loop."""

import math
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine import event_loop
from vibroimpact.exact.engine.compiled import compiled, in_place, inlined, inlined_source
from vibroimpact.exact.engine.contact import ENTRIES, EVENTS, ROW, Log, Motion
from vibroimpact.exact.engine.energy import Squares
from vibroimpact.exact.engine.event_loop import FINISHED, PAUSED, Progress, run_until
from vibroimpact.exact.engine.flow import TWO_PI, mode_of, unpacked
from vibroimpact.exact.engine.flow_tables import ORDERS, fill_table
from vibroimpact.exact.engine.variation import Departure
from vibroimpact.exact.engine.vectors import WIDTH
from vibroimpact.exact.lanes import rows, steps
from vibroimpact.exact.lanes.rows import STATISTICS, STATISTICS_AT
from vibroimpact.exact.lanes.statistics import accumulate_statistics, find_turns, open_or_close

TABLE = 64  # number of times in a flow table; a short table suffices, since the event loop handles few events
NO_REST_DISTANCE = 1e-6  # a ball farther from a wall than this does not come to rest in one call of `run_until`
INTERRUPT_INTERVAL = 500_000  # number of steps between two checks for an interrupt; these steps take about 20 ms


class Piece(NamedTuple):
    """A piece of work: n runs and their results.

    numbers, rates: scalars and rate matrices of each system, from `flow.numbers_of`.
    phases: forcing phase of each system at the start of its runs, as a float and its rounding remainder.
    potentials, drifts: potentials and drifts of each system, from `energy.potentials_of`.
    owners: index of the system of each run, shape (n,).
    starts: initial state of each run, shape (n, 8).
    stages: three numbers of cycles: before the observation, in the whole run, and in each of the k observation windows.
    status: status of each run, shape (n,).
    final: state of each run at the end of each window, shape (n, k, 8).
    statistics: statistics of each run in each window, shape (n, k, STATISTICS).
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


class Memory(NamedTuple):
    """Runs in the lanes and their data, kept between two calls of `run_lanes`.

    Vector instructions advance eight runs together, one run in each lane. These fields have an entry per lane:
    runs, constants: numbers of the runs and constants of their systems, one column per lane (module `rows`).
    members: index of the run in the lane, or -1 if the lane is free.
    slots: index of the slot that the lane uses.
    counters: counters of the event log.

    A slot contains the flow tables of one system. These fields have an entry per slot:
    owners: index of the system, or -1 if the slot is empty.
    made: for each contact state, True if its tables are computed.
    series, rotations: flow tables.
    known: constants of the system.

    begun: number of runs that are begun or skipped.
    work, log, statistics, change: workspace.
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
    log: np.ndarray
    counters: np.ndarray
    statistics: np.ndarray
    change: np.ndarray


def memory() -> Memory:
    """Return empty memory for `run_lanes`."""
    return Memory(
        runs=np.zeros((rows.STATES, WIDTH)),
        constants=np.zeros((rows.CONSTANTS, WIDTH)),
        work=np.empty((2 * rows.SECOND, WIDTH)),
        members=np.full(WIDTH, -1),
        begun=np.zeros(1, dtype=int),
        slots=np.zeros(WIDTH, dtype=int),
        owners=np.full(WIDTH, -1),
        made=np.zeros((WIDTH, 4), dtype=bool),
        series=np.empty((WIDTH, 4, TABLE, 6, 2 * ORDERS)),
        rotations=np.empty((WIDTH, TABLE, 2)),
        known=np.zeros((WIDTH, rows.CONSTANTS)),
        log=np.empty((2 * event_loop.MOST_AT_ONCE, ROW)),
        counters=np.zeros((WIDTH, ENTRIES)),
        statistics=np.zeros(STATISTICS),
        change=np.zeros((2, 6, 6)),
    )


@compiled
def run_lanes(piece, memory):
    """Simulate the runs of a piece of work in vector lanes; return True when all runs have ended.

    If the function returns False, it has paused so that the caller can handle an interrupt. Then call it again. Before
    the first call, set the status to FINISHED for each run to be simulated. Runs with another status are skipped.
    """
    m, done = memory, 0
    while True:
        alive = _fill_lanes(piece, m)
        if alive == 0:
            return True
        if done > INTERRUPT_INTERVAL:
            most = event_loop.MOST_EVENTS + event_loop.MOST_EVENTS_PER_CYCLE * float(piece.stages[1])
            for lane in range(WIDTH):
                if m.members[lane] >= 0 and m.runs[rows.EVENTS, lane] > most:
                    piece.status[m.members[lane]], m.members[lane] = event_loop.CROWDED, -1
            return False
        done += steps.advance_lanes(m.runs, m.constants, m.work, max(3 * alive // 4, 1)) + 16
        if steps.step_to_event(m.runs, m.constants, m.work, piece.drifts.shape[2]) == 0:
            continue
        for lane in range(WIDTH):
            if m.members[lane] >= 0 and m.runs[rows.OUTCOME, lane] != steps.RUNNING:
                done += 64
                ended = _handle_outcome(piece, lane, m)
                if ended != PAUSED:
                    piece.status[m.members[lane]], m.members[lane] = ended, -1


@inlined_source
def _fill_lanes(piece, m):
    """Begin the next runs in free vector lanes; return the number of lanes in use."""
    alive = 0
    for lane in range(WIDTH):
        while m.members[lane] < 0 and m.begun[0] < len(piece.starts):
            n = m.begun[0]
            m.begun[0] += 1
            if piece.status[n] == FINISHED:
                begin_run(piece, n, lane, m)
        alive += m.members[lane] >= 0
        if m.members[lane] < 0:
            m.runs[rows.ALIVE, lane] = 0.0
    return alive


@inlined_source
def begin_run(piece, n, lane, m):
    """Begin run n of a piece of work in a vector lane."""
    owner, settle, runs = piece.owners[n], piece.stages[0], m.runs[:, lane]
    slot = _slot_of(piece, owner, m)
    m.members[lane], m.slots[lane], m.counters[lane] = n, slot, 0.0
    m.constants[:, lane], runs[:] = m.known[slot], 0.0
    for i in range(4):
        runs[rows.X1 + i], runs[rows.Y1 + i] = piece.starts[n, 2 * i], piece.starts[n, 2 * i + 1]
    phase = piece.phases[owner]
    runs[rows.PHASE], runs[rows.TAIL] = phase
    runs[rows.SINE], runs[rows.COSINE] = math.sin(phase[0]), math.cos(phase[0])
    runs[rows.ALIVE], runs[rows.DUE], runs[rows.STOP] = 1.0, -1.0, settle
    if settle == 0 < piece.stages[1]:
        flow, squares = _system_of(piece, lane, m)
        _end_window(piece, flow, squares, _motion_of(m.runs, lane), lane, m)


@inlined_source
def _slot_of(piece, owner, m):
    """Return the slot with the flow tables of a system.

    If no slot has these tables, compute them in a slot that no lane uses.
    """
    for slot in range(WIDTH):
        if m.owners[slot] == owner:
            return slot
    slot = 0
    for lane in range(WIDTH):
        in_use = False
        for other in range(WIDTH):
            in_use = in_use or (m.members[other] >= 0 and m.slots[other] == lane)
        slot = slot if in_use else lane
    m.owners[slot], m.made[slot, 0] = owner, True
    m.made[slot, 1:] = False
    flow = unpacked(piece.numbers[owner], m.series[slot], m.rotations[slot])
    j = int(rows.LONGEST_STEP / max(flow.rate, flow.coefficients.omega) * flow.density)
    fill_table(piece.rates[owner], np.intp(0), flow.spacing, flow.series, flow.rotations, j, m.change)
    _fill_constants(piece, owner, flow, m.change, j * flow.spacing, m.known[slot])
    return slot


@inlined_source
def _fill_constants(piece, owner, flow, change, step, c):
    """Write the constants of a system to `c`, shape (CONSTANTS,); the module `rows` lists the constants.

    step: duration h of a step. change: exp(A h) - 1 and its rounding remainders.
    """
    q = flow.coefficients
    for row in range(4):
        for k in range(6):
            c[6 * row + k] = change[0, row, k]
        for k in range(4):
            c[rows.LOW_PARTS + 4 * row + k] = change[1, row, k]
    for k in range(piece.numbers.shape[1]):
        c[rows.SCALARS_AT + k] = piece.numbers[owner, k]
    far, w, rate = max(1.0, 1.0 / np.sqrt(q.ground)), q.omega, flow.rate
    c[rows.CA], c[rows.SA], c[rows.STEP] = change[0, 4, 4], change[0, 4, 5], step
    c[rows.BEND] = far * rate**4 / 72
    c[rows.BEND_FORCE] = far * q.drive * (rate**3 + rate * rate * w + rate * w * w + w**3) / 72
    c[rows.ROUNDING], c[rows.LEAST_ROUNDING] = steps.ROUNDED * 6.0 * far, steps.ROUNDED * (2.0 + q.shift)
    c[rows.LOSS] = 0.5 * q.epsilon * q.inverse_mass * (1.0 - q.kappa) * (1.0 + q.kappa)
    c[rows.FIRST], c[rows.FIRST_TAIL] = piece.phases[owner]
    for k in range(piece.drifts.shape[2]):
        c[rows.DRIFTS + k] = piece.drifts[owner, 0, k]
        for i in range(2):
            for z in range(6):
                c[rows.DROPS + 12 * k + 6 * i + z] = piece.potentials[owner, 0, k, 2 + i, z]


@inlined_source
def _system_of(piece, lane, m):
    """Return the flow tables and the potentials for the system of the run in a lane."""
    owner, slot = piece.owners[m.members[lane]], m.slots[lane]
    flow = unpacked(piece.numbers[owner], m.series[slot], m.rotations[slot])
    return flow, Squares(piece.potentials[owner], piece.drifts[owner])


@inlined
def _motion_of(runs, lane):
    r, k = runs[:, lane], rows.Y1
    boxes, balls = (r[0], r[1], r[2], r[3]), (r[k], r[k + 1], r[k + 2], r[k + 3])
    return Motion(boxes, balls, (0, 0), (0, 0), r[rows.SINE], r[rows.COSINE])


@inlined_source
def _handle_outcome(piece, lane, m):
    """Continue the run in a lane after `step_to_event` stopped it.

    Return PAUSED if the run has not ended, otherwise its status.
    """
    flow, squares = _system_of(piece, lane, m)
    if m.runs[rows.OUTCOME, lane] == steps.DOUBTFUL:
        return _run_by_events(piece, flow, squares, lane, m)
    runs, stop = m.runs[:, lane], m.runs[rows.STOP, lane]
    finished = _end_window(piece, flow, squares, _motion_of(m.runs, lane), lane, m)
    runs[rows.PHASE], runs[rows.TAIL] = piece.phases[piece.owners[m.members[lane]]]
    runs[rows.REVOLUTIONS], runs[rows.TRIAL], runs[rows.REACH] = stop, 0.0, 0.0
    return FINISHED if finished else PAUSED


@in_place
def _end_window(piece, flow, squares, motion, lane, m):
    """Write the results of the observation window that ends now, if there is one; return True at the end of the run.

    If the run has not ended, begin the next window and return False.
    """
    (settle, cycles, length), n = piece.stages, m.members[lane]
    stop, watched = int(m.runs[rows.STOP, lane]), m.runs[rows.WATCHED, lane] > 0.0
    if watched or stop == cycles:
        k = (stop - settle) // length - 1 if watched else 0
        for i in range(4):
            piece.final[n, k, 2 * i], piece.final[n, k, 2 * i + 1] = motion.boxes[i], motion.balls[i]
        if watched:
            find_turns(m.runs, m.constants, m.work)
            _read_statistics(m, lane)
            open_or_close(flow, squares, motion, 1.0, m.statistics)
            for place in range(STATISTICS):
                piece.statistics[n, k, place] = m.statistics[place]
    if stop == cycles:
        return True
    m.runs[rows.STOP, lane], m.runs[rows.WATCHED, lane] = stop + length, 1.0
    m.statistics[:] = 0.0
    open_or_close(flow, squares, motion, -1.0, m.statistics)
    _write_statistics(m, lane)
    return False


@inlined
def _read_statistics(m, lane):
    for k in range(STATISTICS):
        m.statistics[k] = m.runs[STATISTICS_AT + k, lane]


@inlined
def _write_statistics(m, lane):
    for k in range(STATISTICS):
        m.runs[STATISTICS_AT + k, lane] = m.statistics[k]


@inlined_source
def _run_by_events(piece, flow, squares, lane, m):
    """Continue the run in a lane by the event loop, until both balls fly or the run ends; return the status.

    If both balls fly again, the status is PAUSED, and the run goes on in the lane. Otherwise the run has ended, and the
    status is that of the finished run.
    """
    runs, counters, unsampled = m.runs[:, lane], m.counters[lane], (0.0, np.empty(0), np.empty((0, 8)))
    first = m.constants[rows.FIRST, lane], m.constants[rows.FIRST_TAIL, lane]
    phase, tail, turns = runs[rows.PHASE], runs[rows.TAIL], int(runs[rows.REVOLUTIONS])
    elapsed = (turns * TWO_PI + ((phase - first[0]) + (tail - first[1]))) / flow.coefficients.omega
    stalled, due, motion = int(runs[rows.STALLED]), int(runs[rows.DUE]), _motion_of(m.runs, lane)
    progress = Progress(motion, due, phase, tail, turns, elapsed, 0, stalled)
    while True:
        _make_tables(flow, piece.rates[piece.owners[m.members[lane]]], progress, m.made[m.slots[lane]], m.change)
        leaving, span = progress, (*first, int(runs[rows.STOP]))
        counters[EVENTS] = 0.0
        log, earlier = Log(m.log, counters), runs[rows.EVENTS]
        progress, ended = run_until(flow, progress, span, unsampled, log, earlier, np.int64(0))
        runs[rows.EVENTS] += int(counters[EVENTS])
        if runs[rows.WATCHED] > 0.0:
            _add_events(flow, squares, leaving, progress, lane, m)
        boxes, balls, walls, _, _, _ = progress.motion
        motion = Motion(boxes, balls, walls, (0, 0), math.sin(progress.phase), math.cos(progress.phase))
        if ended == FINISHED and not _end_window(piece, flow, squares, motion, lane, m):
            continue
        if ended != PAUSED or mode_of(walls) == 0:
            break
    for i in range(4):
        runs[rows.X1 + i], runs[rows.Y1 + i] = motion.boxes[i], motion.balls[i]
    runs[rows.SINE], runs[rows.COSINE] = motion.sine, motion.cosine
    runs[rows.PHASE], runs[rows.TAIL], runs[rows.REVOLUTIONS] = progress.phase, progress.tail, progress.revolutions
    runs[rows.DUE], runs[rows.STALLED] = progress.due, progress.stalled
    runs[rows.TRIAL] = runs[rows.REACH] = runs[rows.PASSED] = 0.0
    runs[rows.TOUCH1] = runs[rows.TOUCH2] = runs[rows.Y1_LOW] = runs[rows.Y2_LOW] = 0.0
    return ended


@inlined_source
def _add_events(flow, squares, leaving, progress, lane, m):
    """Add the statistics of a part of a run to the statistics of the run in its lane.

    leaving, progress: `Progress` of the run at the start and at the end of the part.
    """
    noted, motion = int(m.counters[lane, EVENTS]), leaving.motion
    departure = Departure(motion.boxes, motion.balls, motion.walls, leaving.elapsed, leaving.phase)
    arrival = progress.motion.boxes, progress.elapsed, progress.phase
    _read_statistics(m, lane)
    accumulate_statistics(flow, squares, departure, m.log, noted, arrival, m.statistics)
    _write_statistics(m, lane)


@inlined_source
def _make_tables(flow, rates, progress, made, change):
    """Compute the missing flow tables of all contact states that may occur in the next events.

    made: for each contact state, True if its tables are computed. A ball that is near a wall may stick to it.
    """
    motion = progress.motion
    modes = mode_of(motion.walls)
    for i in range(2):
        near = abs(motion.boxes[i] - motion.balls[i]) > 1.0 - NO_REST_DISTANCE
        modes |= (1 << i) if near or progress.due == i else 0
    for mode in range(4):
        if mode | modes == modes and not made[mode]:
            fill_table(rates, np.intp(mode), flow.spacing, flow.series, flow.rotations, np.intp(0), change)
            made[mode] = True
