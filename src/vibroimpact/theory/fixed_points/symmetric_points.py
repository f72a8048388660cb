"""Find all fixed points of the slow flow, the real solutions of (10.16) and (10.23).

The amplitudes C_1 and C_2 are common zeros of two polynomials (`Balance.polynomials`). These zeros lose digits, since
the polynomials are differences of squares. Newton's method for amplitudes and phases restores the digits. Without
dissipation, each fixed point has a partner with the same amplitudes and mirrored phases. The denominator Delta of
`Balance.solve` vanishes at both fixed points. With very little dissipation, the amplitudes of both fixed points are
equal within rounding, and only the phases differ.
"""

from dataclasses import dataclass, replace
from string import ascii_lowercase

import numpy as np

from vibroimpact.system import System
from vibroimpact.system.arguments import instance
from vibroimpact.system.representation import Found, Representation, brief
from vibroimpact.theory.criteria import FAST, SLOW, THEORY, Stability, of_fixed_point
from vibroimpact.theory.fixed_points.balance import Balance
from vibroimpact.theory.fixed_points.real_zeros import real_zeros
from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.masri import printed_limit
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, equations, slow_eigenvalues

_STEPS = 30
_SETTLED = 1e-12  # If the relative Newton step is below this value, the fixed point is exact within rounding.
_SAME = 1e-9
_NEAR = 1e-3  # If `_refined` changes C by more than this relative value, it moves to another fixed point.
_TRIANGLE_GAP = 1e-3  # tolerance of the triangle inequality in `_may_close`, relative to the perimeter of the triangle
_REGULAR = 1e5  # A fixed point counts as simple if the condition number of its Jacobian is below this value.
_AMPLITUDES = tuple(f"{name}{i}" for name in ("C", "B", "psi") for i in (1, 2))
COLUMNS = ("label", *_AMPLITUDES, FAST, SLOW, THEORY, "slow_growth", "multiple")
"""Columns of the table of fixed points."""


@dataclass(frozen=True, eq=False, repr=False)
class FixedPoint(Representation):
    """A fixed point of the slow flow, (10.23): a periodic response with two impacts per cycle and module.

    For a single machine (`PhysicalSystem.single`), C, B and psi of the second module are NaN.

    Attributes
    ----------
    system : System
        System of the fixed point.
    C, B : ndarray
        C: amplitude of the saw-tooth in each module. B: amplitude of U_i0 in each module. Both are dimensionless and
        have the shape (2,).
    psi : ndarray
        Phase lag in U_i0 = B_i sin(Omega tau - psi_i) of each module [rad], between -pi and pi, shape (2,).
    slow_eigenvalues : ndarray
        Complex eigenvalues of the slow flow, per unit of tau_1. The shape is (4,), or (2,) for a single machine. At a
        fold of the manifold, one eigenvalue is infinite.
    multiple : bool
        True if several fixed points may coincide within rounding, as at a fold. The relative errors of C and psi are
        then about the square root of the rounding error.
    label : str
        "a", "b", ... as in the figures of the chapter. If the point does not come from `fixed_points`, the label is "".

    Examples
    --------
    >>> point = vi.fixed_points(system)[0]
    >>> point.C.shape
    (2,)
    """

    system: System
    C: np.ndarray
    B: np.ndarray
    psi: np.ndarray
    slow_eigenvalues: np.ndarray
    multiple: bool
    label: str = ""

    @classmethod
    def of(cls, system: System, C: np.ndarray, psi: np.ndarray, multiple: bool) -> "FixedPoint":
        """Return the fixed point with the saw-tooth amplitudes `C` and the phases `psi`."""
        return cls(system, C, B_of_C(C, rho(system.kappa)), psi, slow_eigenvalues(system, psi, C), multiple)

    @property
    def stability(self) -> Stability:
        """Verdicts of the theory: fast (Masri's analysis), slow (the slow flow) and theory (both together)."""
        verdicts = of_fixed_point(self.system, self)
        return Stability(verdicts[FAST], verdicts[SLOW])

    def row(self) -> dict:
        """Return the row of this fixed point in the table that `to_frame` makes, as a dictionary by column name."""
        numbers = np.ravel([self.C, self.B, self.psi]).tolist()
        fast, slow = stability = self.stability
        growth = float(self.slow_eigenvalues.real.max())
        verdicts = fast, slow, stability.theory
        return dict(zip(COLUMNS, (self.label, *numbers, *verdicts, growth, self.multiple), strict=True))

    def _shown(self):
        numbers = {name: brief(getattr(self, name)) for name in ("C", "B", "psi")}
        growth = f"real parts up to {brief(self.slow_eigenvalues.real.max())}"
        return {"label": self.label, "stability": str(self.stability), **numbers, "slow_eigenvalues": growth}


