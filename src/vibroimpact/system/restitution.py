"""Impact law: Newton's restitution rule with conservation of momentum (section 10.2).

The engine, the ensembles, other integrators, interval arithmetic and the browser implement the law themselves. Tests
compare them.
"""


def after_impact(epsilon: float, kappa: float, box_velocity: float, ball_velocity: float):
    """Return the velocities (X', Y') just after an impact, from the velocities just before it, (10.2)."""
    impulse = (1.0 + kappa) / (1.0 + epsilon) * (box_velocity - ball_velocity)
    return box_velocity - epsilon * impulse, ball_velocity + impulse


def energy_lost(epsilon: float, kappa: float, relative_velocity: float):
    """Return the kinetic energy lost in an impact, from W' just before the impact, in units of M L^2 omega_10^2."""
    return 0.5 * epsilon / (1.0 + epsilon) * (1.0 - kappa**2) * relative_velocity**2
