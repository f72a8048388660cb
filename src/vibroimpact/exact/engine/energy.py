"""Energy balance of a run: work of the forces, dissipation of dampers and impacts, stored energy.

Work and dissipation are integrals of quadratic forms along the flights. Each is computed independently, so that the
balance is a test of all of them. The stick that ends a chatter takes the remaining energy of the relative motion: that
of the rebounds that are not listed.

In flight z = [X1, X2, X1', X2', sin, cos] obeys z' = A z. The integral of a quadratic form of z over a time t is again
a quadratic form of z at the start. It is tabulated at the times of the flow table (`flow`); Gauss's rule on the Taylor
polynomial adds the remaining time. With damping, ensembles need no tables: z G z is the rate of a potential
z S z + c t, where A' S + S A + c (sin^2 + cos^2) = G (Lyapunov's equation). Then only the ends of a run and the
velocity changes at impacts contribute. With very little damping, S is so large that its differences lose all digits.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, inlined_source
from vibroimpact.exact.engine.flow import evaluate, flow_of, jet_at, rotate_phase, slope
from vibroimpact.exact.engine.flow_tables import ORDERS
from vibroimpact.exact.engine.motion import APPROACH, drift_balls, mode_of
from vibroimpact.exact.engine.phase import advance_phase
from vibroimpact.exact.engine.replay import FORCING, LENGTH, completes_chatter, start_of
from vibroimpact.system.matrices import rate_matrix
from vibroimpact.system.representation import Representation, brief
from vibroimpact.system.restitution import energy_lost
from vibroimpact.system.state import IMPACT
from vibroimpact.system.stored_energy import stored

SIZE, TRIANGLE = 6, 21
ROWS, COLUMNS = np.triu_indices(SIZE)
TERMS = 24  # terms of the exponential series over one spacing
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
REST = 0.5 - np.sqrt(0.15), 0.5, 0.5 + np.sqrt(0.15)
SHARES = 5 / 18, 8 / 18, 5 / 18
"""Nodes and weights of Gauss's rule with three points on [0, 1]; over half a spacing its error is below rounding."""


POSITIONS = np.stack([np.diag(np.eye(SIZE)[i]) for i in range(2)])
"""Matrices G with z G z = X_i^2."""
LARGEST = 1e3
"""Largest product of an entry of S and the largest rate at which differences of potentials keep enough digits."""


class Squares(NamedTuple):
    """Potentials S (4, k, 6, 6) and drifts c (4, k) of k integrals in each contact state."""

    potentials: np.ndarray
    drifts: np.ndarray


def _lyapunov():
    """Return the map A -> A' S + S A, (36, 441), and sin^2 + cos^2, (21,), on the upper triangle of S."""
    units = np.zeros((TRIANGLE, SIZE, SIZE))
    units[np.arange(TRIANGLE), ROWS, COLUMNS] = units[np.arange(TRIANGLE), COLUMNS, ROWS] = 1.0
    rates = np.eye(SIZE * SIZE).reshape(-1, 1, SIZE, SIZE)
    images = rates.transpose(0, 1, 3, 2) @ units + units @ rates
    images = images[..., ROWS, COLUMNS].transpose(0, 2, 1).reshape(SIZE * SIZE, -1)
    return np.ascontiguousarray(images), ((ROWS == COLUMNS) & (ROWS >= 4)).astype(float)


OPERATORS, FORCED = _lyapunov()


