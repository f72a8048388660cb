"""Energy balance of a run: work of the forces, dissipation in dampers and impacts, stored energy.

Each term is computed independently. Therefore the balance tests all terms. The stick that completes a chatter
dissipates the remaining energy of the relative motion.

Work and dissipation in dampers are integrals of quadratic forms z G z over the flights, with a matrix G. In flight, the
vector z = [X1, X2, X1', X2', sin, cos] obeys z' = A z; sin and cos belong to the forcing phase. If the system is
damped, z G z is the rate of change of a potential z S z + c t. The matrix S and the number c solve Lyapunov's equation
A^T S + S A + c (sin^2 + cos^2) = G. The integral of z G z is then the difference of the potential between the ends of a
flight.

If the damping is very small, S is large and rounding spoils the difference. In this case, Gauss's rule integrates z G z
along the Taylor polynomials of the motion.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, inlined_source
from vibroimpact.exact.engine.contact import APPROACH, Motion, drift_balls
from vibroimpact.exact.engine.flow import (
    advance,
    advance_phase,
    jet_at,
    mode_of,
    numbers_of,
    rotate_phase,
    slope,
    value,
)
from vibroimpact.exact.engine.variation import FORCING, LENGTH, completes_chatter, start_of
from vibroimpact.system.representation import Representation, brief
from vibroimpact.system.restitution import energy_lost
from vibroimpact.system.state import IMPACT
from vibroimpact.system.stored_energy import stored

SIZE, TRIANGLE = 6, 21
ROWS, COLUMNS = np.triu_indices(SIZE)
LARGEST = 1e3
"""Limit on (largest entry of `Squares`) x (largest rate); below it, differences of potentials keep enough digits."""
NODES, WEIGHTS = (tuple(part.tolist()) for part in np.polynomial.legendre.leggauss(4))
"""Gauss's rule with four nodes; over one spacing of the flow table its error is below rounding."""


class Squares(NamedTuple):
    """Potentials that give k integrals along a flight, in each of the four contact states.

    potentials: matrices S, shape (4, k, 6, 6). drifts: numbers c, shape (4, k).
    Each integral is the change of z S z + c t in the flight, where z = [X1, X2, X1', X2', sin, cos]. If k = 0, Gauss's
    rule computes the integrals instead.
    """

    potentials: np.ndarray
    drifts: np.ndarray


NO_POTENTIALS = Squares(np.empty((4, 0, SIZE, SIZE)), np.empty((4, 0)))


X1, X2, V1, V2, SINE = np.eye(SIZE)[:5]
POSITIONS = (X1, X1), (X2, X2)
FORMS = *POSITIONS, (SINE, V1), (SINE, V2), (V1, V1), (V2, V2), (V1 - V2, V1 - V2)
"""Quadratic forms to integrate, as products of two linear forms: X_1^2, X_2^2 and the terms of the energy balance."""
OBSERVED = np.stack([(np.outer(one, other) + np.outer(other, one)) / 2 for one, other in FORMS])
"""Symmetric matrices G, (7, 6, 6): z G z is the value of each of the FORMS."""
LOSSES, STORED, ENTRIES = 7, 9, 10
"""First index of the losses, index of the stored energy, and length of a row of energies. The row contains 7 integrals,
the losses in the impacts of both modules, and the change of the stored energy."""
ENERGY = np.dtype(
    [("work", "f8", (2,)), ("ground", "f8", (2,)), ("coupling", "f8"), ("impacts", "f8", (2,)), ("stored", "f8")]
)
"""Data type for energies over some time, in units of M L^2 omega_10^2; the names are those of `Energy`."""
impact_loss, energy_stored = inlined(energy_lost), inlined(stored)


UNITS = np.zeros((TRIANGLE, SIZE, SIZE))
UNITS[np.arange(TRIANGLE), ROWS, COLUMNS] = UNITS[np.arange(TRIANGLE), COLUMNS, ROWS] = 1.0
"""Basis of the symmetric matrices, which are represented by the 21 entries of their upper triangle."""