def fixed_points(system: System) -> list[FixedPoint]:
    """Return all fixed points of the slow flow with C_1, C_2 >= 0, (10.23).

    Parameters
    ----------
    system : System
        Dimensionless parameters.

    Returns
    -------
    list of FixedPoint
        Fixed points in ascending order of C of the first active module. The order of the labels differs: "a" is the
        least stable point.

    Raises
    ------
    ValueError
        If system is not a System, or if the slow flow has an undamped resonance that the forces do not excite. The
        fixed points may then form a continuum.

    Examples
    --------
    >>> [point.label for point in vi.fixed_points(system)]  # doctest: +SKIP
    """
    inside = [point for point in search(system) if not (point.C < 0).any()]
    named = (replace(point, label=label) for point, label in zip(inside, labels(system, inside), strict=True))
    return Found(named, COLUMNS)


def search(system: System) -> list[FixedPoint]:
    """Return all fixed points, including points with a negative C_i, without labels.

    The points are sorted by C_1, or by C_2 if only module 2 is active.

    Raises
    ------
    ValueError
        If system is not a System, or if the slow flow has an undamped resonance that the forces do not excite. The
        fixed points may then form a continuum.
    """
    refuse_free_motion(instance("system", system, System))
    balance = Balance.of(system)
    if system.modules == (1, 2):
        zeros, multiple = real_zeros(*balance.polynomials(), search_radius(system))
        solutions = _solutions(system, balance, zeros, multiple)
    else:  # At most one module is active. If none is active, there is no fixed point, since impacts dissipate energy.
        solutions = [solution for module in system.modules for solution in _of_one_module(balance, module - 1)]
    points = [FixedPoint.of(system, *solution) for solution in solutions]
    return sorted(points, key=lambda point: tuple(np.nan_to_num(point.C)))


def search_radius(system) -> float:
    """Return an upper bound on sqrt(C_1^2 + C_2^2) for all fixed points (docs/derivation.md, section 6)."""
    r = rho(system.kappa)
    f = np.abs([system.f10_hat, system.f20_hat])
    grow = np.sqrt(1 + r**2) * np.linalg.norm(f)
    lose = FIRST_HARMONIC * r
    return float((grow + np.sqrt(grow**2 + 4 * lose * f.sum())) / (2 * lose))


def labels(system, points) -> list[str]:
    """Return the label "a", "b", ... of each fixed point; "a" is the least stable point.

    Points that are unstable by (10.26) come first, then the points that are stable by (10.26). Each group is sorted by
    descending growth rate, which is the largest real part of the slow eigenvalues. The chapter gives no rule for its
    labels. Of the plausible orders, this order agrees with most sentences of section 10.4 (docs/errata.md).
    """
    limit = printed_limit(rho(system.kappa))
    keys = [(bool(np.nanmin(point.C) > limit), -point.slow_eigenvalues.real.max()) for point in points]
    order = sorted(range(len(points)), key=keys.__getitem__)
    return [ascii_lowercase[order.index(k)] for k in range(len(points))]


def refuse_free_motion(system) -> None:
    """Raise ValueError for a system whose fixed points may form a continuum (see `search`)."""
    if len(system.modules) == 1:  # The force acts on the active box and therefore excites its resonance.
        return
    balance = Balance.of(system)
    numerators, denominator = balance.solve((0.0, 0.0))
    own, force = np.abs(balance.q[:, 0]).max(), np.abs(balance.forcing).max()
    scale = own + abs(balance.K)
    if abs(denominator) <= 1e-12 * scale * own and np.abs(numerators).max() <= 1e-12 * scale * force:
        raise ValueError(
            f"sigma_e_hat: at {system.sigma_e_hat} the slow flow has an undamped resonance that the forces do not "
            "excite, and the fixed points may form a continuum; add damping or change the frequency"
        )


