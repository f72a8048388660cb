"""Random systems and starts for stress tests of runs and their error estimates, and an observer with its own code."""

from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

import vibroimpact as vi
from by_hand import FlightsByHand
from chapter import FORCES, system_of
from hard_starts import example
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.exact.engine.flow import RATE, numbers_of
from vibroimpact.system.state import IMPACT, STICK

ROUNDING = 1e-13
"""Gap below which a turning ball counts as just released from the wall."""
SLOW = (1e-4, 3e-5)
"""Two bounds on the relative speed after an impact; slower impacts may be left out, as they end a chatter."""


def random_system(rng):
    """Return a system with moderate parameters that are decimals, equal for float64 and exact rationals."""

    def within(low, high):
        return round(rng.uniform(low, high), 4)

    return vi.System(
        epsilon=within(0.02, 0.6), kappa=within(0.1, 0.95), alpha12_hat=within(0, 3), gamma1_hat=within(0.01, 1),
        gamma2_hat=within(0.01, 1), gamma12_hat=within(0, 2), sigma20_hat=within(-0.5, 1.5),
        sigma_e_hat=within(-0.5, 1.5), f10_hat=within(-2, 2), f20_hat=within(-2, 2),
    )  # fmt: skip


def random_start(rng):
    """Return a state with random boxes, and balls at random places between their walls."""
    x, gap, v, u = rng.uniform(-1, 1, (4, 2)) * np.array([[1.5], [0.99], [1], [1.2]])
    return np.array([x[0], x[0] - gap[0], x[1], x[1] - gap[1], v[0], u[0], v[1], u[1]])


# -- turns ------------------------------------------------------------------------------------------------------------


class Observer(FlightsByHand):
    """Compute gaps between balls and walls on a time grid, by matrix exponentials of the equations written out.

    The grid is denser at the start of a flight.
    """

    def __init__(self, system):
        super().__init__(system)
        self.step = 0.03 / max(self.omega, np.sqrt(np.linalg.norm(self.stiffness, 2)))
        even = self.step * np.arange(int(7 / self.omega / self.step) + 2)
        self.times = np.concatenate([[0.0], self.step * 2.0 ** np.arange(-20, 0), even[1:]])
        self._exponentials = {}

    def nearest_miss(self, run):
        """Return the smallest gap at which a flying ball turns before a wall, over a whole run; inf without turns."""
        smallest, walls, state, tau = np.inf, [0, 0], run.start, 0.0
        stops = [*zip(run.events["tau"], run.events, strict=True), (run.cycles * run.system.period, None)]
        for n, (stop, event) in enumerate(stops):
            stuck, chattering = tuple(wall != 0 for wall in walls), self._chattering(run.events[n:])
            while stop > tau:
                length = min(stop - tau, self.times[-2])
                smallest = min([smallest, *self._gaps(state, tau, length, stuck, chattering, smallest + 0.01)])
                if tau + length < stop:
                    state = self.flow(state, walls, tau, length)
                tau += length
            if event is not None:
                state = event["state"]
                if event["kind"] != IMPACT:
                    walls[event["module"] - 1] = int(event["wall"]) if event["kind"] == STICK else 0
        return smallest

    @staticmethod
    def _chattering(events):
        """Return for each module whether its next event is a stick; the last impacts before a stick are not listed."""
        own = [events["kind"][events["module"] == module] for module in (1, 2)]
        return [len(kinds) > 0 and kinds[0] == STICK for kinds in own]

    def _gaps(self, state, tau, length, stuck, chattering, limit):
        """Yield the gap at each turn before a wall in one flight, where ball and box have the same velocity.

        Turns are left out if the gap at the last time of the grid before them exceeds the limit.
        """
        rate, z = self.rate(stuck), self.lifted(state, tau)
        if stuck not in self._exponentials:
            self._exponentials[stuck] = expm(rate * self.times[:, None, None])
        for i in (i for i in range(2) if not (stuck[i] or chattering[i])):
            ball, speed = state[[2 * i + 1, 2 * i + 5]]
            W = self._exponentials[stuck][:, i] @ z - ball - self.times * speed
            V = self._exponentials[stuck][:, 2 + i] @ z - speed
            turns = (V[:-1] * V[1:] < 0) & (self.times[:-1] < length)
            for k in np.flatnonzero(turns & (W * V > 0)[:-1] & (np.abs(W) > 1 - limit)[:-1]):
                t = brentq(lambda t, i=i, speed=speed: (expm(rate * t) @ z)[2 + i] - speed, *self.times[k : k + 2])
                gap = 1 - abs((expm(rate * t) @ z)[i] - ball - t * speed)
                if t < length and gap > ROUNDING:
                    yield gap


