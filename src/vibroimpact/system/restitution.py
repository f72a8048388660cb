"""Impact law: Newton's restitution rule with conservation of momentum (section 10.2).

Compiled code, interval arithmetic and JavaScript need implementations of their own: `exact.engine.contact.impact`
(runs), `exact.lanes.steps` (ensembles), `integrators.rigid_contact` and `integrators.contact_laws` (other methods),
`accuracy.reference.trajectory` (intervals) and `report/live/exact.js` (browser). Tests compare all of them.
"""


def after_impact(epsilon: float, kappa: float, box_velocity: float, ball_velocity: float):
    """Return the velocities (X', Y') just after an impact, from the velocities just before it, (10.2).

    The relative velocity W' = X' - Y' is multiplied by -kappa (Newton's rule), and X' + epsilon Y' is conserved. The
    arguments are floats or arrays.
    """
    impulse = (1.0 + kappa) / (1.0 + epsilon) * (box_velocity - ball_velocity)
    return box_velocity - epsilon * impulse, ball_velocity + impulse


def energy_lost(epsilon: float, kappa: float, relative_velocity: float):
    """Return the kinetic energy lost in an impact, from the relative velocity of box and ball just before the impact.

    The energy is in units of M L^2 omega_10^2 and never negative.
    """
    return 0.5 * epsilon / (1.0 + epsilon) * (1.0 - kappa**2) * relative_velocity**2
