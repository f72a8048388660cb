"""Integrate the equations of motion (10.2) from event to event: flights, impacts, chatter, sticking and release.

Between events the flow is linear and has a closed form (flow.advance). exclusion.module_time proves that a module has
no event over some time, or brackets the time of its next event. If it is certain which event comes first, Newton's
method finds the time of this event. Otherwise the flight continues only up to a time before which no event happens.
The events are (contact.resolve):

impact    a ball meets a wall with outward relative velocity. Newton's restitution rule and the conservation of momentum
          determine the velocities after the impact;
stick     a ball comes to rest on a wall, for example after a chatter (infinitely many impacts in a finite time). Box
          and ball then move as one body of mass 1 + epsilon;
release   a sticking ball leaves its wall, because its contact force falls to zero or an impact in the other module
          makes this force negative.

A chatter is not simulated to its end. A stick replaces the remaining impacts as soon as this changes the state by less
than rounding. Long runs lose no digits, because time is represented by the forcing phase, which is reduced modulo 2 pi.
"""

import math
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine import contact
from vibroimpact.exact.engine.compiled import compiled, in_place, inlined, inlined_source
from vibroimpact.exact.engine.contact import EVENTS, EXCLUSIONS, Log, Motion, drift_balls, free_flight, pack
from vibroimpact.exact.engine.exclusion import LOOKAHEAD, SHORT, gap, gap_rounding, module_time, nearby_zero, remainder
from vibroimpact.exact.engine.flow import (
    TWO_PI,
    TWO_PI_TAIL,
    advance_phase,
    evaluate,
    jet_at,
    mode_of,
    reduced,
    sine_and_cosine,
    unpacked,
)  # fmt: skip

TRIES = 3
STUCK_IN_TIME, OUT_OF_PROOFS = -2, -3


@inlined_source
def fly(flow, motion, remaining, most_proofs, counters):
    """Advance a motion to the next event, or to the end of the run or of the flow table.

    Return (time, module, boxes, balls), where `time` is the duration of the flight. If the flight ends with an event,
    `module` is the module (0 or 1) of the event. Otherwise `module` is -1. In two cases the flight fails. If the time
    does not advance, `module` is STUCK_IN_TIME. If the run has used more than `most_proofs` proofs that no event
    happens, `module` is OUT_OF_PROOFS.
    """
    q = flow.coefficients
    mode = mode_of(motion.walls)
    reach = min(remaining, flow.longest)
    short = SHORT * flow.unit
    now, t = motion, 0.0
    counters[contact.FLIGHTS] += 1
    while True:
        if t >= reach:
            return t, -1, now.boxes, now.balls
        counters[EXCLUSIONS] += 1
        jets = jet_at(flow, mode, now.boxes, now.sine, now.cosine, 0)
        horizon = min(reach - t, LOOKAHEAD * flow.unit)
        bound = remainder(q, mode, jets, horizon * q.growth)
        due, step, width, safe, doubt = _first_event(q, now, jets, bound, horizon, short)
        step = step if step >= -t else 0.0  # an event before the start of the flight happens now
        met, boxes, end = due >= 0 and abs(step) <= short, now.boxes, t + step
        if met:
            counters[contact.UNDECIDED] += doubt
            boxes = evaluate(jets, step)
        elif due >= 0 and now.walls[due] == 0 and end + width + short < reach:
            met, end, boxes = _refine_impact_time(flow, motion, due, end, end - width, end + width)
        if met:
            return end, due, boxes, drift_balls(motion.balls, motion.walls, boxes, end)
        if not t + safe > t:
            return t, STUCK_IN_TIME, now.boxes, now.balls
        if counters[EXCLUSIONS] > most_proofs:
            return t, OUT_OF_PROOFS, now.boxes, now.balls
        t = min(t + safe, reach)
        now = free_flight(flow, motion, t)


