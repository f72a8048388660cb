"""Apply stability criteria to a motion with two impacts per cycle: (10.26), Masri's analysis, the slow flow.

Each criterion gives "stable" or "unstable", or "undecided" if the error bounds are too large for a decision. A motion
is stable if both modules are stable. An inactive module (see `System.modules`), whose saw-tooth amplitude C is NaN, is
ignored. The verdicts are named printed_10_26 (the condition as printed), fast (Masri's analysis as derived in
docs/stability.md), slow (the slow flow), theory (fast and slow together) and exact (the Floquet multipliers of the
exact orbit).
"""

from typing import NamedTuple

import numpy as np
from scipy.linalg import eig

from vibroimpact.system.verdict import all_stable, verdict
from vibroimpact.theory import masri
from vibroimpact.theory.manifold import impact_phase, rho
from vibroimpact.theory.masri import ROUNDING, printed_limit
from vibroimpact.theory.slow_flow import MODULES, equations, linearisation

FAST, SLOW, THEORY, EXACT = "fast", "slow", "theory", "exact"
PRINTED = "printed_10_26"
CRITERIA = (PRINTED, FAST, SLOW, THEORY)
"""Names of the verdicts of the theory, in the order of table columns."""
_STEP = 1e-6


class Stability(NamedTuple):
    """Verdicts of the theory on a motion, each "stable", "unstable" or "undecided".

    fast: verdict of Masri's analysis, for impacts at constant amplitude B and phase phi of U. slow: verdict of the slow
    flow.
    """

    fast: str
    slow: str

    @property
    def theory(self) -> str:
        """Verdict of the theory, from the verdicts `fast` and `slow`.

        "stable" if both verdicts are "stable", "unstable" if one of them is "unstable", else "undecided".
        """
        return all_stable(self)

    def __str__(self) -> str:
        return f"{self.theory} (fast {self.fast}, slow {self.slow})"


def of_fixed_point(system, point) -> dict[str, str]:
    """Return, by name, the verdict of each criterion in CRITERIA on a fixed point of the slow flow."""
    return _of(system, point.psi, point.C, fixed_point_error(system, point))


def of_orbit(orbit) -> dict[str, str]:
    """Return, by name, the verdict of each criterion in CRITERIA on an exact orbit.

    The attributes `system`, `impact_phases`, `C`, `multipliers` and `residual` of the orbit are used.

    The criteria assume a symmetric motion. An asymmetric orbit is described by psi and C from `slow_variables`.
    """
    psi, C = slow_variables(orbit)
    error = (orbit.residual + ROUNDING) / np.min(np.abs(orbit.multipliers - 1))
    return _of(orbit.system, psi, C, error)


def slow_variables(orbit) -> tuple[np.ndarray, np.ndarray]:
    """Return (psi, C) of an exact orbit, each (2,).

    C_i is the saw-tooth amplitude; psi_i follows from the impact phase by (10.17). The impact phase is the mean of two
    phases: the phase at wall +1, and the phase half a period after the impact at wall -1. These two phases differ only
    if the orbit is asymmetric.
    """
    around = np.exp(2j * np.pi * orbit.impact_phases)
    phase = impact_phase(orbit.C, rho(orbit.system.kappa))
    return np.angle(around[:, 0] - around[:, 1]) - phase, orbit.C


def fixed_point_error(system, point) -> float:
    """Return an estimate of the largest error of psi and C at a computed fixed point.

    The estimate is the size of a Newton step plus the effect of rounding, or infinite if several fixed points may
    coincide.
    """
    if point.multiple:
        return np.inf
    residual, J = equations(system, point.psi, point.C)
    unknowns = np.column_stack([point.C, point.psi]).ravel()
    size = np.abs(unknowns[np.isin(MODULES, system.modules)])
    noise = ROUNDING * (np.abs(J).sum(axis=1) + np.abs(np.diag(J)) * size)
    return float((np.abs(np.linalg.inv(J)) @ (np.abs(residual) + noise)).max())


def _of(system, psi, C, error):
    """Return the verdicts in CRITERIA on a motion with psi and C, each (2,); `error` bounds the errors of psi and C.

    At the fold of the manifold, where an eigenvalue of the slow flow is infinite, the slow verdict is "undecided".
    """
    limit, active = printed_limit(rho(system.kappa)), C[~np.isnan(C)]
    printed = all_stable(verdict(c - limit, error + ROUNDING * max(1.0, abs(c))) for c in active)
    fast = all_stable(masri.stable(c, system.kappa, error) for c in active)
    eigenvalues = zip(*_eigenvalues(system, psi, C, error), strict=True)
    both = Stability(fast, slow=all_stable(verdict(-value.real, bound) for value, bound in eigenvalues))
    return {PRINTED: printed, FAST: both.fast, SLOW: both.slow, THEORY: both.theory}


def _eigenvalues(system, psi, C, error):
    """Return the eigenvalues of the slow flow and their estimated errors, each (4,), or (2,) for a single machine.

    The errors due to rounding and to `error` are estimated to first order, with the left and right eigenvectors.
    """
    J, M = linearisation(system, psi, C)
    values, left, right = eig(J, M, left=True, right=True)
    if not np.isfinite(values).all() or not np.isfinite(error):
        return values, np.full(len(values), np.inf)
    shifts = _STEP * np.eye(4).reshape(4, 2, 2)
    ahead, behind = (linearisation(system, psi + s[..., 1], C + s[..., 0]) for s in (shifts, -shifts))
    moved = [np.linalg.norm(a - b, axis=(-2, -1)).sum() for a, b in zip(ahead, behind, strict=True)]
    dJ, dM = (
        ROUNDING * np.linalg.norm(of) + error / (2 * _STEP) * change for of, change in zip((J, M), moved, strict=True)
    )
    lengths = np.linalg.norm(left, axis=0) * np.linalg.norm(right, axis=0)
    return values, lengths * (dJ + np.abs(values) * dM) / np.abs(np.einsum("ij,ij->j", left.conj(), M @ right))
