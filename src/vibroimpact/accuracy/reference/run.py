"""Simulate (10.1) in arbitrary precision, as the reference for all other methods.

Each flight is a Taylor series whose neglected terms are enclosed in an interval. Interval arithmetic (midpoint and
radius) proves which event is next. The initial state of each flight counts as exact, so the enclosure contains the
error of this flight alone. Later flights can amplify the error. Therefore `proven_run` repeats the run with more
digits.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from flint import ctx

from vibroimpact.accuracy.reference.roots import Undecidable
from vibroimpact.accuracy.reference.taylor_models import ExactSystem, to_fraction
from vibroimpact.accuracy.reference.trajectory import GUARD_BITS, Trajectory
from vibroimpact.system import System
from vibroimpact.system.state import EVENT

ROUNDED = Fraction(1, 10**12)  # largest distance beyond a wall that counts as a rounding error of the initial state
ACCURACY, MAX_DIGITS = 1e-15, 5000


@dataclass(frozen=True, eq=False)
class ReferenceRun:
    """Dimensionless run in arbitrary precision; a state is [X1, Y1, X2, Y2, X1', Y1', X2', Y2'].

    - digits: number of decimal digits of each flight.
    - events: events in float64, array of type EVENT.
    - event_taus: times of the events in full precision (flint.arb).
    - event_states: states just after the events in full precision (flint.arb).
    - samples: states at the sample times in float64, shape (n, 8).
    - final: final state in float64, shape (8,).
    - final_exact: final state in full precision (flint.arb).
    - chatters: number of completed chatters (infinite sequences of impacts).
    """

    digits: int
    events: np.ndarray
    event_taus: tuple
    event_states: tuple
    samples: np.ndarray
    final: np.ndarray
    final_exact: tuple
    chatters: int


@dataclass(frozen=True, eq=False)
class ProvenRun:
    """Run that is confirmed by a second run with half the digits (`coarse`).

    agreement: largest difference between `run` and `coarse`. In practice, it bounds the error of `coarse`.
    """

    run: ReferenceRun
    coarse: ReferenceRun
    agreement: float


def reference_run(
    system_parameters, state, cycles, digits, tau0=0, sample_times=None, exact_floats=None
) -> ReferenceRun:
    """Simulate (10.1) over `cycles` forcing periods from the time tau0.

    At the start, a ball at rest on a wall w sticks if the wall pushes the ball. The wall pushes if the first nonzero
    number among w X'' and its time derivatives is positive. The ball also sticks if all these numbers are 0. Numbers
    below the accuracy of a flight count as 0.

    Parameters
    ----------
    system_parameters : System or mapping
        The ten parameters. All numbers may be decimal strings, Fractions or floats.
    state : sequence
        [X1, Y1, X2, Y2, X1', Y1', X2', Y2'].
    cycles
        Number of forcing periods, at least 0.
    tau0
        Initial time tau.
    digits : int
        Decimal digits of each flight, at least 20.
    sample_times : sequence, optional
        Ascending times tau within the run. A sample at the time of an event is the state after the event.
    exact_floats : bool, optional
        If True, floats are read as binary values. As in `simulate`, Omega is then rounded to a float. If only
        rounding separates a ball from a wall, the ball is put on the wall. If False, floats are read as their shortest
        decimals, except sample times. The default is True for a System, else False.

    Raises
    ------
    ValueError
        If parameters, state or sample times are inadmissible.
    Undecidable
        If more digits are needed to decide whether an event happens.
    """
    if digits < 20:
        raise ValueError(f"digits: {digits} should be at least 20; for fewer digits, use vibroimpact.simulate")
    length = to_fraction("cycles", cycles)
    if length < 0:
        raise ValueError(f"cycles: {cycles} should be at least 0")
    if exact_floats is None:
        exact_floats = isinstance(system_parameters, System)
    system = ExactSystem.of(system_parameters, exact_floats)
    start = [to_fraction("state", value, exact_floats) for value in state]
    if len(start) != 8:
        raise ValueError(f"state: {len(start)} numbers given, expected 8")
    for i in (0, 2):
        gap = start[i] - start[i + 1]
        on_wall = float(start[i]) - float(start[i + 1]) in (1.0, -1.0) or 1 < abs(gap) <= 1 + ROUNDED
        if exact_floats and on_wall:  # put a ball exactly on a wall if only rounding separates them
            start[i + 1] = start[i] - (1 if gap > 0 else -1)
        elif abs(gap) > 1:
            module = i // 2 + 1
            raise ValueError(f"state: ball {module} starts beyond a wall, |W{module}| = {float(abs(gap))} is above 1")
    bits = int(digits * 3.3219281) + 1
    with ctx.workprec(bits + GUARD_BITS):
        trajectory = Trajectory(system, start, to_fraction("tau0", tau0, exact_floats), length, bits, sample_times)
        trajectory.run()
        return _collect(trajectory, digits)


def proven_run(system_parameters, state, cycles, digits=None, sample_times=None, exact_floats=None) -> ProvenRun:
    """Repeat `reference_run` with doubled digits until two successive runs differ by at most ACCURACY.

    digits: decimal digits of the first run. The default is 40 plus 0.33 per forcing period, because a modulated motion
    lost 0.33 digits per period in a measurement. The other arguments are those of `reference_run`, with tau0 = 0.

    Raises
    ------
    ArithmeticError
        If no two successive runs with at most MAX_DIGITS digits agree.
    """
    digits = digits or int(40 + 0.33 * float(to_fraction("cycles", cycles)))
    coarse, agreement = None, np.inf
    while digits <= MAX_DIGITS:
        try:
            fine = reference_run(system_parameters, state, cycles, digits, 0, sample_times, exact_floats)
        except Undecidable:
            fine = None
        if coarse and fine and len(coarse.events) == len(fine.events):
            samples = np.abs(coarse.samples - fine.samples).max(initial=0.0)
            events = departure(coarse, fine)[1].max(initial=0.0)
            agreement = float(max(_distance(coarse.final_exact, fine.final_exact), events, samples))
            if agreement <= ACCURACY:
                return ProvenRun(fine, coarse, agreement)
        coarse, digits = fine, 2 * digits
    raise ArithmeticError(
        f"reference run: no two successive runs with up to {MAX_DIGITS} digits agree to {ACCURACY}; "
        f"the last two that could be compared differ by {agreement}"
    )


def departure(coarse: ReferenceRun, fine: ReferenceRun) -> tuple[np.ndarray, np.ndarray]:
    """Return the event times of `fine`, shape (n,), and the difference from `coarse` at each event, shape (n,).

    The difference is the largest difference in time or in a coordinate. If an event has another module, wall or kind in
    `coarse`, the difference is inf for this event and all later events.
    """
    error = np.full(len(fine.events), np.inf)
    for i, (one, other) in enumerate(zip(coarse.events, fine.events, strict=False)):
        if any(one[name] != other[name] for name in ("module", "wall", "kind")):
            break
        error[i] = max(
            _distance(coarse.event_states[i], fine.event_states[i]),
            _distance([coarse.event_taus[i]], [fine.event_taus[i]]),
        )
    return fine.events["tau"], error


def _collect(trajectory, digits):
    record, final = trajectory.record, tuple(trajectory.state())
    events = np.zeros(len(record), EVENT)
    for i, (tau, module, wall, kind, state) in enumerate(record):
        events[i] = (float(tau), module + 1, wall, kind, [float(value) for value in state])
    return ReferenceRun(
        digits=digits,
        events=events,
        event_taus=tuple(entry[0] for entry in record),
        event_states=tuple(entry[4] for entry in record),
        samples=np.array(trajectory.samples, dtype=float).reshape(-1, 8),
        final=np.array(final, dtype=float),
        final_exact=final,
        chatters=trajectory.chatters,
    )


def _distance(one, other):
    return max(float(abs(a - b).upper()) for a, b in zip(one, other, strict=True))