def potentials_of(rates, kernels) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return potentials, drifts and flags for the integrals of z G z along the flights of n systems.

    rates: rate matrices A for each of the four contact states, shape (n, 4, 6, 6).
    kernels: matrices G, shape (k, 6, 6).
    The potentials S have shape (n, 4, k, 6, 6), the drifts c shape (n, 4, k) and the flags shape (n,). The flag of a
    system is True if differences of z S z + c t keep enough digits.
    """
    equations = np.zeros((*rates.shape[:2], TRIANGLE + 1, TRIANGLE + 1))
    images = UNITS @ rates[:, :, None]
    images = (images + images.swapaxes(-1, -2))[..., ROWS, COLUMNS]  # A^T S + S A for each matrix S in UNITS
    equations[..., :-1, :-1] = images.swapaxes(-1, -2)
    # The equation determines S only up to a multiple of sin^2 + cos^2. These entries select one S.
    equations[..., :-1, -1] = equations[..., -1, :-1] = (ROWS == COLUMNS) & (ROWS >= 4)
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


@lru_cache(maxsize=64)
def squares_of(system) -> Squares:
    """Return the potentials for the integrals of the quadratic forms `OBSERVED`.

    If differences of these potentials would lose too many digits, return NO_POTENTIALS.
    """
    _, rates = numbers_of([system], 2)
    potentials, drifts, sound = potentials_of(rates[:, 0], OBSERVED)
    return Squares(potentials[0], drifts[0]) if sound[0] else NO_POTENTIALS


@dataclass(frozen=True, eq=False, repr=False)
class Energy(Representation):
    """Energy balance of a run, in units of M L^2 omega_10^2 (omega_10^2 = k_1 / M).

    The balance is work = ground + coupling + impacts + stored.

    Attributes
    ----------
    work : ndarray
        Work of the force on each box, shape (2,).
    ground : ndarray
        Energy dissipated by the damper between each box and the ground, shape (2,).
    coupling : float
        Energy dissipated by the damper between the boxes.
    impacts : ndarray
        Energy lost in the impacts and completed chatters of each module, shape (2,).
    stored : float
        Change of the energy stored in boxes, balls and springs.
    per_cycle : ndarray
        Energies of each forcing period: structured array of type ENERGY, shape (cycles,). An event at the boundary of
        two periods belongs to the later period.

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
        rows = np.zeros((max(run.cycles, 1), ENTRIES))
        accumulate_energy(*run.trajectory, squares_of(run.system), run.system.period, rows)
        total = energies(run.system, rows.sum(axis=0))
        per_cycle = energies(run.system, rows[: run.cycles])
        for array in (total, per_cycle):
            array.flags.writeable = False
        return cls(*(total[name] for name in ENERGY.names), per_cycle=per_cycle)

    @property
    def residual(self) -> float:
        """Difference work - (ground + coupling + impacts + stored), summed over both modules.

        This difference is due to rounding only.
        """
        return float(self.work.sum() - self.ground.sum() - self.coupling - self.impacts.sum() - self.stored)

    @property
    def impact_share(self) -> float:
        """Energy lost in impacts divided by the work of both forces."""
        return float(self.impacts.sum() / self.work.sum())

    def _shown(self):
        return {name: brief(getattr(self, name)) for name in ENERGY.names}


def energies(system, rows) -> np.ndarray:
    """Return a structured array of type ENERGY from rows that `accumulate_energy` filled.

    rows: shape (..., ENTRIES). The result has shape (...).
    """
    factors = [*system.forcing, system.gamma1, system.gamma2, system.gamma12, 1.0, 1.0, 1.0]
    return np.ascontiguousarray(rows[..., len(POSITIONS) :] * factors).view(ENERGY)[..., 0]


