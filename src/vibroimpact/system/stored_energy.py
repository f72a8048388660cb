"""Compute the stored (kinetic and elastic) energy of the system (10.2), in units of M L^2 omega_10^2."""


def stored(stiffness2, alpha12, epsilon, boxes, balls):
    """Return the sum of the kinetic energy and the energy of the springs.

    `boxes` contains X1, X2, X1', X2', and `balls` contains Y1, Y2, Y1', Y2'.
    """
    x1, x2, v1, v2 = boxes
    kinetic = v1 * v1 + v2 * v2 + epsilon * (balls[2] * balls[2] + balls[3] * balls[3])
    return 0.5 * (kinetic + x1 * x1 + stiffness2 * x2 * x2 + alpha12 * (x1 - x2) * (x1 - x2))