# -- events -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Attack:
    """A start, shape (8,), at tau0, of a run that is difficult for the engine."""

    kind: str
    system: vi.System
    start: np.ndarray
    tau0: float


def attacks(rng, count):
    """Yield attacks on one random system, at distances of 1e-17 to 1e-7 before or after an event."""
    system = random_system(rng)
    base = vi.simulate(system, random_start(rng), 6)
    kinds = {"end": _end, "start": _start, "graze": _graze, "rest": _rest}
    for _ in range(count):
        name = rng.choice(list(kinds))
        distance = rng.choice([-1, 1]) * 10 ** rng.uniform(-17, -7)
        made = kinds[name](rng, base, distance)
        if made is not None:
            yield Attack(str(name), system, *made)


def _later(base, tau0):
    """Return the state of the run `base` at the time tau0."""
    return vi.simulate(base.system, base.start, base.cycles, sample_times=[tau0]).samples[0].copy()


def _end(rng, base, distance):
    """Return a start whose run ends next to an event, and its time; None if there is no event."""
    late = base.events[base.events["tau"] > base.system.period + 1e-3]
    if not len(late):
        return None
    tau0 = rng.choice(late["tau"]) + distance - base.system.period
    return _later(base, tau0), tau0


def _start(rng, base, distance):
    """Return a start just before or after an impact, and its time; None if there is no impact."""
    impacts = base.events[base.events["kind"] == IMPACT]
    if not len(impacts):
        return None
    event = rng.choice(impacts)
    state, i, e, kappa = event["state"].copy(), int(event["module"]) - 1, base.system.epsilon, base.system.kappa
    x, y, v, u = 2 * i, 2 * i + 1, 4 + 2 * i, 5 + 2 * i
    if distance < 0:
        momentum, relative = state[v] + e * state[u], -(state[v] - state[u]) / kappa
        state[v] = (momentum + e * relative) / (1 + e)
        state[u] = state[v] - relative
    state[[x, y]] += distance * state[[v, u]]
    if abs(state[x] - state[y]) > 1:
        state[y] = state[x] - event["wall"]
    return state, float(event["tau"])


def _graze(rng, base, distance, begin=None):
    """Return a start from which a ball reaches the velocity of its box at `distance` from a wall, and its time."""
    begin = rng.uniform(0, (base.cycles - 1) * base.system.period) if begin is None else begin
    turn = begin + rng.uniform(0.05, 0.5) * base.system.period
    start, later, after = vi.simulate(
        base.system, base.start, base.cycles, sample_times=[begin, turn, turn + 1e-4]
    ).samples.copy()
    i = rng.integers(2)
    wall = -np.sign(after[4 + 2 * i] - later[4 + 2 * i])
    speed = later[4 + 2 * i]
    start[2 * i + 1] = later[2 * i] - wall * (1 - distance) - speed * (turn - begin)
    start[2 * i + 5] = speed
    return (start, begin) if abs(start[2 * i] - start[2 * i + 1]) < 1 else None


def _rest(rng, base, distance):
    """Return a start with a ball at or next to a wall, exactly or nearly at rest there, and its time."""
    state = _later(base, tau0 := rng.uniform(0, base.cycles * base.system.period))
    i, wall = rng.integers(2), rng.choice([-1, 1])
    gap, slip = rng.choice([0.0, abs(distance)]), rng.choice([0.0, distance, 1e3 * distance])
    state[2 * i + 1] = state[2 * i] - wall * (1 - gap)
    if abs(state[2 * i] - state[2 * i + 1]) > 1:
        return None
    state[2 * i + 5] = state[4 + 2 * i] - slip
    return state, tau0


def truth(attack, digits=40, cycles=1):
    """Run the reference from the start of an attack, with exactly the same floating-point numbers."""
    return reference_run(attack.system, attack.start, cycles, digits, tau0=attack.tau0)


def same_events(one, other, late=np.inf, slow=SLOW):
    """Return True if each module has the same events in the same order in both runs, at times that differ by <= late.

    Slow impacts are ignored, with any of the bounds `slow`, and so is a stick as the first event, which the reference
    does not list for a ball that sticks from the start.
    """

    def equal(some, others):
        same = some[["kind", "wall"]].tolist() == others[["kind", "wall"]].tolist()
        return same and np.abs(some["tau"] - others["tau"]).max(initial=0.0) <= late

    return any(all(map(equal, _by_module(one, bound), _by_module(other, bound))) for bound in slow)


