"""Families of motions for continuation: equations, members, and test functions that vanish at special points.

Except for grazing, the test functions of an orbit are symmetric polynomials in the multipliers mu of the orbit.
Symmetric polynomials in mu are real. The polynomials that are used here change sign at their zeros. The product of all
(1 + mu) vanishes at a period doubling. The product of all (1 - mu_i mu_j) with i < j vanishes where two multipliers
have the product 1. If these two multipliers are complex, they are on the unit circle (Neimark-Sacker).

For a symmetric orbit, mu are the multipliers of a map that consists of two steps. The map follows the motion for half a
period, and then replaces the state by -state. The symmetry breaks where such a mu is -1. A symmetric orbit cannot
double its period before its symmetry breaks (Swift and Wiesenfeld 1984). The continuation itself finds folds and branch
points (mu = 1).

The unknowns of an inactive module i have no meaning and keep fixed values. The phase and the impact times keep the
value 0. The amplitude C_i and the velocity change I_i of the ball at an impact keep the value 1. Therefore C_i = 0 or
I_i = 0 always means that ball i has the speed 0.
"""

from itertools import combinations

import numpy as np

from vibroimpact.exact.orbits import asymmetric, symmetric
from vibroimpact.exact.orbits.asymmetric import AsymmetricConditions, asymmetric_solutions
from vibroimpact.exact.orbits.search import asymmetric_orbit, half_period_multipliers, symmetric_orbit
from vibroimpact.exact.orbits.symmetric import SymmetricConditions, symmetric_solutions, wrapped
from vibroimpact.studies.regimes.continuation import Lost
from vibroimpact.system.amplitude import path_of, sawtooth_amplitude
from vibroimpact.theory import slow_flow
from vibroimpact.theory.fixed_points.symmetric_points import FixedPoint, fixed_points
from vibroimpact.theory.manifold import C_min, rho, slope
from vibroimpact.theory.masri import SYMMETRY_BREAKING_C
from vibroimpact.theory.slow_flow import linearisation

FOLD, BRANCH_POINT, LOST = "fold", "branch point", "lost"
SYMMETRY_BREAKING, PERIOD_DOUBLING = "symmetry breaking", "period doubling"
NEIMARK_SACKER, HOPF = "Neimark-Sacker", "Hopf"
GRAZING, SPEED_ZERO, MANIFOLD_FOLD = "grazing", "speed zero", "fold of the SIM"
_PAIR = 1e-6
_EQUAL = 1e-6  # a flight fraction (flight time divided by the period) within this distance of 1/2 counts as 1/2
_HELD = 1e-12


class SymmetricOrbits:
    """Symmetric exact orbits: x = (tau_1, tau_2, C_1, C_2), where ball i meets wall +1 at tau_i."""

    name, angles = "symmetric orbit", slice(0, 2)
    modules, rest = symmetric.MODULES, np.array([0.0, 0.0, 1.0, 1.0])
    _conditions, _orbit = SymmetricConditions, staticmethod(symmetric_orbit)

    @staticmethod
    def turn(system) -> float:
        """Return the forcing period; impact times that differ by one forcing period describe the same motion."""
        return system.period

    @classmethod
    def roots(cls, system) -> np.ndarray:
        """Return the roots of all symmetric orbits, shape (n, 4)."""
        return np.where(_inactive(cls, system), cls.rest, symmetric_solutions(system))

    @classmethod
    def equations(cls, system, x):
        """Return the residual and the Jacobian of the conditions for an exact orbit with the unknowns x.

        With x of shape (d,), the residual has the shape (d,), and the Jacobian has the shape (d, d).

        Raises
        ------
        Lost
            If x has impacts in only one of two active modules.
        """
        _require_both_modules(cls, system, x)
        residual, jacobian = cls._conditions(system)(x[None])
        return np.where(_inactive(cls, system), x - cls.rest, residual[0]), jacobian[0]

    @classmethod
    def speed(cls, x) -> float:
        """Return min(C_1, C_2) for symmetric orbits, and min(I_1, I_2) for asymmetric orbits.

        If a ball has the speed 0, the result is 0. I_i is the velocity change of ball i at an impact.
        """
        return x[cls.angles.stop :].min()

    @staticmethod
    def amplitudes(system, x) -> np.ndarray:
        """Return the amplitudes C_i, shape (2,)."""
        return _of_modules(system, x[2:])

    @classmethod
    def member(cls, system, x):
        """Return the Orbit of a root, with impact times moved into the first period."""
        times = cls.angles.stop
        return cls._orbit(system, np.concatenate([wrapped(x[:times], system.period), x[times:]]))

    @staticmethod
    def tests(system, orbit) -> dict[str, float]:
        """Return the values of the test functions of `orbit`, as a dict from kind of special point to value.

        At a special point, the test function of its kind is 0.
        """
        return _tests(half_period_multipliers(orbit), SYMMETRY_BREAKING) | {GRAZING: 1 - orbit.excursion}

    @staticmethod
    def stable(system, orbit) -> bool:
        """Return True if all multipliers of `orbit` are inside the unit circle."""
        return bool(abs(orbit.multipliers[0]) < 1)

    @staticmethod
    def admissible(orbit) -> bool:
        """Return True if all ball speeds are positive and no ball passes a wall."""
        return orbit.admissible

    @staticmethod
    def genuine(kind, orbit) -> bool:
        """Return True if `orbit` is a special point of the given kind.

        The test function of this kind is assumed to be 0 at `orbit`. This condition alone is not sufficient.
        """
        # The test function of NEIMARK_SACKER is also 0 if two real multipliers have the product 1.
        mu = orbit.multipliers
        return kind != NEIMARK_SACKER or bool((abs(abs(mu[mu.imag > _PAIR]) - 1) < _PAIR).any())


