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

_STEP = 0.005  # radians of the fastest oscillation between samples of W; interpolation is exact to 2e-12
_SAMPLES = 4096  # samples of a flight in memory at a time
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

    Arrays (2, 2) have the indices [module, wall +1 / wall -1]. For a single machine (`PhysicalSystem.single`), values
    of the second module are 0 in the state and NaN elsewhere.

    Attributes
    ----------
    system : System
        System of the orbit.
    symmetric : bool
        True if state(tau + T/2) = -state(tau).
    impact_phases : ndarray
        Impact times as fractions of the period, in [0, 1), (2, 2).
    ball_speeds : ndarray
        Ball speeds after the impacts, (2, 2); they can be negative for an inadmissible root.
    multipliers : ndarray
        Complex Floquet multipliers by descending modulus, (8,), or (4,) for a single machine. If both modules impact at
        the same instant and gamma12 is not 0, they hold for perturbed motions in which module 1 impacts first.
    state : ndarray
        State at tau = 0, (8,); if there is an impact at this time, the state just after it.
    passage : Passage
        Motion over one period from `state`.
    excursion : float
        Largest |W_i| at extrema of W_i between impacts (the walls are at 1); 0 without extrema.
    admissible : bool
        True if the orbit is a motion of the system: all ball speeds are positive, and |W_i| <= 1 at all times.
    residual : float
        Largest error of |W_i| = 1 at the impacts and of state(T) = state(0).
    proof : OrbitProof, optional
        Proof of the orbit from `with_proof`, or None.

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
        """ "stable", "unstable" or "undecided": the proved verdict, or else the verdict from the multipliers."""
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
        """Return a copy of the orbit with the attribute `proof` from `prove`.

        Returns
        -------
        Orbit
            The copy, whose `stability` is the proved verdict if there is one.

        Raises
        ------
        ModuleNotFoundError
            If python-flint is missing; the extra `reference` installs it.
        """
        return replace(self, proof=prove(self))

    def row(self) -> dict:
        """Return the row of `to_frame` for this orbit, as {column name: number or verdict}.

        Phases are in periods. A single machine has only 4 multipliers; the other moduli are NaN.
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
        """Saw-tooth amplitudes C_i, (10.11), shape (2,); C_i can be negative for an inadmissible root."""
        plus, minus = self.ball_speeds.T
        # Both flights are equally long: plus t = minus (T - t), where t is the time from wall +1.
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
        Orbits; the symmetric orbits are complete up to rounding.
    starts : int
        Number of Newton starts for asymmetric orbits, some of which may be missed.
    fewest_hits : int
        Smallest number of starts that led to the same asymmetric orbit or its mirror image; 0 if none was found. A
        small number suggests that orbits were missed.
    """

    orbits: list[Orbit]
    starts: int
    fewest_hits: int


def orbits(system: System) -> list[Orbit]:
    """Return all 1:1 responses of (10.2) with one impact per cycle at each wall of each module.

    The orbits are exact at any epsilon. Newton's method from many starts finds the asymmetric orbits and may miss some.

    Parameters
    ----------
    system : System
        Dimensionless parameters.

    Returns
    -------
    list of Orbit
        Orbits, including roots that are not motions of the system (see Orbit.admissible). Symmetric orbits come first.
        Each group is sorted by ball speeds. An asymmetric orbit is next to its mirror image.

    Raises
    ------
    ValueError
        If system is not a System, or if its boxes have an undamped resonance at a harmonic of the impacts.

    Examples
    --------
    >>> orbits = vi.orbits(system)
    >>> [orbit.stability for orbit in orbits if orbit.admissible]  # doctest: +SKIP
    """
    return Found(search(system).orbits, COLUMNS)