def _by_module(events, slow):
    """Yield the events of each module without slow impacts and without a stick as the first event."""
    events = events[(events["kind"] != IMPACT) | (rebound_speeds(events) > slow)]
    for module in (1, 2):
        own = events[events["module"] == module]
        yield own[1:] if len(own) and own["kind"][0] == STICK else own


def rebound_speeds(events):
    """Return the relative speed of box and ball after each event, shape (n,)."""
    rows, box = np.arange(len(events)), 2 + 2 * events["module"]
    return np.abs(events["state"][rows, box] - events["state"][rows, box + 1])


def fast_attack(rng):
    """Return an attack on a system with fast and strong forcing: Omega from 2 to 100, forces up to 25 000."""
    system = random_system(rng)
    omega, forces = 10 ** rng.uniform(0.3, 2), 10 ** rng.uniform(0, 4.4, 2) * rng.choice([-1, 1], 2)
    f1, f2 = np.round(forces / system.epsilon, 4)
    system = system.with_(sigma_e_hat=round((omega - 1) / system.epsilon, 4), f10_hat=f1, f20_hat=f2)
    return Attack("fast", system, np.round(random_start(rng), 6), 0.0)


# -- the estimated error ----------------------------------------------------------------------------------------------

GENES = 21


def bred(genes):
    """Return an attack and its number of cycles for genes, shape (GENES,), between 0 and 1.

    Ranges: epsilon 1e-5 to 10, coupling up to k12 = 3e5, Omega 0.2 to 100, forces 0.01 to 1000.
    """

    def power(gene, low, high):
        return 10 ** (low + (high - low) * gene)

    e, omega = power(genes[0], -5, 1), power(genes[7], -0.7, 2)
    k12 = power(genes[2], -2, 5.5) if genes[2] > 0.1 else 0.0
    dampings = [power(gene, -4, 0.5) / e if gene > 0.15 else 0.0 for gene in genes[3:6]]
    forces = [np.sign(gene - 0.5) * power(abs(2 * gene - 1), -2, 3) / e for gene in genes[8:10]]
    system = vi.System(
        epsilon=e, kappa=0.001 + 0.969 * genes[1], alpha12_hat=k12 / e, gamma1_hat=dampings[0],
        gamma2_hat=dampings[1], gamma12_hat=dampings[2], sigma20_hat=(3.7 * genes[6] - 0.7) / e,
        sigma_e_hat=(omega - 1) / e, f10_hat=forces[0], f20_hat=forces[1],
    )  # fmt: skip
    x, gap = (4 * genes[10:12] - 2) * power(genes[18], -2, 1.5), 0.999 * (2 * genes[12:14] - 1)
    v, u = (2 * genes[14:18].reshape(2, 2) - 1) * power(genes[19], -2, 2)
    if k12 > 10:  # a stiff spring keeps both boxes together
        x[1] = x[0] + (x[1] - x[0]) / np.sqrt(k12)
    start = np.array([x[0], x[0] - gap[0], x[1], x[1] - gap[1], v[0], u[0], v[1], u[1]])
    return Attack("bred", system, start, 0.0), int(power(genes[20], 0, 1.5))


def in_lanes(system, gene):
    """Return the system with Omega within a factor of four of the boxes' largest rate; ensembles run it in lanes."""
    (numbers,), _ = numbers_of([system], 2)
    return system.with_(sigma_e_hat=(numbers[RATE] * 3.9 ** (2 * gene - 1) - 1) / system.epsilon)


def error_ratio(genes, most_events=150, many=False):
    """Return the ratio of true to estimated error of the final state; None if the run is undecided or long.

    With `many`, the true error is that of the final state of an ensemble.
    """
    try:
        attack, cycles = bred(genes)
        system = in_lanes(attack.system, genes[7]) if many else attack.system
        run = vi.simulate(system, attack.start, cycles)
        if len(run.events) > most_events or not run.certificate.decided:
            return None
        final = vi.ensemble(system, attack.start, cycles, settle=cycles)["final"] if many else run.final
        true = reference_run(system, attack.start, cycles, 40).final
        return np.abs(final - true).max() / run.certificate.error
    except (ValueError, ArithmeticError):  # a resonant system, an unfinished run, or too few digits for the reference
        return None


def climbed(rng, draws, steps, ratio, genes):
    """Return the ratios for random draws of genes, and for a hill climb from the draw with the largest ratio."""
    drawn = rng.uniform(0, 1, (draws, genes))
    ratios = [ratio(one) for one in drawn]
    worst, best = max(((r, n) for n, r in enumerate(ratios) if r is not None), default=(0.0, 0))
    at = drawn[best]
    for _ in range(steps):
        moved = rng.random(genes) < 0.2
        moved[rng.integers(genes)] = True
        there = np.clip(at + moved * rng.normal(size=genes) * 10 ** rng.uniform(-6, -0.5), 0, 1)
        ratios.append(found := ratio(there))
        if found is not None and found > worst:
            worst, at = found, there
    return [found for found in ratios if found is not None]


