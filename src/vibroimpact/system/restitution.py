"""Impact law: Newton's restitution rule with conservation of momentum (section 10.2).

The following files contain their own implementation of the law. If the law is changed, change these files too:

- `exact.engine.contact`, `exact.lanes.steps`, `exact.lanes.statistics`: simulations,
- `exact.orbits.symmetric`, `exact.orbits.asymmetric`, `exact.orbits.proof.conditions`: equations of orbits,
- `rigid_contact`, `heyoka_taylor`, `moreau_jean`, `ivanov` and `contact_laws` in `integrators`,
- `accuracy.reference.trajectory`: arbitrary precision,
- `completeness/orbits.py` of the studies: completeness proof,
- `report/live/exact.js`: simulation in the browser.

The saltation matrix depends on the law. It is implemented in `exact.engine.variation`, `exact.orbits.floquet` and
`exact.orbits.proof.passage`. Tests compare the implementations.
"""


def after_impact(epsilon: float, kappa: float, box_velocity: float, ball_velocity: float):
    """Return the velocities (X', Y') just after an impact, from the velocities just before it, (10.2).

    W' = X' - Y' is multiplied by -kappa, and X' + epsilon Y' is conserved. The arguments are floats or arrays.
    """
    impulse = (1.0 + kappa) / (1.0 + epsilon) * (box_velocity - ball_velocity)
    return box_velocity - epsilon * impulse, ball_velocity + impulse


def energy_lost(epsilon: float, kappa: float, relative_velocity: float):
    """Return the kinetic energy that is lost in an impact, in units of M L^2 omega_10^2.

    relative_velocity: W' = X' - Y' just before the impact.
    """
    return 0.5 * epsilon / (1.0 + epsilon) * (1.0 - kappa**2) * relative_velocity**2
