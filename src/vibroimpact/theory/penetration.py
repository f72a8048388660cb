"""For which C the leading-order ball stays between the walls, |W_0| <= 1 with (10.10). Derived in docs/stability.md.

At the time t after the impact with W = +1 and up to the next one, W_0 = cos t + C h(t) with
h(t) = 1 - 2 t / pi - cos t + rho sin t: linear in C, so the admissible C form one interval. It begins at 0 and ends
where the ball, on its way to the other wall, first grazes the wall that it has left.
"""

import numpy as np
from scipy.optimize import brentq


def grazing_time(kappa: float) -> float:
    """Time t [rad] after an impact at which the ball grazes the same wall again when C = largest_C(kappa).

    The root of p cot p = 1 / (1 + kappa), p = t / 2: the only one, as p cot p falls from 1 to 0 on (0, pi/2).

    Raises:
        ValueError: kappa is not between 0 and 1.
    """
    if not 0 < kappa < 1:
        raise ValueError(f"kappa: {kappa} is not between 0 and 1 (both excluded)")
    # tan(p) / p = 1 + kappa and tan(p) >= p + p^3 / 3: p is at most sqrt(3 kappa), its unit here, and at most 1.17.
    unit = np.sqrt(3 * kappa)
    return 2 * unit * brentq(lambda x: _tangent_excess(unit * x) - kappa, 0.6, min(1.1, 1.2 / unit), xtol=1e-15)


def _tangent_excess(p):
    """tan(p) / p - 1, by its series where the difference would lose digits."""
    return p**2 / 3 + 2 * p**4 / 15 + 17 * p**6 / 315 if p < 0.01 else np.tan(p) / p - 1


def largest_C(kappa: float) -> float:
    """Largest C at which |W_0| <= 1 all the time: 1 / C = 1 - (2 p / pi) (1 + kappa cot^2 p), p = grazing_time / 2.

    Grows with kappa from 1 at kappa = 0.

    Raises:
        ValueError: kappa is not between 0 and 1.
    """
    p = grazing_time(kappa) / 2
    return float(1 / (1 - 2 * p / np.pi * (1 + kappa / np.tan(p) ** 2)))


def stays_within_walls(C: float, kappa: float) -> bool:
    """Whether |W_0| <= 1 all the time: exactly for 0 <= C <= largest_C(kappa).

    Raises:
        ValueError: kappa is not between 0 and 1.
    """
    return 0 <= C <= largest_C(kappa)


def impact_velocities(C, kappa):
    """W' just before and just after the impact with W = +1: 4 C / (pi (1 + kappa)) and -kappa times it, by (10.17).

    Outward before and inward after exactly for C > 0; for C < 0 the ball would come from beyond the wall.
    """
    before = 4 * C / (np.pi * (1 + kappa))
    return before, -kappa * before
