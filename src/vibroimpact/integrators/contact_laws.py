"""Laws of compliant contact: the force K p^n + D p^m p' on a ball at depth p beyond a wall.

In a law without walls, the force acts everywhere in the box, and p = |W|.

The motion of the ball relative to its box has the mass mu = epsilon / (1 + epsilon). The speed V = p' satisfies
V dV/dp = -(K p^n + D p^m V) / mu.

If m = (n - 1) / 2, the substitution u = p^((n + 1) / 2) gives V dV/du = -2 (K u + D V) / ((n + 1) mu). This is a linear
oscillator with the damping ratio zeta = D / sqrt(2 (n + 1) K mu). A contact lasts half a period of this oscillator.
Therefore the restitution coefficient is exp(-pi zeta / sqrt(1 - zeta^2)) at every speed (Antypov and Elliott 2011, for
n = 3/2).

If m = n (Hunt and Crossley 1975), V dV / (1 + D V / K) = -K p^n dp / mu. A contact begins at p = 0 with a speed
V = V_0, and ends at p = 0 with V = -kappa V_0. So the right-hand side integrates to zero. The left-hand side then gives
(1 + kappa) d = log((1 + d) / (1 - kappa d)), where d = D V_0 / K. This equation determines d from kappa alone. So D
must be proportional to 1 / V_0. Therefore D is set anew at each impact (as by Lankarani and Nikravesh, 1990).
"""

import math
from dataclasses import dataclass

from scipy.optimize import brentq

NEARLY_ELASTIC = 1e-5
"""Value of 1 - kappa below which the sides of the equation for d in `hunt_crossley_number` differ by rounding only."""


@dataclass(frozen=True)
class Law:
    """Contact force K p^n + D p^m p'.

    stiffness: exponent n.
    damping: exponent m.
    walls: True if p is the depth beyond a wall, False if p = |W|.
    """

    stiffness: float
    damping: float
    walls: bool = True


SPRING = Law(1.0, 0.0)
HERTZ = Law(1.5, 0.25)
HUNT_CROSSLEY = Law(1.5, 1.5)


def power_law(order: int) -> Law:
    """Return the law without walls that has n = 2 `order` - 1 and m = `order` - 1 (Pilipchuk 2010)."""
    return Law(2.0 * order - 1.0, order - 1.0, walls=False)


def stiffness_of(law: Law, mass: float, duration: float) -> float:
    """Return the stiffness K for which an undamped contact at speed 1 lasts `duration`."""
    share = 1.0 / (law.stiffness + 1.0)
    # `path` is the integral of 1 / sqrt(1 - x^(n + 1)) over [0, 1].
    path = math.sqrt(math.pi) * math.gamma(1.0 + share) / math.gamma(0.5 + share)
    return mass / (2.0 * share) * (2.0 * path / duration) ** (law.stiffness + 1.0)


def stiffness_turning_at_the_wall(law: Law, mass: float, kappa: float) -> float:
    """Return the stiffness K of a law without walls.

    With this stiffness, a ball that has speed 1 at W = 0 turns round at W = 1.
    """
    zeta = damping_ratio(kappa)
    # The ball turns round at u = `deepest` / sqrt(2 K / ((n + 1) mu)). W = 1 corresponds to u = 1. Therefore, K follows
    # from u = 1.
    deepest = math.exp(-zeta * math.acos(zeta) / math.sqrt(1.0 - zeta**2))
    return 0.5 * (law.stiffness + 1.0) * mass * deepest**2


def damping_of(law: Law, mass: float, kappa: float, stiffness: float) -> float:
    """Return the damping D for which a contact at speed 1 has the restitution coefficient kappa."""
    if law.damping == law.stiffness:
        return stiffness * hunt_crossley_number(kappa)
    return damping_ratio(kappa) * math.sqrt(2.0 * (law.stiffness + 1.0) * stiffness * mass)


def damping_ratio(kappa: float) -> float:
    """Return the damping ratio of a linear oscillator whose speed is multiplied by kappa in half a period."""
    decay = -math.log(kappa)
    return decay / math.hypot(math.pi, decay)


def hunt_crossley_number(kappa: float) -> float:
    """Return the solution d in (0, 1 / kappa) of (1 + kappa) d = log((1 + d) / (1 - kappa d)).

    In a contact that begins with the speed V_0, d = D V_0 / K.
    """
    if 1.0 - kappa < NEARLY_ELASTIC:
        return 1.5 * (1.0 - kappa)

    # The unknown is x = -log(1 - kappa d), since d rounds to 1 / kappa for small kappa.
    def number(x):
        return -math.expm1(-x) / kappa

    def excess(x):
        return (1.0 + kappa) * number(x) - math.log1p(number(x)) - x

    return number(brentq(excess, 0.1 * kappa * (1.0 - kappa), 2.0 * (1.0 + kappa) / kappa, xtol=1e-300, rtol=1e-15))