class AsymmetricOrbits(SymmetricOrbits):
    """Asymmetric exact orbits: x = (p_1, q_1, p_2, q_2, I_1, I_2).

    Ball i meets wall +1 at p_i and wall -1 at q_i. Its velocity changes by I_i at p_i and by -I_i at q_i.
    """

    name, angles = "asymmetric orbit", slice(0, 4)
    modules, rest = asymmetric.MODULES, np.array([0.0, 0.0, 0.0, 0.0, 1.0, 1.0])
    _conditions, _orbit = AsymmetricConditions, staticmethod(asymmetric_orbit)

    @classmethod
    def roots(cls, system) -> np.ndarray:
        """Return the roots of asymmetric orbits, shape (n, 6). The search may miss some orbits."""
        return np.where(_inactive(cls, system), cls.rest, asymmetric_solutions(system)[0])

    @classmethod
    def mirror_image(cls, system, x) -> np.ndarray:
        """Return the root of the mirror image of the motion x."""
        image = np.concatenate([x[[1, 0, 3, 2]] + system.period / 2, x[4:]])
        return np.where(_inactive(cls, system), x, image)

    @staticmethod
    def is_symmetric(system, x) -> bool:
        """Return True if all flights of the motion x take the same time."""
        return bool((abs(flight_fractions(system, x) - 0.5) < _EQUAL).all())

    @staticmethod
    def amplitudes(system, x) -> np.ndarray:
        """Return the amplitudes C_i, shape (2,)."""
        u = flight_fractions(system, x)
        return _of_modules(system, sawtooth_amplitude(system.epsilon, x[4:] * u * (1 - u) * system.period))

    @staticmethod
    def tests(system, orbit) -> dict[str, float]:
        """Return the values of the test functions of `orbit`, as a dict from kind of special point to value.

        At a special point, the test function of its kind is 0.
        """
        return _tests(orbit.multipliers, PERIOD_DOUBLING) | {GRAZING: 1 - orbit.excursion}