@inlined_source
def _first_event(q, motion, jets, bound, horizon, short):
    """Return (module, time, width, safe, doubt) for the first event in the two modules.

    The event happens in `module` at `time` +- `width`. If it is not certain which event is the first, `module` is -1.
    No event happens before the time `safe`. `doubt` is True if rounding decides whether the event happens.
    """
    # Begin with the module whose ball would hit a wall earlier if the relative velocities stayed constant.
    (x1, x2, v1, v2), (y1, y2, u1, u2) = motion.boxes, motion.balls
    gap1, gap2 = 1.0 - math.copysign(1.0, v1 - u1) * (x1 - y1), 1.0 - math.copysign(1.0, v2 - u2) * (x2 - y2)
    one = 0 if gap1 * abs(v2 - u2) <= gap2 * abs(v1 - u1) else 1
    two = 1 - one
    t1, w1, doubt1 = module_time(q, motion, one, jets, bound, horizon, short)
    w, s1 = _bounds(t1, w1, short)
    # Check the other module up to slightly after t1, so that no event before t1 is missed.
    t2, w2, doubt2 = module_time(q, motion, two, jets, bound, min(t1 + w + short, horizon), short)
    v, s2 = _bounds(t2, w2, short)
    if w1 < math.inf and t1 + w <= s2:
        return one, t1, w, s1, doubt1
    if w2 < math.inf and t2 + v <= s1:
        return two, t2, v, s2, doubt2
    return -1, 0.0, 0.0, min(s1, s2), False


@inlined
def _bounds(t, width, short):
    """Return the uncertainty of the event time t, and the time up to which no event happens.

    If `width` is inf, no event happens before t. If |t| <= `short`, the time t is exact. In both cases, the returned
    uncertainty is 0.

    t, width: time and width that `module_time` returns.
    """
    w = 0.0 if width == math.inf or abs(t) <= short else width
    return w, t - w


@inlined
def _refine_impact_time(flow, motion, i, t, low, high):
    """Refine the guess t for the time of the only impact of module i in [low, high].

    Return (found, time, boxes): `found` is True if the method converged to a time in [low, high].
    """
    mode = mode_of(motion.walls)
    for _ in range(TRIES):
        j = int(t * flow.density + 0.5)
        jets = jet_at(flow, mode, motion.boxes, motion.sine, motion.cosine, j)
        now = jets[0][0], jets[1][0], jets[0][1], jets[1][1]
        there = drift_balls(motion.balls, motion.walls, now, j * flow.spacing)
        w = 1.0 if now[i] > there[i] else -1.0
        step = nearby_zero(gap(jets[0] if i == 0 else jets[1], there[i], there[2 + i], w), t - j * flow.spacing)
        t = j * flow.spacing + step
        if not low <= t <= high:
            break
        if abs(step) <= SHORT * flow.unit:
            return True, t, evaluate(jets, step)
    return False, t, motion.boxes


FINISHED, PENETRATED, STALLED, CROWDED, EXHAUSTED = range(5)
PAUSED = -1
FAILURES = {
    PENETRATED: "a ball went through a wall",
    STALLED: "time stands still",
    CROWDED: "there are too many events",
    EXHAUSTED: "there are too many proofs that no event happens",
}
ROOM, ROOM_PER_CYCLE, MOST_ROOM = 32, 6, 4096
"""The initial number of rows for events is ROOM + ROOM_PER_CYCLE * cycles, at most MOST_ROOM. Few runs need more."""
MOST_AT_ONCE = 8  # events at one instant: at most an impact, a stick, a release and the end of a chatter per module
MOST_EVENTS, MOST_EVENTS_PER_CYCLE = 1_000_000, 10_000
"""A run may have MOST_EVENTS events plus MOST_EVENTS_PER_CYCLE per cycle; only runs with kappa close to 1 need more."""
INTERRUPT_INTERVAL = 200_000  # number of proofs between two checks for an interrupt by the user (about 20 ms)
PATIENCE = 100_000  # number of successive flights of zero duration after which a run is stopped
MOST_PROOFS, MOST_PROOFS_PER_EVENT, MOST_PROOFS_PER_UNIT = 1_000_000, 100, 100
"""A run may use MOST_PROOFS proofs that no event happens, plus MOST_PROOFS_PER_EVENT per event and MOST_PROOFS_PER_UNIT
per time `Flow.unit`."""
ROWS_PER_PIECE = 65536  # number of rows in an array of events; such an array has 8 MB and gets large memory pages
EARLIER_EVENTS, SPAN, CLOCK, RUN_LENGTH = 19, 20, 23, 24
"""Indices in the array of a run, (RUN_LENGTH,). EARLIER_EVENTS: number of events in earlier rows. SPAN: phase at the
start, its rounding remainder, number of cycles. CLOCK: start time. The state (`contact.pack`) and the other fields of
`Progress` come before."""


