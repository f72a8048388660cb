"""All fixed points of the slow flow: the real solutions of (10.16), (10.23)."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.system import System
from vibroimpact.system.arguments import instance
from vibroimpact.system.glance import Glance, brief
from vibroimpact.theory.fixed_points.polynomials import Balance
from vibroimpact.theory.fixed_points.real_zeros import real_zeros
from vibroimpact.theory.fixed_points.refinement import mirrored_pair, refine, same
from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, slow_eigenvalues


@dataclass(frozen=True, eq=False, repr=False)
class FixedPoint(Glance):
    """A periodic response with two impacts per cycle and module, (10.23).

    Attributes:
        C, B: saw-tooth and box amplitudes of the modules, each shape (2,), dimensionless.
        psi: phases [rad] behind the forcing, in (-pi, pi], shape (2,); U_i0 = B_i sin(Omega tau - psi_i).
        slow_eigenvalues: of the slow flow, per unit of tau_1, shape (4,), complex; infinite at a fold of the manifold.
        multiple: rounding leaves open whether several fixed points coincide here (a fold or branch point in the
            parameters); C and psi are then known to about the square root of rounding.
    """

    C: np.ndarray
    B: np.ndarray
    psi: np.ndarray
    slow_eigenvalues: np.ndarray
    multiple: bool

    def _glance(self):
        numbers = {name: brief(getattr(self, name)) for name in ("C", "B", "psi")}
        return {**numbers, "slow_eigenvalues": f"real parts up to {brief(self.slow_eigenvalues.real.max())}"}


@dataclass(frozen=True, eq=False)
class FixedPointSearch:
    """Every real solution: `points` with C_1, C_2 >= 0, `outside` with some C_i < 0 (both ascending in C_1).

    The search covers the square |C_i| <= radius; no solution lies outside it.
    """

    points: list[FixedPoint]
    outside: list[FixedPoint]
    radius: float


def fixed_points(system: System) -> list[FixedPoint]:
    """All fixed points of the slow flow with C_1, C_2 >= 0, (10.23).

    Returns:
        A list of FixedPoint, ascending in C_1; `certify` proves that none is missing.

    Raises:
        ValueError: system is not a System; else as `search`.
    """
    return search(system).points


def search(system: System) -> FixedPointSearch:
    """All fixed points, admissible or not.

    Raises:
        ValueError: system is not a System, or its undamped slow flow without balls is at a resonance that the forces do
            not load: a free motion of any phase may then touch the walls, and fixed points need not be isolated.
    """
    refuse_free_motion(instance("system", system, System))
    balance = Balance.of(system)
    radius = search_radius(system)
    zeros, multiple = np.empty((0, 2)), np.empty(0, bool)
    if not system.has_undriven_module:  # what its ball dissipates would leave it no fixed point
        zeros, multiple = real_zeros(*balance.polynomials(), radius)
    points = [_fixed_point(system, *solution) for solution in _solutions(system, balance, zeros, multiple)]
    points.sort(key=lambda point: tuple(point.C))
    inside = [bool(np.all(point.C >= 0)) for point in points]
    return FixedPointSearch(
        points=[point for point, ok in zip(points, inside, strict=True) if ok],
        outside=[point for point, ok in zip(points, inside, strict=True) if not ok],
        radius=radius,
    )


def search_radius(system) -> float:
    """Bound on sqrt(C_1^2 + C_2^2) at every fixed point, from f and rho alone (docs/derivation.md, section 6).

    What the balls dissipate, mu rho (C_1^2 + C_2^2) with mu = 8/pi^2, cannot exceed what the forces supply,
    |f_1| B_1 + |f_2| B_2, and B_i <= 1 + sqrt(1 + rho^2) |C_i|.
    """
    r = rho(system.kappa)
    f = np.abs([system.f10_hat, system.f20_hat])
    grow = np.sqrt(1 + r**2) * np.linalg.norm(f)
    lose = FIRST_HARMONIC * r
    return float((grow + np.sqrt(grow**2 + 4 * lose * f.sum())) / (2 * lose))


def _solutions(system, balance, zeros, multiple):
    """(C, psi, multiple) of every fixed point."""
    simple = [(C, _phases(balance, C)) for C in zeros[~multiple]]
    simple = [refine(system, *solution) or solution for solution in simple]
    unresolved = []
    for C in zeros[multiple]:
        pair = mirrored_pair(system, balance, C)
        # Two zeros that rounding blurs can lead to the same pair.
        simple += [solution for solution in pair if not any(same(solution, known) for known in simple)]
        unresolved += [] if pair else [(C, _phases(balance, C))]
    return [(*solution, False) for solution in simple] + [(*solution, True) for solution in unresolved]


def _phases(balance, C):
    numerators, denominator = balance.solve(C)
    return -np.angle(balance.at(C)[0] * numerators / denominator)


def _fixed_point(system, C, psi, multiple):
    return FixedPoint(
        C=C,
        B=B_of_C(C, rho(system.kappa)),
        psi=psi,
        slow_eigenvalues=slow_eigenvalues(system, psi, C),
        multiple=multiple,
    )


def refuse_free_motion(system) -> None:
    """Refuse a system whose fixed points need not be isolated.

    Raises:
        ValueError: as `search`.
    """
    balance = Balance.of(system)
    numerators, denominator = balance.solve((0.0, 0.0))
    own, force = np.abs(balance.q[:, 0]).max(), np.abs(balance.forcing).max()
    scale = own + abs(balance.K)
    if abs(denominator) <= 1e-12 * scale * own and np.abs(numerators).max() <= 1e-12 * scale * force:
        raise ValueError(
            f"sigma_e_hat: {system.sigma_e_hat} drives the undamped slow flow at a resonance that the forces do not "
            "load, so that fixed points need not be isolated; add damping or change the frequency"
        )