class FixedPoints:
    """Fixed points of the slow flow: x = (C_1, psi_1, C_2, psi_2)."""

    name, angles = "fixed point", slice(1, 4, 2)
    modules, rest = slow_flow.MODULES, np.array([1.0, 0.0, 1.0, 0.0])

    @staticmethod
    def turn(system) -> float:
        """Return 2 pi; phases that differ by 2 pi [rad] describe the same motion."""
        return 2 * np.pi

    @classmethod
    def roots(cls, system) -> np.ndarray:
        """Return all fixed points with C_1, C_2 >= 0, shape (n, 4)."""
        found = [np.stack([p.C, p.psi], axis=1).ravel() for p in fixed_points(system)]
        return np.where(_inactive(cls, system), cls.rest, np.reshape(found, (-1, 4)))

    @classmethod
    def equations(cls, system, x):
        """Return the residual of (10.23) at x, shape (4,), and its Jacobian, shape (4, 4).

        The residual contains the rates D_1 B_i and D_1 psi_i of the slow flow, which are 0 at a fixed point.

        Raises
        ------
        Lost
            If x has impacts in only one of two active modules.
        """
        _require_both_modules(cls, system, x)
        residual, jacobian, part = x - cls.rest, np.eye(4), ~_inactive(cls, system)
        residual[part], jacobian[np.ix_(part, part)] = slow_flow.equations(system, x[1::2], x[0::2])
        return residual, jacobian

    @staticmethod
    def speed(x) -> float:
        """Return min(C_1, C_2), which is 0 if a ball has the speed 0."""
        return x[0::2].min()

    @staticmethod
    def amplitudes(system, x) -> np.ndarray:
        """Return the amplitudes C_i, shape (2,)."""
        return _of_modules(system, x[0::2])

    @staticmethod
    def member(system, x):
        """Return the FixedPoint of a root."""
        C, psi = _of_modules(system, x[0::2]), _of_modules(system, x[1::2])
        return FixedPoint.of(system, C, psi, multiple=False)

    @staticmethod
    def tests(system, point) -> dict[str, float]:
        """Return the values of the test functions of `point`, as a dict from kind of special point to value.

        At a special point, the test function of its kind is 0.
        """
        r = rho(system.kappa)
        # At a fold of the manifold, det M is 0, and an eigenvalue of the slow flow is infinite. Therefore the test
        # function of HOPF has a power of det M as a factor, which removes the pole.
        M = linearisation(system, point.psi, point.C)[1]
        finite = np.isfinite(point.slow_eigenvalues).all()
        sums = [a + b for a, b in combinations(point.slow_eigenvalues, 2)] if finite else [0.0]
        return {
            HOPF: float(np.prod(sums).real * np.linalg.det(M) ** (len(M) - 1)),
            **{f"{MANIFOLD_FOLD}, module {k}": slope(point.C[k - 1], r) for k in system.modules},
            **{f"{SYMMETRY_BREAKING}, module {k}": SYMMETRY_BREAKING_C - point.C[k - 1] for k in system.modules},
        }

    @staticmethod
    def stable(system, point) -> bool:
        """Return True if the point is stable both in the slow flow and in the impact map."""
        beyond = (C_min(rho(system.kappa)) >= point.C) | (point.C >= SYMMETRY_BREAKING_C)
        return bool(not beyond.any() and (point.slow_eigenvalues.real < 0).all())

    @staticmethod
    def admissible(point) -> bool:
        """Return True, since fixed points are shown whether or not their balls stay between the walls."""
        return True

    @staticmethod
    def genuine(kind, point) -> bool:
        """Return True if `point` is a special point of the given kind.

        The test function of this kind is assumed to be 0 at `point`. This condition alone is not sufficient.
        """
        # The test function of HOPF is also 0 if two real eigenvalues have the sum 0.
        values = point.slow_eigenvalues
        return kind != HOPF or bool((abs(values[values.imag > _PAIR].real) < _PAIR).any())


FAMILIES = {
    "theory": (FixedPoints,),
    "exact": (SymmetricOrbits, AsymmetricOrbits),
    "both": (SymmetricOrbits, AsymmetricOrbits, FixedPoints),
}


def flight_fractions(system, x) -> np.ndarray:
    """Return, for each module, the flight time from wall +1 to wall -1 divided by the period, shape (2,).

    x: root of `AsymmetricConditions`, shape (6,). For an inactive module, the result is 1/2.
    """
    u = wrapped(x[1:4:2] - x[0:4:2], system.period) / system.period
    return np.where(np.isin([1, 2], system.modules), u, 0.5)


def _inactive(family, system):
    """Return a mask of the unknowns that belong to an inactive module, shape (d,)."""
    return ~np.isin(family.modules, system.modules)


def _of_modules(system, values):
    """Return the values of both modules, shape (2,), with NaN for an inactive module."""
    return np.where(np.isin([1, 2], system.modules), values, np.nan)


def _require_both_modules(family, system, x):
    """Raise Lost if both modules are active, but only one module has impacts in the response x.

    In such a response, the unknowns of the module without impacts are equal to those in `family.rest`.
    """
    held = np.abs(x - family.rest) < _HELD
    if system.modules == (1, 2) and any(held[family.modules == module].all() for module in (1, 2)):
        raise Lost("only one of the two modules has impacts in this response")


def asymmetric_root(system, x) -> np.ndarray:
    """Convert a root of symmetric orbits to the root of `AsymmetricConditions` for the same orbit, shape (6,).

    x: root of symmetric orbits, (tau_1, tau_2, C_1, C_2).
    """
    times = np.stack([x[:2], x[:2] + system.period / 2], axis=1).ravel()
    root = np.append(times, 4 * path_of(system.epsilon, x[2:]) / system.period)
    return np.where(_inactive(AsymmetricOrbits, system), AsymmetricOrbits.rest, root)


def _tests(mu, at_minus_one):
    """Return the values of the test functions of the multipliers `mu`, as a dict from kind of special point to value.

    at_minus_one: kind of the special point at which a multiplier is -1.
    """
    found = {at_minus_one: 1 + mu, NEIMARK_SACKER: np.array([1 - a * b for a, b in combinations(mu, 2)])}
    return {name: float(np.prod(factors).real) for name, factors in found.items()}
