"""Find all 1:1 responses of (10.2) with two impacts per forcing cycle and module, one at each wall."""

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import expm

from vibroimpact.exact.orbits.asymmetric import STARTS, asymmetric_solutions
from vibroimpact.exact.orbits.floquet import Passage, active_part, floquet, follow, impact_sequence, multipliers
from vibroimpact.exact.orbits.impulse_response import forced_amplitude, impulse_response
from vibroimpact.exact.orbits.symmetric import symmetric_solutions, wrapped
from vibroimpact.system import System
from vibroimpact.system.amplitude import path_of, sawtooth_amplitude
from vibroimpact.system.arguments import instance
from vibroimpact.system.matrices import rate_matrix, stiffness_matrix
from vibroimpact.system.representation import Found, Representation, brief
from vibroimpact.system.state import BALLS, BOXES, NAMES, inactive_at_rest
from vibroimpact.system.verdict import STABLE, UNSTABLE

_STEP = 0.005  # phase change [rad] of the fastest oscillation from sample to sample; interpolation is exact to 2e-12
_SAMPLES = 4096  # largest number of samples of a flight in memory at a time
_TOUCH = 1e-9
_SIDES = "1_plus", "1_minus", "2_plus", "2_minus"
COLUMNS = (
    *("symmetric", "admissible", "C1", "C2"),
    *(f"{what}{side}" for what in ("phase", "speed") for side in _SIDES),
    *(f"modulus_{k}" for k in range(1, 9)),
    *(*NAMES, "residual", "exact", "proved"),
)
"""Columns of the table of orbits."""


@dataclass(frozen=True, eq=False, repr=False)
class Orbit(Representation):
    """A periodic response with two impacts per forcing cycle and module, in dimensionless quantities.

    Arrays of shape (2, 2) have the indices [module, wall +1 / wall -1]. For a single machine (`PhysicalSystem.single`),
    the values of the second module are 0 in `state` and NaN in the other arrays.

    Attributes
    ----------
    system : System
        System of the orbit.
    symmetric : bool
        True if state(tau + T/2) = -state(tau).
    impact_phases : ndarray
        Impact times as fractions of the period, in [0, 1), shape (2, 2).
    ball_speeds : ndarray
        Ball speeds after the impacts, shape (2, 2). They can be negative if the orbit is not admissible.
    multipliers : ndarray
        Complex Floquet multipliers by descending modulus, shape (8,), or (4,) for a single machine. If both modules
        impact at the same instant and gamma12 is not 0, the multipliers hold for perturbed motions in which module 1
        impacts first.
    state : ndarray
        State at tau = 0, shape (8,). If an impact happens at this time, it is the state just after the impact.
    passage : Passage
        Motion over one period from `state`.
    excursion : float
        Largest |W_i| at the extrema of W_i between impacts, or 0 if there are no extrema. The walls are at |W_i| = 1.
    admissible : bool
        True if the orbit is a motion of the system: all ball speeds are positive, and |W_i| <= 1 at all times.
    residual : float
        Largest difference between W_i and the wall (+1 or -1) at the impacts, or between state(T) and state(0).
    proof : OrbitProof, optional
        Proof of the orbit if the orbit comes from `with_proof`, else None.

    Examples
    --------
    >>> orbit = vi.orbits(system)[0]
    >>> orbit.multipliers.shape
    (8,)
    """

    system: System
    symmetric: bool
    impact_phases: np.ndarray
    ball_speeds: np.ndarray
    multipliers: np.ndarray
    state: np.ndarray
    passage: Passage
    excursion: float
    admissible: bool
    residual: float
    proof: object = None

    @property
    def stability(self) -> str:
        """Stability "stable", "unstable" or "undecided", from the proof if `proved` is True, else from multipliers."""
        return self.proof.stability if self.proved else floquet(self)

    @property
    def stable(self) -> bool | None:
        """True if stable, False if unstable, None if undecided."""
        return {STABLE: True, UNSTABLE: False}.get(self.stability)

    @property
    def proved(self) -> bool:
        """True if the stability is proved in interval arithmetic, False if it is only computed in floating point."""
        return self.proof is not None and self.proof.stability in (STABLE, UNSTABLE)

    def with_proof(self) -> "Orbit":
        """Return a copy of the orbit whose attribute `proof` is the result of `prove`.

        Returns
        -------
        Orbit
            The copy. Its `stability` is the proved verdict if there is one.

        Raises
        ------
        ModuleNotFoundError
            If python-flint is missing; the extra `reference` installs it.
        """
        return replace(self, proof=prove(self))

    def row(self) -> dict:
        """Return the row of `to_frame` for this orbit, as {column name: number or verdict}.

        Phases are in periods. A single machine has only 4 multipliers; the columns of the other 4 moduli are NaN. If
        the orbit has a proof, the row also has the columns of `OrbitProof.row`.
        """
        moduli = np.pad(np.abs(self.multipliers), (0, 8 - len(self.multipliers)), constant_values=np.nan)
        numbers = (self.C, self.impact_phases.ravel(), self.ball_speeds.ravel(), moduli, self.state, [self.residual])
        values = self.symmetric, self.admissible, *np.concatenate(numbers).tolist(), self.stability, self.proved
        return dict(zip(COLUMNS, values, strict=True)) | (self.proof.row() if self.proof else {})

    def _shown(self):
        return {
            "symmetric": str(self.symmetric),
            "admissible": str(self.admissible),
            "stable": f"{self.stable} ({'proved' if self.proved else 'computed'})",
            "C": brief(self.C),
            "multipliers": f"moduli up to {brief(abs(self.multipliers[0]))}",
        }

    @property
    def C(self) -> np.ndarray:
        """Saw-tooth amplitudes C_i of (10.11), shape (2,); C_i can be negative if the orbit is not admissible."""
        plus, minus = self.ball_speeds.T
        # The flight from wall +1 takes a time t, and the flight from wall -1 takes T - t. Both flights cover the same
        # distance: plus * t = minus * (T - t), with the speeds `plus` and `minus`.
        path = self.system.period * plus * minus / np.where(plus + minus == 0, 1.0, plus + minus)
        return sawtooth_amplitude(self.system.epsilon, path)

    @property
    def amplitudes(self) -> np.ndarray:
        """Largest displacements |X_i| of the boxes, shape (2,); NaN for an inactive module (see `System.modules`)."""
        at_impacts = abs(self.passage.before[:, [0, 2]]).max(axis=0)
        largest = np.maximum(at_impacts, extremes(self.system, self.passage, balls=0.0))
        return np.where(np.isin([1, 2], self.system.modules), largest, np.nan)