@compiled
def accumulate_energy(flow, flights, events, squares, period, rows):
    """Add the integrals, losses and changes of stored energy along a run to `rows`.

    rows: shape (k, ENTRIES), initially 0. Each row covers one period. The last row also covers the rest of the run.
    """
    q, row, passed = flow.coefficients, 0, 0.0
    boxes, balls, walls = start_of(flights[0])
    rows[0, STORED] -= energy_stored(q.ground, -q.k12, q.epsilon, boxes, balls)
    for n in range(len(flights)):
        boxes, balls, walls = start_of(flights[n])
        left, phase, tail = flights[n, LENGTH], flights[n, FORCING], 0.0
        while True:
            until = period * (row + 1) if row + 1 < len(rows) else math.inf
            if passed >= until:
                energy = energy_stored(q.ground, -q.k12, q.epsilon, boxes, balls)
                rows[row, STORED] += energy
                row += 1
                rows[row, STORED] -= energy
            elif left > 0.0:
                t = min(min(left, flow.longest), until - passed)
                motion = Motion(boxes, balls, walls, (0, 0), math.sin(phase), math.cos(phase))
                boxes = _follow(flow, squares, motion, t, rows[row])
                balls = drift_balls(balls, walls, boxes, t)
                phase, tail = advance_phase(phase, tail, q.omega, t)
                left, passed = left - t, passed + t
            else:
                break
        if n < len(events):
            event = events[n]
            if not completes_chatter(events, n):
                passed = event[0]  # a sum of flight times would accumulate rounding errors
            kappa = q.kappa if event[3] == IMPACT else 0.0
            rows[row, LOSSES + int(event[1]) - 1] += impact_loss(q.epsilon, kappa, event[APPROACH])
    rows[row, STORED] += energy_stored(q.ground, -q.k12, q.epsilon, boxes, balls)


@inlined_source
def _follow(flow, squares, motion, t, row):
    """Return the boxes after a flight of length t <= flow.longest; add the integrals over the flight to `row`."""
    mode = mode_of(motion.walls)
    boxes, sine, cosine = advance(flow, mode, motion.boxes, motion.sine, motion.cosine, t)
    if squares.drifts.shape[1] == 0:
        _add_quadrature(flow, mode, motion, t, row)
    else:
        add_potentials(squares, mode, motion.boxes, motion.sine, motion.cosine, -1.0, row)
        add_potentials(squares, mode, boxes, sine, cosine, 1.0, row)
        for k in range(squares.drifts.shape[1]):
            row[k] += squares.drifts[mode, k] * t
    return boxes


@inlined
def add_potentials(squares, mode, boxes, sine, cosine, sign, sums):
    """Add `sign` times the k potentials z S z at one point of a flight to `sums`, shape (k,)."""
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
def _add_quadrature(flow, mode, motion, length, row):
    """Add the integrals of the quadratic forms `OBSERVED` over a flight to `row`, computed by Gauss's rule.

    length: duration of the flight, at most `flow.longest`.
    """
    for j in range(int(length * flow.density + 0.5) + 1):
        jets = jet_at(flow, mode, motion.boxes, motion.sine, motion.cosine, j)
        sine, cosine = rotate_phase(flow, motion.sine, motion.cosine, j)
        low = max(-0.5 * flow.spacing, -j * flow.spacing)
        half = 0.5 * (min(0.5 * flow.spacing, length - j * flow.spacing) - low)
        for k in range(len(NODES)):
            t, weight = low + half * (1.0 + NODES[k]), half * WEIGHTS[k]
            x1, x2, v1, v2 = value(jets[0], t), value(jets[1], t), slope(jets[0], t), slope(jets[1], t)
            angle = flow.coefficients.omega * t
            force = weight * (sine * math.cos(angle) + cosine * math.sin(angle))
            row[0] += weight * x1 * x1
            row[1] += weight * x2 * x2
            row[2] += force * v1
            row[3] += force * v2
            row[4] += weight * v1 * v1
            row[5] += weight * v2 * v2
            row[6] += weight * (v1 - v2) * (v1 - v2)
