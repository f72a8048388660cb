"""Linear systems for comparison: without balls, with fixed balls, with linear absorbers as heavy as the balls."""

from dataclasses import dataclass, replace

import numpy as np

from vibroimpact.studies.absorbers.linear import Linear
from vibroimpact.system.arguments import pair
from vibroimpact.system.matrices import damping_matrix, masses, stiffness_matrix


@dataclass(frozen=True)
class Tuning:
    """Linear absorbers, one on each box, each with the mass epsilon of a ball.

    Parameters
    ----------
    frequency : tuple of float
        Natural frequency of each absorber on a box at rest, sqrt(stiffness / epsilon), dimensionless, (2,).
    damping : tuple of float
        Damping ratio of each absorber, damping / (2 epsilon frequency), (2,).

    Examples
    --------
    >>> tuning = vi.Tuning(frequency=(1.0, 1.0), damping=(0.1, 0.1))
    """

    frequency: tuple[float, float]
    damping: tuple[float, float]


def without_balls(system, scale=np.ones_like) -> Linear:
    """Return the linear system of the boxes, each of mass 1, without balls; `scale` as in `Linear`."""
    return Linear(np.diag(masses(system)), damping_matrix(system), stiffness_matrix(system), system.forcing, scale)


def fixed_balls(system, scale=np.ones_like) -> Linear:
    """Return the linear system of the boxes, each of mass 1 + epsilon with its fixed ball; `scale` as in `Linear`."""
    return replace(without_balls(system, scale), mass=np.diag(masses(system, (True, True))))


def tuned(system, tuning: Tuning, scale=np.ones_like) -> Linear:
    """Return the linear system of the boxes with linear absorbers in place of the balls.

    The coordinates are (X1, X2, Y1, Y2).

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    tuning : Tuning
        Frequencies and damping ratios of the absorbers.
    scale : callable, optional
        Function that returns the factor of the force at an array of frequencies, see `Linear`; 1 by default.

    Returns
    -------
    Linear
        Linear system with .peak(band), .stroke(band) and .amplitudes(Omega).

    Raises
    ------
    ValueError
        If a frequency is not above 0 or a damping ratio is below 0.

    Examples
    --------
    >>> linear = vi.tuned(system, vi.textbook_tuning(system))
    >>> linear.peak((0.9, 1.1))  # doctest: +SKIP
    """
    frequency, damping = (np.array(pair(name, getattr(tuning, name))) for name in ("frequency", "damping"))
    if not (frequency > 0).all() or not (damping >= 0).all():
        raise ValueError(f"tuning: got {tuning}, expected frequencies above 0 and damping ratios of at least 0")
    spring, damper = system.epsilon * frequency**2, 2 * system.epsilon * frequency * damping
    return Linear(
        np.diag([1.0, 1.0, system.epsilon, system.epsilon]),
        _attached(damping_matrix(system), damper),
        _attached(stiffness_matrix(system), spring),
        np.concatenate([system.forcing, [0.0, 0.0]]),
        scale,
    )


def _attached(matrix, links):
    """Return the stiffness or damping matrix (4, 4) of the boxes with their absorbers.

    matrix: the stiffness or damping matrix of the boxes alone, (2, 2). links: stiffness of the spring, or coefficient
    of the damper, between each box and its absorber, (2,).
    """
    link = np.diag(links)
    return np.block([[matrix + link, -link], [-link, link]])