def potentials_of(rates, kernels) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return potentials (n, 4, k, 6, 6), drifts (n, 4, k) and flags (n,) of the integrals of z G z.

    The kernels G have shape (k, 6, 6), the rate matrices (n, 4, 6, 6). A flag is True for a system whose potential
    differences keep enough digits.
    """
    equations = np.zeros((*rates.shape[:2], TRIANGLE + 1, TRIANGLE + 1))
    images = rates.reshape(-1, SIZE * SIZE) @ OPERATORS
    equations[..., :-1, :-1] = images.reshape(*rates.shape[:2], TRIANGLE, TRIANGLE)
    equations[..., :-1, -1] = equations[..., -1, :-1] = FORCED  # S and S + sin^2 + cos^2 are equivalent
    sides = np.zeros((TRIANGLE + 1, len(kernels)))
    sides[:-1] = kernels[:, ROWS, COLUMNS].T
    sides = np.broadcast_to(sides, (*rates.shape[:2], *sides.shape))
    try:
        solved = np.linalg.solve(equations, sides)
    except np.linalg.LinAlgError:
        if len(rates) > 1:
            parts = [potentials_of(rates[n : n + 1], kernels) for n in range(len(rates))]
            return tuple(np.concatenate(part) for part in zip(*parts, strict=True))
        solved = np.full(sides.shape, np.inf)
    potentials = np.empty((*rates.shape[:2], len(kernels), SIZE, SIZE))
    potentials[..., ROWS, COLUMNS] = potentials[..., COLUMNS, ROWS] = np.swapaxes(solved[..., :-1, :], -1, -2)
    sound = abs(solved).max(axis=(1, 2, 3), initial=0.0) < LARGEST / abs(rates).max(axis=(1, 2, 3))
    return potentials, solved[..., -1, :].copy(), sound


def integrals_of(system, kernels) -> np.ndarray:
    """Return the quadratic forms that integrate symmetric matrices G (k, 6, 6) along a flight.

    Shape (4, n, k, 21): contact state, time of the flow table, index of G, upper triangle.

    Off-diagonal entries are doubled, so that a form is one sum over products of pairs.
    """
    flow = flow_of(system)
    turned = np.zeros((len(flow.rotations), 2, SIZE))
    (cosine, sine) = flow.rotations.T
    turned[:, 0, 4], turned[:, 0, 5], turned[:, 1, 4], turned[:, 1, 5] = cosine, sine, -sine, cosine
    forms = np.empty((len(flow.series), len(turned), len(kernels), SIZE, SIZE))
    for mode, series in enumerate(flow.series):
        propagators = np.swapaxes(series[:, :, [0, ORDERS, 1, ORDERS + 1]], 1, 2)
        rate = rate_matrix(system, (bool(mode & 1), bool(mode & 2)))
        forms[mode] = _summed(_over_one(rate, flow.spacing, kernels), np.concatenate([propagators, turned], axis=1))
    triangles = np.take(forms.reshape(*forms.shape[:-2], SIZE * SIZE), SIZE * ROWS + COLUMNS, axis=-1)
    return triangles * np.where(ROWS == COLUMNS, 1.0, 2.0)


def _summed(over_one, powers):
    """Return the forms over 0, 1, 2, ... spacings, from the form over one spacing and propagators (n, 6, 6)."""
    forms, made = np.zeros((len(powers), *over_one.shape)), 2
    forms[1] = over_one
    while made < len(powers):  # double the number: later forms are carried back to the start of the flight
        last, after = made - 1, min(made - 1, len(powers) - made)
        forms[made : made + after] = forms[last] + _carried_back(forms[1 : 1 + after], powers[last])
        made += after
    return forms


def _carried_back(forms, power):
    """Return P^T G P for symmetric forms G (n, k, 6, 6), by two products with one tall matrix."""
    half = (forms.reshape(-1, SIZE) @ power).reshape(forms.shape)
    return (np.swapaxes(half, -1, -2).reshape(-1, SIZE) @ power).reshape(forms.shape)


def _over_one(rate, spacing, kernels):
    """Return the forms over one spacing, shape (k, 6, 6)."""
    scaled = rate * spacing * (1 + NODES[:, None, None]) / 2
    term = np.broadcast_to(np.eye(SIZE), scaled.shape)
    power = term.copy()
    for k in range(1, TERMS):
        term = term @ scaled / k
        power += term
    power = power[:, None]
    return np.tensordot(WEIGHTS * spacing / 2, np.swapaxes(power, -1, -2) @ kernels @ power, 1)


@inlined
def add_potentials(squares, mode, boxes, sine, cosine, sign, sums):
    """Add sign times the potentials at a point of a flight to sums (k,)."""
    z = (boxes[0], boxes[1], boxes[2], boxes[3], sine, cosine)
    for k in range(squares.drifts.shape[1]):
        total = 0.0
        for a in range(SIZE):
            part = 0.0
            for b in range(SIZE):
                part += squares.potentials[mode, k, a, b] * z[b]
            total += z[a] * part
        sums[k] += sign * total


@inlined
def add_potential_drops(squares, before, after, forcing, sums):
    """Add the decrease of the potentials in an instant to sums (k,); before, after: contact state and boxes.

    If the contact state stays the same, only the terms of the velocity change are computed: two products instead of 36.
    """
    (mode, boxes), (later, others), (sine, cosine) = before, after, forcing
    if mode != later:
        add_potentials(squares, mode, boxes, sine, cosine, 1.0, sums)
        add_potentials(squares, later, others, sine, cosine, -1.0, sums)
        return
    z = (2.0 * others[0], 2.0 * others[1], boxes[2] + others[2], boxes[3] + others[3], 2.0 * sine, 2.0 * cosine)
    for a in range(2, 4):
        change = boxes[a] - others[a]
        if change != 0.0:
            for k in range(squares.drifts.shape[1]):
                total = 0.0
                for b in range(SIZE):
                    total += squares.potentials[mode, k, a, b] * z[b]
                sums[k] += change * total


ENERGY = np.dtype(
    [("work", "f8", (2,)), ("ground", "f8", (2,)), ("coupling", "f8"), ("impacts", "f8", (2,)), ("stored", "f8")]
)
"""Data type of energies over a time, in units of M L^2 omega_10^2: work of each force, dissipation of each damper to
ground and of the coupling damper, loss in the impacts of each module, and change of the stored energy."""

FORMS, IMPACTS, STORED, ENTRIES = 5, 5, 7, 8
"""Indices in a row of the kernel: the integrals of sin X_1', sin X_2', X_1'^2, X_2'^2, (X_1' - X_2')^2, and so on."""

DIFFERENCE = np.outer([0, 0, 1, -1, 0, 0], [0, 0, 1, -1, 0, 0])


def _kernels():
    """Return the five quadratic forms of z that are integrated, shape (5, 6, 6)."""
    unit = np.eye(SIZE)
    work = [(np.outer(unit[2 + i], unit[4]) + np.outer(unit[4], unit[2 + i])) / 2 for i in range(2)]
    return np.stack([*work, *(np.diag(unit[2 + i]) for i in range(2)), DIFFERENCE])


KERNELS = _kernels()
OBSERVED = np.concatenate([POSITIONS, KERNELS])
"""Quadratic forms integrated by an ensemble: X_1^2, X_2^2 and those of the energy balance."""
impact_loss, energy_stored = inlined(energy_lost), inlined(stored)


@lru_cache(maxsize=16)
def work_tables(system) -> np.ndarray:
    """Return the forms of a system that `accumulate_energy` needs, shape (4, n, 5, 21)."""
    return integrals_of(system, KERNELS)


@dataclass(frozen=True, eq=False, repr=False)
class Energy(Representation):
    """Energy balance of a run, in units of M L^2 omega_10^2 (omega_10^2 = k_1 / M).

    The balance is work = ground + coupling + impacts + stored.

    Attributes
    ----------
    work : ndarray
        Work of the force on each box, shape (2,).
    ground : ndarray
        Energy dissipated by the damper from each box to ground, shape (2,).
    coupling : float
        Energy dissipated by the damper between the boxes.
    impacts : ndarray
        Energy lost in the impacts of each module, completed chatters included, shape (2,).
    stored : float
        Change of the energy stored in boxes, balls and springs.
    per_cycle : ndarray
        Structured array (cycles,) of type ENERGY with the same fields for each forcing period since the start of the
        run. An event between two periods belongs to the later one.

    Examples
    --------
    >>> run = vi.simulate(system, [0.0] * 8, cycles=100)
    >>> bool(abs(run.energy.residual) < 1e-9)
    True
    """

    work: np.ndarray
    ground: np.ndarray
    coupling: float
    impacts: np.ndarray
    stored: float
    per_cycle: np.ndarray

    @classmethod
    def of(cls, run) -> "Energy":
        """Return the energy balance of a finished run."""
        system, (flow, flights, events) = run.system, run.trajectory
        rows = np.zeros((max(run.cycles, 1), ENTRIES))
        accumulate_energy(flow, work_tables(system), flights, events, system.period * np.arange(len(rows)), rows)
        total = energies(system, rows.sum(axis=0))
        per_cycle = energies(system, rows[: run.cycles])
        for array in (total, per_cycle):
            array.flags.writeable = False
        return cls(*(total[name] for name in ENERGY.names), per_cycle=per_cycle)

    @property
    def residual(self) -> float:
        """Difference of the two sides of the balance, which is due to rounding."""
        return float(self.work.sum() - self.ground.sum() - self.coupling - self.impacts.sum() - self.stored)

    @property
    def impact_share(self) -> float:
        """Share of the work of both forces that impacts dissipate."""
        return float(self.impacts.sum() / self.work.sum())

    def _shown(self):
        return {name: brief(getattr(self, name)) for name in ENERGY.names}


def energies(system, rows) -> np.ndarray:
    """Return energies (...,), ENERGY, from rows (..., ENTRIES) of the kernel."""
    factors = [*system.forcing, system.gamma1, system.gamma2, system.gamma12, 1.0, 1.0, 1.0]
    return np.ascontiguousarray(rows * factors).view(ENERGY)[..., 0]


@compiled
def accumulate_energy(flow, forms, flights, events, begins, rows):
    """Add the integrals along the flights of a run (`departures` is enough) to rows (k, ENTRIES) of zeros.

    begins (k,): ascending times since the start of the run at which the rows begin; the last row lasts until the end.
    """
    q, row, passed = flow.coefficients, -1, 0.0
    boxes, balls, walls = start_of(flights[0])
    for n in range(len(flights)):
        boxes, balls, walls = start_of(flights[n])
        left, phase, tail = flights[n, LENGTH], flights[n, FORCING], 0.0
        while left > 0.0 or (row + 1 < len(begins) and passed >= begins[row + 1]):
            t = min(left, flow.longest)
            if row + 1 < len(begins):
                if passed >= begins[row + 1]:
                    energy = energy_stored(q.ground, -q.k12, q.epsilon, boxes, balls)
                    if row >= 0:
                        rows[row, STORED] += energy
                    row += 1
                    rows[row, STORED] -= energy
                    continue
                t = min(t, begins[row + 1] - passed)
            boxes = _follow(flow, forms, walls, boxes, phase, t, rows[max(row, 0)], row >= 0)
            balls = drift_balls(balls, walls, boxes, t)
            phase, tail = advance_phase(phase, tail, q.omega, t)
            left, passed = left - t, passed + t
        if n < len(events):
            event = events[n]
            if not completes_chatter(events, n):
                passed = event[0]  # sums of lengths would accumulate rounding
            if row >= 0:
                kappa = q.kappa if event[3] == IMPACT else 0.0
                rows[row, IMPACTS + int(event[1]) - 1] += impact_loss(q.epsilon, kappa, event[APPROACH])
    rows[row, STORED] += energy_stored(q.ground, -q.k12, q.epsilon, boxes, balls)


@inlined_source
def _follow(flow, forms, walls, boxes, phase, t, row, counted):
    """Return the boxes after a flight no longer than flow.longest; add its integrals to the row if `counted`."""
    q, mode, j = flow.coefficients, mode_of(walls), int(t * flow.density + 0.5)
    rest, sine, cosine = t - j * flow.spacing, math.sin(phase), math.cos(phase)
    jets, (s, c) = jet_at(flow, mode, boxes, sine, cosine, j), rotate_phase(flow, sine, cosine, j)
    if counted:
        z = (boxes[0], boxes[1], boxes[2], boxes[3], sine, cosine)
        for k in range(FORMS):
            form, total, place = forms[mode, j, k], 0.0, 0
            for a in range(SIZE):
                for b in range(a, SIZE):
                    total += form[place] * (z[a] * z[b])
                    place += 1
            row[k] += total
        for k in range(len(REST)):
            _add_powers(jets, s, c, q.omega, rest * REST[k], rest * SHARES[k], row)
    return evaluate(jets, rest)


@inlined
def _add_powers(jets, sine, cosine, omega, t, weight, row):
    """Add the five integrands a short time t after a node, times a weight, to a row."""
    v1, v2, angle = slope(jets[0], t), slope(jets[1], t), omega * t
    force = weight * (sine * math.cos(angle) + cosine * math.sin(angle))
    row[0] += force * v1
    row[1] += force * v2
    row[2] += weight * v1 * v1
    row[3] += weight * v2 * v2
    row[4] += weight * (v1 - v2) * (v1 - v2)