# -- ensembles --------------------------------------------------------------------------------------------------------

MAX_ERROR_RATIO = 2.6
"""Largest ratio of true to estimated error that docs/engine.md states."""


def _of_case(name):
    return lambda rng, count: ([system_of(name)] * count, [random_start(rng) for _ in range(count)], 10, 0.0)


def _near_a_settled_motion(rng, count):
    system = system_of("equal")
    settled, balls = vi.simulate(system, np.zeros(8), 300).final, [1, 3]
    states = settled + rng.uniform(-1, 1, (count, 8)) * 10 ** rng.uniform(-6, -0.5, (count, 1))
    boxes = states[:, [0, 2]]
    states[:, balls] = np.clip(states[:, balls], boxes - 0.99, boxes + 0.99)
    return [system] * count, states, 30, 0.0


def _of_a_sweep(rng, count):
    """Return two starts for each of several random systems."""
    systems = [random_system(rng) for _ in range(-(-count // 2))]
    return [systems[n // 2] for n in range(count)], [random_start(rng) for _ in range(count)], 8, 0.3


def _drawn_by(make, cycles):
    def draw(rng, count):
        found = []
        while len(found) < count:
            with suppress(ValueError):  # an invalid system
                found.append(make(rng))
        return [one.system for one in found], [one.start for one in found], cycles, 0.0

    return draw


def _hostile(rng, count):
    systems, states, _ = zip(*(example(int(rng.integers(10**9))) for _ in range(count)), strict=True)
    return systems, states, 1, float(rng.choice([0.0, 0.7]))


def _grazing(rng):
    """Return a start from which a ball turns at a distance of about 1e-13 before or behind a wall."""
    system = random_system(rng)
    base, distance = vi.simulate(system, random_start(rng), 1), rng.choice([-1, 1]) * 10 ** rng.uniform(-15, -12)
    found = _graze(rng, base, distance, begin=0.0)
    if found is None:
        raise ValueError("the ball would start outside of its walls")
    return Attack("grazing", system, *found)


ensembles = {
    **{name: _of_case(name) for name in FORCES},
    "settled": _near_a_settled_motion,
    "sweep": _of_a_sweep,
    "stiff": _drawn_by(lambda rng: bred(rng.uniform(0, 1, GENES))[0], 3),
    "fast": _drawn_by(fast_attack, 1),
    "hostile": _hostile,
    "grazing": _drawn_by(_grazing, 1),
}
"""For each kind of scene, a function of a random generator and a number: systems, starts, cycles and tau0 of runs."""


def low_hops(run, module):
    """Return the number of impacts of a module after which the ball hops no higher than rounding errors."""
    events = run.events[run.events["module"] == module]
    speeds = rebound_speeds(events)[:-1]
    height = speeds * np.diff(events["tau"]) / 4
    rounding = 4 * np.finfo(float).eps * (1 + np.abs(events["state"][:-1]).max(axis=1))
    return np.count_nonzero((events["kind"][:-1] == IMPACT) & (speeds > 0) & (height <= rounding))


def unlike_single_runs(systems, states, cycles, tau0=0.0):
    """Return the index of each run in an ensemble that differs from `simulate`, with the reason.

    Decided runs must have the same numbers of impacts, except impacts before hops within rounding. Their
    final states must differ by less than MAX_ERROR_RATIO times the estimated error.
    """
    found, decided = [], 0
    for n, outcome in enumerate(vi.ensemble(systems, states, cycles, tau0)):
        try:
            run = vi.simulate(systems[n], states[n], cycles, tau0)
        except ArithmeticError as error:
            if vi.STATUSES[int(outcome["status"])] not in str(error):
                found.append((n, str(error)))
            continue
        if not run.certificate.decided:
            continue
        decided += 1
        hits = run.events["module"][run.events["kind"] == IMPACT]
        counts = np.array([np.sum(hits == module) for module in (1, 2)])
        if np.any(np.abs(outcome["impacts"] - counts) > [low_hops(run, module) for module in (1, 2)]):
            found.append((n, f"{outcome['impacts']} impacts instead of {counts}"))
        error = np.abs(outcome["final"] - run.final).max()
        if not error < MAX_ERROR_RATIO * run.certificate.error:
            found.append((n, f"the final state differs by {error:.3g}, estimate {run.certificate.error:.3g}"))
    assert decided > len(states) // 4
    return found