def _of_one_module(balance, i):
    """Return the list of the fixed points of the uncoupled module i (0 or 1).

    Each entry contains the amplitudes C, the phases psi and the flag `multiple`. C and psi have the shape (2,), with
    NaN for the other module.
    """
    C, psi, multiple = balance.of_module(i)
    alone = np.where(np.arange(2) == i, 1.0, np.nan)
    return [(alone * one, alone * phase, multiple) for one, phase in zip(C, psi, strict=True)]


def _solutions(system, balance, zeros, multiple):
    """Return the list of the fixed points that belong to the common zeros of the polynomials.

    Each entry contains the amplitudes C, the phases psi and the flag `multiple` of a fixed point. The argument
    `multiple` is the mask of the multiple zeros.
    """
    simple = [(C, balance.phases(C)) for C in zeros[~multiple]]
    simple = [_refined(system, *solution) or solution for solution in simple]
    unresolved = []
    for C in zeros[multiple]:
        pair = _mirrored_pair(system, balance, C)
        # Two neighbouring zeros can lead to the same pair of fixed points, which is then added only once.
        simple += [solution for solution in pair if not any(_same(solution, known) for known in simple)]
        unresolved += [(C, balance.phases(C))] if not pair and _may_close(balance, C) else []
    return [(*solution, False) for solution in simple] + [(*solution, True) for solution in unresolved]


def _mirrored_pair(system, balance, C):
    """Return a list of the two fixed points near a multiple zero C of the polynomials, each as a tuple (C, psi).

    If there are not exactly two such fixed points, the list is empty. In the complex plane, the terms of the balance
    p_1 u_1 - K z_2 u_2 = f_1 with p_1 = q_1 + K z_1 form a triangle. The lengths of the sides determine two triangles,
    which are mirror images. Newton's method starts once from the phases of each triangle.
    """
    z, q = balance.at(C)
    p, k, f = q[0] + balance.K * z[0], balance.K * z[1], balance.forcing[0]
    if p == 0 or k == 0 or f == 0:
        return []
    cosine = (abs(p) ** 2 + f**2 - abs(k) ** 2) / (2 * abs(p) * f)
    opening = np.arccos(np.clip(cosine, -1, 1))
    first = np.exp(1j * (np.array([opening, -opening]) - np.angle(p)))
    starts = -np.angle(z * np.stack([first, (p * first - f) / k], axis=1))
    found = [one for psi in starts if (one := _refined(system, C, psi)) is not None]
    return found if len(found) == 2 and not _same(*found) else []


def _may_close(balance, C):
    """Return False if no phases balance the forces near a zero C of `Balance.polynomials`.

    Without dissipation, Delta, n_1 and n_2 of `Balance.solve` can all vanish at a zero C that is no fixed point. At a
    fixed point, the terms of the balance f_i = p_i u_i - K z_j u_j form a triangle, where p_i = q_i + K z_i. Therefore
    the lengths |f_i|, |p_i| and |K z_j| must satisfy the triangle inequality.
    """
    z, q = balance.at(C)
    sides = np.abs([balance.forcing, q + balance.K * z, balance.K * z[::-1]])
    return bool((2 * sides.max(axis=0) <= (1 + _TRIANGLE_GAP) * sides.sum(axis=0)).all())


def _refined(system, C, psi):
    """Return the amplitudes C and phases psi of a fixed point, refined by Newton's method.

    If the method does not converge to a simple fixed point near C, the result is None.
    """
    state = np.column_stack([C, psi])
    for _ in range(_STEPS):
        residual, J = equations(system, state[:, 1], state[:, 0])
        if not np.linalg.cond(J) < _REGULAR:
            return None
        step = np.linalg.solve(J, residual).reshape(2, 2)
        state = state - step
        if not np.abs(state[:, 0] - C).max() < _NEAR * (1 + np.abs(C).max()):
            return None
        if np.abs(step).max() < _SETTLED * (1 + np.abs(state).max()):
            break
    if np.abs(step).max() > _SAME:
        return None
    return state[:, 0], np.angle(np.exp(1j * state[:, 1]))


def _same(one, other) -> bool:
    """Return True if two refined solutions (C, psi) are the same fixed point."""
    far = np.abs(one[0] - other[0]).max() / (1 + np.abs(one[0]).max())
    turned = np.abs(np.exp(1j * one[1]) - np.exp(1j * other[1])).max()
    return bool(max(far, turned) < _SAME)
