"""Prove existence, motion between the walls and stability of a computed orbit in interval arithmetic.

Krawczyk's test (Krawczyk 1969; Neumaier 1990) proves that exactly one root of the six equations of asymmetric.py lies
in six intervals around the computed numbers. If the mirror image of the root also lies in these intervals, it is the
root itself. The root is then symmetric. If a flight certainly does not last half a period, the root is asymmetric.
The enclosure of the root gives enclosures of the states at impacts, the monodromy matrix and its eigenvalues (flint's
acb_mat.eig: Rump 2010; van der Hoeven and Mourrain 2017). Float64 numbers of the Orbit are called listed numbers.
"""

import math
from dataclasses import dataclass

import numpy as np
from flint import acb, acb_mat, arb, arb_mat, ctx

from vibroimpact.exact.orbits.proof.conditions import EnclosedConditions, identity
from vibroimpact.exact.orbits.proof.passage import NOT_PROVED, EnclosedPassage, between_walls
from vibroimpact.system.verdict import STABLE, UNSTABLE

_BITS = 128
_WIDEST, _NARROWEST = -4, -60  # half-widths 2^k are tried for the exponents k = -4, -5, ..., -59
_TIGHT = 2.0**-90
_SPOILT_STATE, _SPOILT_MULTIPLIER = 1e-9, 1e-4
"""Tolerances for differences between listed (float64) and proved states, and between listed and proved multipliers.

The tolerances are relative for values above 1. A larger difference means that the listed values belong to another
orbit. The tolerance for multipliers is larger, since rounding changes a double multiplier by the square root of the
rounding error."""
_STEPS = 20  # largest number of steps to narrow the enclosure of a root; the convergence soon becomes quadratic


@dataclass(frozen=True)
class OrbitProof:
    """Proof of an orbit; the float64 matrices and forcing of the system are taken as exact.

    Attributes
    ----------
    radius : float
        Half-width of intervals around the impact times and changes of ball velocity of the Orbit, or 0 if nothing is
        proved. Exactly one orbit lies in these intervals. This orbit is proved to be symmetric if `Orbit.symmetric` is
        True, and to be asymmetric otherwise.
    error : float
        Bound on the errors of the impact phases and of the ball speeds of the Orbit, or inf if nothing is proved.
    motion : str
        "legal" or "not legal" if this is proved, else "not proved". In a legal motion, every ball hits its walls from
        inside, and |W_i| < 1 between impacts.
    multipliers : tuple of acb
        Enclosures of the 8 multipliers (4 for a single machine), by descending modulus. The tuple is empty if no
        enclosures were found.
    moduli_error : float
        Bound on the errors of the moduli of `Orbit.multipliers`, or inf if there are no enclosures.
    """

    radius: float
    error: float
    motion: str
    multipliers: tuple[acb, ...]
    moduli_error: float

    @property
    def stability(self) -> str:
        """Verdict: "stable" or "unstable" if the enclosures of the multipliers prove it, else "not proved"."""
        moduli = [abs(value) for value in self.multipliers]
        if any(modulus > 1 for modulus in moduli):
            return UNSTABLE
        return STABLE if moduli and all(modulus < 1 for modulus in moduli) else NOT_PROVED

    def row(self) -> dict:
        """Return the entries that the proof adds to a table of orbits, as {column name: number or verdict}."""
        numbers = {"box_radius": self.radius, "orbit_error": self.error, "moduli_error": self.moduli_error}
        return numbers | {"motion_proved": self.motion, "floquet_proved": self.stability}


_NOTHING = OrbitProof(0.0, math.inf, NOT_PROVED, (), math.inf)


def prove(orbit) -> OrbitProof:
    """Prove as much as possible about an Orbit.

    Raise ValueError if the boxes have an undamped resonance.
    """
    with ctx.workprec(_BITS):
        conditions = EnclosedConditions(orbit.system)
        times, changes = orbit.impact_phases.ravel() * orbit.system.period, orbit.ball_speeds.sum(axis=1)
        listed = np.nan_to_num(np.concatenate([times, changes]))
        root, radius = krawczyk(conditions, listed)
        if root is None or not _of_kind(orbit.symmetric, conditions, root, listed, radius):
            return _NOTHING
        passage = EnclosedPassage(orbit.system, conditions, root)
        numbers = np.concatenate([of.ravel()[conditions.impacts] for of in (orbit.impact_phases, orbit.ball_speeds)])
        multipliers = _multipliers(passage.monodromy())
        listed, near = orbit.state.tolist(), [_SPOILT_STATE] * 8
        at_start = any(all(map(_near, listed, proved.entries()[:8], near)) for proved in passage.states())
        if not at_start or not _has_multipliers(orbit, multipliers):
            return _NOTHING
        return OrbitProof(
            radius=radius,
            error=_distance([*passage.phases.values(), *passage.speeds.values()], numbers),
            motion=between_walls(passage),
            multipliers=multipliers,
            moduli_error=_distance(map(abs, multipliers), np.abs(orbit.multipliers)) if multipliers else math.inf,
        )


