"""Where the energy of a run goes: work of the forces, dampers, impacts, and what boxes, balls and springs store.

Work and dissipation are integrals of quadratic forms along the flights, tabulated as the flow is (`squares`); none of
them is found as what the others leave, so that they add up to the change of what is stored by being right. The stick
that ends a chatter takes what is left of the relative motion: the energy of the rebounds that are not listed.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from vibroimpact.exact.engine.compiled import compiled, inlined, unfolded
from vibroimpact.exact.engine.event_log import APPROACH
from vibroimpact.exact.engine.flow import along, jet_at, slope, turned
from vibroimpact.exact.engine.motion import carry, mode_of
from vibroimpact.exact.engine.phase import ahead
from vibroimpact.exact.engine.replay import FORCING, LENGTH, completes_chatter, start_of
from vibroimpact.exact.engine.squares import REST, SHARES, SIZE, integrals_of
from vibroimpact.system.energy import stored
from vibroimpact.system.glance import Glance, brief
from vibroimpact.system.restitution import energy_lost
from vibroimpact.system.state import IMPACT

ENERGY = np.dtype(
    [("work", "f8", (2,)), ("ground", "f8", (2,)), ("coupling", "f8"), ("impacts", "f8", (2,)), ("stored", "f8")]
)
"""Energies over some time, in units of M L^2 omega_10^2: the work of each force, what each damper to ground and the one
between the boxes dissipate, what the impacts of each module lose, and the change of what is stored."""

FORMS, IMPACTS, STORED, ENTRIES = 5, 5, 7, 8
"""Places in a row of the kernel: the integrals of sin X_1', sin X_2', X_1'^2, X_2'^2, (X_1' - X_2')^2, and so on."""

DIFFERENCE = np.outer([0, 0, 1, -1, 0, 0], [0, 0, 1, -1, 0, 0])


def _kernels():
    """The five quadratic forms of z that are integrated, shape (5, 6, 6)."""
    unit = np.eye(SIZE)
    work = [(np.outer(unit[2 + i], unit[4]) + np.outer(unit[4], unit[2 + i])) / 2 for i in range(2)]
    return np.stack([*work, *(np.diag(unit[2 + i]) for i in range(2)), DIFFERENCE])


KERNELS = _kernels()
lost, held = inlined(energy_lost), inlined(stored)


@lru_cache(maxsize=16)
def powers_of(system) -> np.ndarray:
    """The forms of a system that `account` needs, shape (4, n, 5, 21)."""
    return integrals_of(system, KERNELS)


@dataclass(frozen=True, eq=False, repr=False)
class Energy(Glance):
    """Where the energy of a run goes, in units of M L^2 omega_10^2 (omega_10^2 = k_1 / M).

    work: (2,), of the force on each box. ground: (2,), dissipated by the damper from each box to ground, and coupling,
    by the one between the boxes. impacts: (2,), lost in the impacts of each module, completed chatters included.
    stored: the change of what boxes, balls and springs store, so that work = ground + coupling + impacts + stored.
    per_cycle: (cycles,) structured array (ENERGY) with the same fields for each forcing period since the start of the
    run; an event in the instant between two of them belongs to the later one.
    """

    work: np.ndarray
    ground: np.ndarray
    coupling: float
    impacts: np.ndarray
    stored: float
    per_cycle: np.ndarray

    @classmethod
    def of(cls, run) -> "Energy":
        """The energy of a finished run."""
        system, (flow, flights, events) = run.system, run.course
        rows = np.zeros((max(run.cycles, 1), ENTRIES))
        account(flow, powers_of(system), flights, events, system.period * np.arange(len(rows)), rows)
        total = energies(system, rows.sum(axis=0))
        per_cycle = energies(system, rows[: run.cycles])
        for array in (total, per_cycle):
            array.flags.writeable = False
        return cls(*(total[name] for name in ENERGY.names), per_cycle=per_cycle)

    @property
    def residual(self) -> float:
        """What the sums of both sides differ by, which is rounding."""
        return float(self.work.sum() - self.ground.sum() - self.coupling - self.impacts.sum() - self.stored)

    @property
    def impact_share(self) -> float:
        """What the impacts take of the work of both forces."""
        return float(self.impacts.sum() / self.work.sum())

    def _glance(self):
        return {name: brief(getattr(self, name)) for name in ENERGY.names}


def energies(system, rows) -> np.ndarray:
    """Energies (...,), ENERGY, from rows (..., ENTRIES) of the kernel."""
    factors = [*system.forcing, system.gamma1, system.gamma2, system.gamma12, 1.0, 1.0, 1.0]
    return np.ascontiguousarray(rows * factors).view(ENERGY)[..., 0]


@compiled
def account(flow, forms, flights, events, begins, rows):
    """Add up, in rows (k, ENTRIES) of zeros, the integrals along a run's flights (`departures` is enough).

    begins (k,): ascending times since the start of the run at which the rows begin; the last one goes on to the end.
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
                    energy = held(q.ground, -q.k12, q.epsilon, boxes, balls)
                    if row >= 0:
                        rows[row, STORED] += energy
                    row += 1
                    rows[row, STORED] -= energy
                    continue
                t = min(t, begins[row + 1] - passed)
            boxes = _follow(flow, forms, walls, boxes, phase, t, rows[max(row, 0)], row >= 0)
            balls = carry(balls, walls, boxes, t)
            phase, tail = ahead(phase, tail, q.omega, t)
            left, passed = left - t, passed + t
        if n < len(events):
            event = events[n]
            if not completes_chatter(events, n):
                passed = event[0]  # sums of lengths would drift
            if row >= 0:
                kappa = q.kappa if event[3] == IMPACT else 0.0
                rows[row, IMPACTS + int(event[1]) - 1] += lost(q.epsilon, kappa, event[APPROACH])
    rows[row, STORED] += held(q.ground, -q.k12, q.epsilon, boxes, balls)


@unfolded
def _follow(flow, forms, walls, boxes, phase, t, row, counted):
    """The boxes after a flight no longer than flow.longest, whose integrals are added to the row, if counted."""
    q, mode, j = flow.coefficients, mode_of(walls), int(t * flow.density + 0.5)
    rest, sine, cosine = t - j * flow.spacing, math.sin(phase), math.cos(phase)
    jets, (s, c) = jet_at(flow, mode, boxes, sine, cosine, j), turned(flow, sine, cosine, j)
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
    return along(jets, rest)


@inlined
def _add_powers(jets, sine, cosine, omega, t, weight, row):
    """Add the five integrands a short time t after a node, weighed, to a row."""
    v1, v2, angle = slope(jets[0], t), slope(jets[1], t), omega * t
    force = weight * (sine * math.cos(angle) + cosine * math.sin(angle))
    row[0] += force * v1
    row[1] += force * v2
    row[2] += weight * v1 * v1
    row[3] += weight * v2 * v2
    row[4] += weight * (v1 - v2) * (v1 - v2)
