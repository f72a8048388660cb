"""Fixed points in amplitudes and phases at once, where the amplitudes alone lose digits or do not decide.

Without dissipation the slow flow is reversible: to a fixed point belongs another with the same C and mirrored phases,
and Delta of the balance vanishes there. Close to this limit two well separated fixed points have amplitudes that
rounding cannot tell apart; their phases tell them apart.
"""

import numpy as np

from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.slow_flow import linearisation, rates

_STEPS = 30
_SETTLED = 1e-12  # a Newton step this small leaves the state exact to rounding
_SAME = 1e-9
_NEAR = 1e-3  # a fixed point this far from where the search left off belongs to another zero
_REGULAR = 1e5  # condition number up to which Newton's method proves a fixed point to be a simple one


def mirrored_pair(system, balance, C) -> list[tuple[np.ndarray, np.ndarray]]:
    """(C, psi) of the two regular fixed points with amplitudes close to C; empty where there is no such pair.

    Args:
        balance: the Balance of the system.
        C: a zero of its polynomials, shape (2,), known to the square root of rounding at best.
    """
    z = balance.at(C)[0]
    found = []
    for u in _closing_triangles(balance, C):
        newton = refine(system, C, -np.angle(z * u))
        if newton is not None:
            found.append(newton)
    return found if len(found) == 2 and not same(*found) else []


def _closing_triangles(balance, C):
    """Both pairs of unit phasors with p_1 u_1 - K z_2 u_2 = f_1, for sides that allow a triangle."""
    z, q = balance.at(C)
    p, k, f = q[0] + balance.K * z[0], balance.K * z[1], balance.forcing[0]
    if p == 0 or k == 0 or f == 0:
        return []
    cosine = (abs(p) ** 2 + f**2 - abs(k) ** 2) / (2 * abs(p) * f)
    opening = np.arccos(np.clip(cosine, -1, 1))
    first = np.exp(1j * (np.array([opening, -opening]) - np.angle(p)))
    second = (p * first - f) / k
    return [np.array(pair) for pair in zip(first, second / np.abs(second), strict=True)]


def refine(system, C, psi) -> tuple[np.ndarray, np.ndarray] | None:
    """(C, psi) after Newton's method in both at once; None unless it ends at a regular fixed point near C."""
    r = rho(system.kappa)
    state = np.array([C[0], psi[0], C[1], psi[1]])
    for _ in range(_STEPS):
        C_now, psi_now = state[0::2], state[1::2]
        J, _ = linearisation(system, psi_now, C_now)
        if not np.linalg.cond(J) < _REGULAR:
            return None
        step = np.linalg.solve(J, np.ravel(rates(system, B_of_C(C_now, r), psi_now, C_now), order="F"))
        state = state - step
        if not np.abs(state[0::2] - C).max() < _NEAR * (1 + np.abs(C).max()):
            return None
        if np.abs(step).max() < _SETTLED * (1 + np.abs(state).max()):
            break
    if np.abs(step).max() > _SAME:
        return None
    return state[0::2], np.angle(np.exp(1j * state[1::2]))


def same(one, other) -> bool:
    """Whether two refined solutions (C, psi) are the same fixed point."""
    far = np.abs(one[0] - other[0]).max() / (1 + np.abs(one[0]).max())
    turned = np.abs(np.exp(1j * one[1]) - np.exp(1j * other[1])).max()
    return bool(max(far, turned) < _SAME)