class Progress(NamedTuple):
    """State of an unfinished run.

    motion: the `Motion` at this instant.
    due: module (0 or 1) with an event at this instant, or -1.
    phase, tail: forcing phase in [0, 2 pi) and its rounding remainder.
    revolutions: number of full revolutions (2 pi) that were subtracted from the phase.
    elapsed: time since the start.
    sampled: number of samples taken.
    stalled: number of successive flights of zero duration.
    """

    motion: Motion
    due: int
    phase: float
    tail: float
    revolutions: int
    elapsed: float
    sampled: int
    stalled: int


@compiled
def integrate(numbers, series, rotations, run, times, samples, rows, counters):
    """Continue a run to its end or to a pause; return the status.

    numbers, series, rotations: from `flow.tables_of`.
    run, rows, counters: from `memory`. The function updates these arrays; run[:8] becomes the state reached.
    times: ascending sample times, shape (n,), on the same time scale as the start time run[CLOCK].
    samples: array of shape (n, 8), filled with the states at the sample times.

    The status is PAUSED if `rows` may be too short for the events of the next instant. The status is also PAUSED after
    INTERRUPT_INTERVAL proofs, so that the interpreter can handle an interrupt. To continue, call the function again. If
    `rows` may be too short, first add counters[EVENTS] to run[EARLIER_EVENTS], set counters[EVENTS] to 0 and pass new
    rows.

    Only a number is returned, since an interrupt could leave a returned tuple incomplete.
    """
    boxes, balls = (run[0], run[2], run[4], run[6]), (run[1], run[3], run[5], run[7])
    motion = Motion(boxes, balls, (int(run[8]), int(run[9])), (int(run[10]), int(run[11])), 0.0, 1.0)
    progress = Progress(motion, int(run[12]), run[13], run[14], int(run[15]), run[16], int(run[17]), int(run[18]))
    flow, log, interval = unpacked(numbers, series, rotations), Log(rows, counters), np.int64(INTERRUPT_INTERVAL)
    span, sampling = (run[SPAN], run[SPAN + 1], int(run[SPAN + 2])), (run[CLOCK], times, samples)
    progress, status = run_until(flow, progress, span, sampling, log, run[EARLIER_EVENTS], interval)
    (boxes, balls, walls, touching, _, _), due, phase, tail, revolutions, elapsed, sampled, stalled = progress
    pack(boxes, balls, run)
    run[8], run[9], run[10], run[11] = walls[0], walls[1], touching[0], touching[1]
    run[12], run[13], run[14], run[15] = due, phase, tail, revolutions
    run[16], run[17], run[18] = elapsed, sampled, stalled
    return status


def memory(state, phase, tail, cycles, clock):
    """Return new arrays for `integrate`: the array of the run, the rows of events and the counters.

    state: initial state, shape (8,). phase, tail: initial forcing phase and its rounding remainder.
    cycles: number of forcing periods. clock: start time of the run, on the same time scale as the sample times.
    """
    run, room = np.zeros(RUN_LENGTH), min(ROOM + ROOM_PER_CYCLE * cycles, MOST_ROOM)
    run[:8], run[12:15], run[SPAN:] = state, (-1.0, phase, tail), (phase, tail, cycles, clock)
    return run, np.empty((room, contact.ROW)), np.zeros(contact.ENTRIES)


