"""Apply stability criteria to a motion with two impacts per cycle.

A motion is stable if all active modules are stable. The saw-tooth amplitude C of an inactive module is NaN. Each
criterion gives a verdict, which has the name of the criterion:

- printed_10_26: verdict of the condition (10.26) as printed,
- fast: verdict of Masri's analysis (docs/stability.md),
- slow: verdict of the eigenvalues of the slow flow,
- theory: verdict that combines `fast` and `slow`,
- exact: verdict of the Floquet multipliers of the exact orbit.
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

    fast: verdict of Masri's analysis, in which the amplitude B and the phase phi of U are constant.
    slow: verdict of the slow flow.
    """

    fast: str
    slow: str

    @property
    def theory(self) -> str:
        """Verdict that combines `fast` and `slow`.

        The verdict is "stable" if both are "stable", "unstable" if one of them is "unstable", and else "undecided".
        """
        return all_stable(self)

    def __str__(self) -> str:
        return f"{self.theory} (fast {self.fast}, slow {self.slow})"


def of_fixed_point(system, point) -> dict[str, str]:
    """Apply all CRITERIA to a fixed point of the slow flow; return the verdicts by name of the criterion."""
    return _of(system, point.psi, point.C, fixed_point_error(system, point))


def of_orbit(orbit) -> dict[str, str]:
    """Apply all CRITERIA to an exact orbit; return the verdicts by name of the criterion.

    The criteria assume a symmetric motion. They use psi and C from `slow_variables`, even if the orbit is asymmetric.
    """
    psi, C = slow_variables(orbit)
    error = (orbit.residual + ROUNDING) / np.min(np.abs(orbit.multipliers - 1))
    return _of(orbit.system, psi, C, error)


def slow_variables(orbit) -> tuple[np.ndarray, np.ndarray]:
    """Return the phases psi [rad] and the saw-tooth amplitudes C of an exact orbit, each of shape (2,).

    psi follows from the impact phase of each module by (10.17). If the orbit is asymmetric, the impacts at wall +1 and
    at wall -1 have different phases. The function then uses the mean of both phases.
    """
    around = np.exp(2j * np.pi * orbit.impact_phases)
    phase = impact_phase(orbit.C, rho(orbit.system.kappa))
    return np.angle(around[:, 0] - around[:, 1]) - phase, orbit.C


def fixed_point_error(system, point) -> float:
    """Return an estimate of the largest error of psi and C at a fixed point.

    The estimate is the size of a Newton step plus the effect of rounding errors. It is infinite if `point.multiple` is
    True, that is if several fixed points may coincide.
    """
    if point.multiple:
        return np.inf
    residual, J = equations(system, point.psi, point.C)
    unknowns = np.column_stack([point.C, point.psi]).ravel()
    size = np.abs(unknowns[np.isin(MODULES, system.modules)])
    noise = ROUNDING * (np.abs(J).sum(axis=1) + np.abs(np.diag(J)) * size)
    return float((np.abs(np.linalg.inv(J)) @ (np.abs(residual) + noise)).max())


def _of(system, psi, C, error):
    """Apply all CRITERIA to a motion; return the verdicts by name of the criterion.

    psi: phases of the motion [rad], shape (2,).
    C: saw-tooth amplitudes of the motion, shape (2,).
    error: upper bound on the errors of the entries of psi and C.
    """
    limit, active = printed_limit(rho(system.kappa)), C[~np.isnan(C)]
    printed = all_stable(verdict(c - limit, error + ROUNDING * max(1.0, abs(c))) for c in active)
    fast = all_stable(masri.stable(c, system.kappa, error) for c in active)
    eigenvalues = zip(*_eigenvalues(system, psi, C, error), strict=True)
    both = Stability(fast, slow=all_stable(verdict(-value.real, bound) for value, bound in eigenvalues))
    return {PRINTED: printed, FAST: both.fast, SLOW: both.slow, THEORY: both.theory}


def _eigenvalues(system, psi, C, error):
    """Return the eigenvalues of the slow flow, and first-order estimates of their errors.

    The errors result from rounding and from errors of psi and C up to `error`. At a fold, one eigenvalue and all
    estimates are infinite.
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