def _multipliers(monodromy) -> tuple[acb, ...]:
    """Return enclosures of the eigenvalues of an interval matrix, by descending modulus.

    If flint cannot enclose the eigenvalues, return an empty tuple.
    """
    try:
        values = acb_mat(monodromy).eig(multiple=True)
    except ValueError:
        return ()
    return tuple(sorted(values, key=lambda value: -float(abs(value).mid())))


def _of_kind(symmetric, conditions, root, listed, radius):
    """Return True if a root is proved to be of the given kind.

    The kind is "symmetric" if `symmetric` is True, and "asymmetric" otherwise.
    root: intervals that contain the root.
    listed, radius: centres and half-width of intervals that contain no other root.
    """
    if not symmetric:
        lags = conditions.lags(root)
        return any(not (2 * conditions.fraction(i, lags)).contains(1) for i in conditions.modules)
    gaps = [abs(root[m] - listed[m ^ 1]) - conditions.period / 2 for m in conditions.impacts]
    return all(abs(gap) < radius for gap in gaps)


def _has_multipliers(orbit, proved):
    """Return True if the multipliers of an Orbit agree with their enclosures.

    They agree if each multiplier is close to an enclosure and each enclosure is close to a multiplier. They also count
    as agreeing if there are no enclosures. proved: the enclosures.
    """
    near = np.array(
        [[_near(one, other, _SPOILT_MULTIPLIER) for other in proved] for one in map(acb, orbit.multipliers.tolist())]
    )
    return not proved or bool(near.any(axis=0).all() and near.any(axis=1).all())


def _near(listed, proved, spoilt):
    return bool(abs(proved - listed) < spoilt * max(1.0, float(abs(acb(listed)).mid())))


def _distance(enclosures, listed):
    """Return an upper bound on the errors of the numbers `listed`, whose exact values lie in `enclosures`."""
    gaps = [abs(value - number).upper() for value, number in zip(enclosures, listed, strict=True)]
    return max(math.nextafter(float(gap), math.inf) for gap in gaps)


def krawczyk(equations, approximate: np.ndarray):
    """Return intervals that enclose a root near `approximate`, and a radius.

    No other root lies in the intervals with centres `approximate` and this radius as half-width. On failure, the result
    is (None, 0.0).

    equations: function of a list of n intervals. It returns the residual, shape (n, 1), and the Jacobian, shape (n, n),
    or None if they are not defined.
    approximate: approximate root, shape (n,).
    """
    centre = [arb(value) for value in approximate.tolist()]
    for exponent in range(_WIDEST, _NARROWEST, -1):
        radius = 2.0**exponent
        box = [arb(value.mid(), radius) for value in centre]
        image = _image(equations, box)
        if image is not None and all(wide.contains_interior(narrow) for wide, narrow in zip(box, image, strict=True)):
            return _narrowed(equations, image), radius
    return None, 0.0


def _image(equations, box):
    """Return the image of intervals under Krawczyk's operator, or None if the image cannot be computed.

    box: the list of intervals. Every root in these intervals also lies in their image.
    """
    found, at = equations(box), equations([value.mid() for value in box])
    if found is None or at is None:
        return None
    try:
        inverse = at[1].mid().inv().mid()
    except ZeroDivisionError:
        return None
    contraction = identity(len(box)) - inverse * found[1]
    offsets = arb_mat([[value - value.mid()] for value in box])
    moved = contraction * offsets - inverse * at[0]
    return [value.mid() + moved[k, 0] for k, value in enumerate(box)]


def _narrowed(equations, box):
    for _ in range(_STEPS):
        if all(value.rad() < _TIGHT for value in box):
            break
        box = [old.intersection(new) for old, new in zip(box, _image(equations, box), strict=True)]
    return box