@in_place
def run_until(flow, progress, span, sampling, log, earlier, interval):
    """Continue a run to its end or to a pause; return (progress, status).

    The run pauses after `interval` proofs that no event happens. It also pauses if `log.rows` may be too short for the
    events of the next instant.

    span: forcing phase at the start of the run, its rounding remainder, and the number of cycles.
    sampling: start time of the run, ascending sample times, shape (n,), and an array for the samples, shape (n, 8).
    earlier: number of events in earlier arrays of rows.
    """
    q = flow.coefficients
    (first, first_tail, cycles), (start, sample_times, samples) = span, sampling
    motion, due, phase, tail, revolutions, elapsed, sampled, stalled = progress
    most_events = MOST_EVENTS + MOST_EVENTS_PER_CYCLE * float(cycles)
    most_proofs = MOST_PROOFS + MOST_PROOFS_PER_UNIT * (cycles * TWO_PI / q.omega / flow.unit)
    status, pause = FINISHED, log.counters[EXCLUSIONS] + interval
    while True:
        sine, cosine = sine_and_cosine(phase, tail)
        noted = int(log.counters[EVENTS])
        if noted + MOST_AT_ONCE > len(log.rows) or log.counters[EXCLUSIONS] > pause:
            return Progress(motion, due, phase, tail, revolutions, elapsed, sampled, stalled), PAUSED
        ahead_of_start = (phase - first) + (tail - first_tail)
        whole = cycles - revolutions
        remaining = max((whole * TWO_PI - ahead_of_start + whole * TWO_PI_TAIL) / q.omega, 0.0)
        motion = Motion(motion.boxes, motion.balls, motion.walls, motion.touching, sine, cosine)
        motion = contact.resolve(flow, motion, elapsed, remaining, due, log)
        count = int(log.counters[EVENTS])
        for k in range(noted, count):
            log.rows[k, contact.PHASE], log.rows[k, contact.SINE], log.rows[k, contact.COSINE] = phase, sine, cosine
        if remaining == 0.0:
            break
        most = most_proofs + MOST_PROOFS_PER_EVENT * (earlier + count)
        t, due, later, there = fly(flow, motion, remaining, most, log.counters)
        stalled = 0 if t > 0.0 else stalled + 1
        status = _failure(q, later, there, due, stalled, earlier + count, most_events)
        if status != FINISHED:
            break
        if due < 0 and t >= remaining:
            revolutions, phase, tail = cycles, first, first_tail
        else:
            phase, tail = advance_phase(phase, tail, q.omega, t)
            if phase >= TWO_PI:
                (phase, tail), revolutions = reduced(phase, tail), revolutions + 1
        before, elapsed = elapsed, (revolutions * TWO_PI + ((phase - first) + (tail - first_tail))) / q.omega
        while sampled < len(sample_times) and sample_times[sampled] < start + elapsed:
            then = free_flight(flow, motion, max(sample_times[sampled] - start - before, 0.0))
            pack(then.boxes, then.balls, samples[sampled])
            sampled += 1
        motion = Motion(later, there, motion.walls, (0, 0), sine, cosine)
    while sampled < len(sample_times):
        pack(motion.boxes, motion.balls, samples[sampled])
        sampled += 1
    return Progress(motion, due, phase, tail, revolutions, elapsed, sampled, stalled), status


@inlined_source
def _failure(q, boxes, balls, due, stalled, count, most_events):
    """Return the reason to stop a run after a flight, or FINISHED if there is no reason to stop."""
    for i in range(2):
        beyond = abs(boxes[i] - balls[i]) - 1.0
        if beyond > 0.0 and beyond > 16.0 * gap_rounding(q, boxes, balls, i):
            return PENETRATED
    if stalled > PATIENCE or due == STUCK_IN_TIME:
        return STALLED
    if due == OUT_OF_PROOFS:
        return EXHAUSTED
    return CROWDED if count > most_events else FINISHED