@dataclass(frozen=True, eq=False)
class OrbitSearch:
    """Orbits of a system, and the effort of the search for asymmetric orbits.

    Attributes
    ----------
    orbits : list of Orbit
        The symmetric orbits, which are complete up to rounding, and the asymmetric orbits that were found.
    starts : int
        Number of starting values of Newton's method in the search for asymmetric orbits. The search may miss orbits.
    fewest_hits : int
        For each asymmetric orbit, the starting values that led to the orbit or to its mirror image are counted. This
        number is the smallest count, or 0 if no asymmetric orbit was found. A small number suggests that orbits were
        missed.
    """

    orbits: list[Orbit]
    starts: int
    fewest_hits: int


def orbits(system: System) -> list[Orbit]:
    """Return all 1:1 responses of (10.2) with one impact per cycle at each wall of each module.

    The orbits are exact at any mass ratio epsilon. The symmetric orbits are complete up to rounding. The asymmetric
    orbits are found by Newton's method from many starting values. Some asymmetric orbits may be missed.

    Parameters
    ----------
    system : System
        Dimensionless parameters.

    Returns
    -------
    list of Orbit
        Orbits, including roots that are not motions of the system (see `Orbit.admissible`). Symmetric orbits come
        first. Within each of the two groups, orbits are sorted by ball speeds. An asymmetric orbit is next to its
        mirror image.

    Raises
    ------
    ValueError
        If system is not a System, or if its boxes have an undamped resonance at a multiple of the forcing frequency.

    Examples
    --------
    >>> orbits = vi.orbits(system)
    >>> [orbit.stability for orbit in orbits if orbit.admissible]  # doctest: +SKIP
    """
    return Found(search(system).orbits, COLUMNS)


def search(system: System) -> OrbitSearch:
    """Return the orbits that `orbits` finds, and the effort of the search.

    The exceptions are those of `orbits`.
    """
    instance("system", system, System)
    symmetric = [symmetric_orbit(system, root) for root in symmetric_solutions(system)]
    roots, hits = asymmetric_solutions(system)
    asymmetric = [asymmetric_orbit(system, root) for root in roots]
    fewest = int(hits.min()) if len(hits) else 0
    return OrbitSearch(sorted(symmetric + asymmetric, key=_order), STARTS, fewest)