def search(system: System) -> OrbitSearch:
    """Return the orbits that `orbits` finds, and the effort of the search; exceptions as in `orbits`."""
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
        Verdicts, error bounds, and the half-width of intervals, around the numbers of the orbit, with exactly one root.

    Raises
    ------
    ValueError
        If orbit is not an Orbit, or if the boxes have an undamped resonance at a harmonic of the impacts.
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
    """Return the eigenvalues of the derivative of -state(T/2) by state(0) on a symmetric orbit.

    Their squares are the multipliers. A fold has the eigenvalue +1, symmetry breaking -1. An asymmetric orbit raises
    ValueError.
    """
    if not orbit.symmetric:
        raise ValueError("orbit: the orbit is not symmetric, so half a period does not map it to its mirror image")
    system = orbit.system
    times, modules, _ = impact_sequence(orbit.impact_phases * system.period, system.period)
    first = slice(len(times) // 2)
    passage = follow(system, orbit.state, times[first], modules[first], system.period / 2)
    return multipliers(-active_part(system, passage.jacobian))


def _order(orbit):
    """Return the key to sort an orbit by; the phases distinguish orbits with equal ball speeds."""
    numbers = [*orbit.ball_speeds.sum(axis=1), *orbit.impact_phases.ravel()]
    return (not orbit.symmetric, *np.nan_to_num(numbers).round(9))


def symmetric_orbit(system, root) -> Orbit:
    """Return the Orbit for a root (tau_1, tau_2, C_1, C_2) of `SymmetricConditions`."""
    return _orbit(system, *_symmetric_impacts(system, root), np.full(2, 0.5), sign=-1)


def symmetric_boxes(system, root, tau) -> np.ndarray:
    """Return X_1 and X_2 at times tau (n,), shape (n, 2), for a root (4,) of `SymmetricConditions`."""
    return _boxes(system, *_symmetric_impacts(system, root), -1, tau)[:, :2]


def _symmetric_impacts(system, root):
    """Return impact times (2, 2) and changes of ball velocity (2,) for a root (4,) of `SymmetricConditions`."""
    times, C = root[:2], root[2:]
    later = wrapped(times + system.period / 2, system.period)
    return np.stack([times, later], axis=1), 4 * path_of(system.epsilon, C) / system.period


def asymmetric_orbit(system, root) -> Orbit:
    """Return the Orbit for a root (p_1, q_1, p_2, q_2, I_1, I_2) of `AsymmetricConditions`."""
    times = root[:4].reshape(2, 2)
    fractions = wrapped(times[:, 1] - times[:, 0], system.period) / system.period
    return _orbit(system, times, root[4:], fractions, sign=1)


def _orbit(system, times, changes, fractions, sign):
    """Return the Orbit with impacts at `times` (2, 2) and changes of ball velocity `changes` (2,).

    fractions: durations of the flights from wall +1 in periods, (2,). sign: -1 for a symmetric orbit, else +1.
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
    """Return the motion [X_1, X_2, X_1', X_2'] of the boxes at times tau, (n, 4); other arguments as for `_orbit`."""
    response, amplitude = impulse_response(system, sign), forced_amplitude(system)
    # In a symmetric orbit, the impacts of a module form one train of alternating impulses, else a train per wall.
    trains = 1 if sign == -1 else 2
    kicks = (system.epsilon * changes[:, None] * [-1.0, 1.0])[:, :trains]
    forced = amplitude * np.exp(1j * system.Omega * tau[:, None])
    kicked = response(tau[:, None, None] - times[:, :trains], np.arange(2)[:, None])
    return np.hstack([forced.imag, system.Omega * forced.real]) + np.einsum("niks,ik->ns", kicked, kicks)


def _state(system, times, changes, speeds, sign):
    """Return the state (8,) at tau = 0 for ball speeds (2, 2); other arguments as for `_orbit`."""
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
    """Return the largest |X_i - c Y_i| at its extrema inside free flights for both modules, (2,), with c = `balls`.

    c = 1 gives |W_i|, c = 0 gives |X_i|. The result is 0 without extrema.
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
        # extrema of W, by Hermite interpolation between samples
        turns = V[:, :-1] * V[:, 1:] < 0
        w0, w1, v0, v1 = W[:, :-1][turns], W[:, 1:][turns], V[:, :-1][turns], V[:, 1:][turns]
        s = v0 / (v0 - v1)  # zero of V to O(spacing^2); W is more accurate, since V = 0
        values = w0 + (w1 - w0) * s * s * (3 - 2 * s) + s * (1 - s) * (v0 * (1 - s) - v1 * s)
        np.maximum.at(found, turns.nonzero()[2], abs(values))
    return found


def _samples(step, start, count):
    """Return step^k start for k < count, shape (n, count, d)."""
    samples, ahead = start[:, None], step.swapaxes(1, 2)
    while (made := samples.shape[1]) < count:  # rounding errors grow only with log(count)
        samples = np.concatenate([samples, samples[:, : count - made] @ ahead], axis=1)
        ahead = ahead @ ahead
    return samples