def prove(orbit: Orbit):
    """Prove existence, motion between the walls and stability of an orbit in interval arithmetic.

    Parameters
    ----------
    orbit : Orbit
        An orbit from `orbits`.

    Returns
    -------
    OrbitProof
        Verdicts and error bounds. The attribute `radius` is the half-width of intervals around the impact times and
        the changes of ball velocity. Exactly one orbit lies in these intervals.

    Raises
    ------
    ValueError
        If orbit is not an Orbit, or if its boxes have an undamped resonance at a multiple of the forcing frequency.
    ModuleNotFoundError
        If python-flint is missing; the extra `reference` installs it.

    References
    ----------
    Krawczyk 1969; Neumaier 1990 (existence); Rump 2010 (eigenvalues).

    Examples
    --------
    >>> vi.prove(vi.orbits(system)[0]).stability  # doctest: +SKIP
    """
    from vibroimpact.exact.orbits.proof import orbit as proofs

    return proofs.prove(instance("orbit", orbit, Orbit))


def half_period_multipliers(orbit: Orbit) -> np.ndarray:
    """Return the half-period multipliers of a symmetric orbit.

    The half-period multipliers are the eigenvalues of the derivative of -state(T/2) with respect to state(0). Their
    squares are the Floquet multipliers of the orbit. At a fold, one half-period multiplier is +1. At symmetry breaking,
    one half-period multiplier is -1. Raise ValueError if the orbit is not symmetric.
    """
    if not orbit.symmetric:
        raise ValueError("orbit: must be symmetric; got an orbit that is not symmetric")
    system = orbit.system
    times, modules, _ = impact_sequence(orbit.impact_phases * system.period, system.period)
    first = slice(len(times) // 2)
    passage = follow(system, orbit.state, times[first], modules[first], system.period / 2)
    return multipliers(-active_part(system, passage.jacobian))


def _order(orbit):
    """Return the key by which orbits are sorted; the phases distinguish orbits with equal ball speeds."""
    numbers = [*orbit.ball_speeds.sum(axis=1), *orbit.impact_phases.ravel()]
    return (not orbit.symmetric, *np.nan_to_num(numbers).round(9))


def symmetric_orbit(system, root) -> Orbit:
    """Return the Orbit for a root (tau_1, tau_2, C_1, C_2) of `SymmetricConditions`."""
    return _orbit(system, *_symmetric_impacts(system, root), np.full(2, 0.5), sign=-1)


def symmetric_boxes(system, root, tau) -> np.ndarray:
    """Return the box displacements X_1 and X_2 of a symmetric motion at the times tau, shape (n, 2).

    root: root of `SymmetricConditions`, shape (4,). tau: times, shape (n,).
    """
    return _boxes(system, *_symmetric_impacts(system, root), -1, tau)[:, :2]


def _symmetric_impacts(system, root):
    """Return the impact times, shape (2, 2), and the changes of ball velocity, shape (2,), of a symmetric motion.

    root: root of `SymmetricConditions`, shape (4,).
    """
    times, C = root[:2], root[2:]
    later = wrapped(times + system.period / 2, system.period)
    return np.stack([times, later], axis=1), 4 * path_of(system.epsilon, C) / system.period


def asymmetric_orbit(system, root) -> Orbit:
    """Return the Orbit for a root (p_1, q_1, p_2, q_2, I_1, I_2) of `AsymmetricConditions`."""
    times = root[:4].reshape(2, 2)
    fractions = wrapped(times[:, 1] - times[:, 0], system.period) / system.period
    return _orbit(system, times, root[4:], fractions, sign=1)


def _orbit(system, times, changes, fractions, sign):
    """Return the Orbit with given impact times and changes of ball velocity.

    times: impact times with the indices [module, wall +1 / wall -1], shape (2, 2).
    changes: change of ball velocity at wall +1 in each module, shape (2,).
    fractions: duration of the flight from wall +1 in periods, for each module, shape (2,).
    sign: -1 for a symmetric orbit, +1 for an asymmetric orbit.
    """
    speeds = changes[:, None] * np.stack([1 - fractions, fractions], axis=1)
    state = inactive_at_rest(system, _state(system, times, changes, speeds, sign))
    alone = np.where(np.isin([1, 2], system.modules), 1.0, np.nan)[:, None]
    times, speeds = alone * times, alone * speeds
    in_order, modules, walls = impact_sequence(times, system.period)
    passage = follow(system, state, in_order, modules, system.period)
    gaps = passage.before[:, [0, 2]] - passage.before[:, [1, 3]]
    at_wall = gaps[range(len(walls)), modules - 1] - walls
    excursion = float(extremes(system, passage).max())
    return Orbit(
        system=system,
        symmetric=sign == -1,
        impact_phases=wrapped(times / system.period, 1.0),
        ball_speeds=speeds,
        multipliers=multipliers(active_part(system, passage.jacobian)),
        state=state,
        passage=passage,
        excursion=excursion,
        admissible=bool(not (speeds <= 0).any() and excursion <= 1 + _TOUCH),
        residual=float(max(abs(at_wall).max(), abs(passage.final - state).max())),
    )


def _boxes(system, times, changes, sign, tau):
    """Return the motion [X_1, X_2, X_1', X_2'] of the boxes at the times tau, shape (n, 4).

    times, changes, sign: impact times, changes of ball velocity and sign as for `_orbit`.
    """
    response, amplitude = impulse_response(system, sign), forced_amplitude(system)
    # In a symmetric orbit, the impacts of a module form one train of alternating impulses. In an asymmetric orbit, they
    # form one train of equal impulses per wall.
    trains = 1 if sign == -1 else 2
    kicks = (system.epsilon * changes[:, None] * [-1.0, 1.0])[:, :trains]
    forced = amplitude * np.exp(1j * system.Omega * tau[:, None])
    kicked = response(tau[:, None, None] - times[:, :trains], np.arange(2)[:, None])
    return np.hstack([forced.imag, system.Omega * forced.real]) + np.einsum("niks,ik->ns", kicked, kicks)


def _state(system, times, changes, speeds, sign):
    """Return the state at tau = 0, shape (8,).

    speeds: ball speeds after the impacts with the indices [module, wall +1 / wall -1], shape (2, 2). times, changes,
    sign: impact times, changes of ball velocity and sign as for `_orbit`.
    """
    since = wrapped(-times, system.period)
    modules, last = np.arange(2), since.argmin(axis=1)
    walls = np.array([1, -1])[last]
    velocities = walls * speeds[modules, last]
    now, *then = _boxes(system, times, changes, sign, np.array([0.0, *times[modules, last]]))
    state = np.empty(8)
    state[BOXES] = now
    state[BALLS[:2]] = np.diagonal(then) - walls + velocities * since[modules, last]
    state[BALLS[2:]] = velocities
    return state


def extremes(system, passage: Passage, balls: float = 1.0) -> np.ndarray:
    """Return the largest |X_i - `balls` Y_i| of each module at extrema inside free flights, shape (2,).

    Only the extrema of X_i - `balls` Y_i are considered. If `balls` is 1, the result is the largest |W_i|. If `balls`
    is 0, it is the largest |X_i|. If there are no extrema, the result is 0.
    """
    states, begins, durations = passage.flights()
    fastest = max(system.Omega, math.sqrt(np.linalg.norm(stiffness_matrix(system), 2)))
    count = 1 + math.ceil(durations.max() * fastest / _STEP)
    spacing = (durations / count)[:, None, None]
    step = expm(rate_matrix(system) * spacing)
    phases = system.Omega * begins
    boxes = np.column_stack([states[:, BOXES], np.sin(phases), np.cos(phases)])
    places, velocities = balls * states[:, None, BALLS[:2]], balls * states[:, None, BALLS[2:]]
    found = np.zeros(2)
    for first in range(0, count, _SAMPLES):
        steps = np.arange(first, min(first + _SAMPLES, count) + 1)
        samples = _samples(step, boxes, len(steps))
        boxes = samples[:, -1]
        W = samples[..., :2] - places - velocities * (spacing * steps[:, None])
        V = (samples[..., 2:4] - velocities) * spacing
        # Hermite interpolation between the samples gives the extrema of W.
        turns = V[:, :-1] * V[:, 1:] < 0
        w0, w1, v0, v1 = W[:, :-1][turns], W[:, 1:][turns], V[:, :-1][turns], V[:, 1:][turns]
        s = v0 / (v0 - v1)  # zero of V to O(spacing^2); this error hardly changes W, since V = dW/ds is 0 there
        values = w0 + (w1 - w0) * s * s * (3 - 2 * s) + s * (1 - s) * (v0 * (1 - s) - v1 * s)
        np.maximum.at(found, turns.nonzero()[2], abs(values))
    return found


def _samples(step, start, count):
    """Return the products of step^k and `start` for k = 0 .. count - 1, shape (n, count, d).

    step: n matrices, shape (n, d, d). start: n vectors, shape (n, d).
    """
    samples, ahead = start[:, None], step.swapaxes(1, 2)
    while (made := samples.shape[1]) < count:  # rounding errors grow only with log(count)
        samples = np.concatenate([samples, samples[:, : count - made] @ ahead], axis=1)
        ahead = ahead @ ahead
    return samples
