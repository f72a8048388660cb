"""The slow flow in (B_1, psi_1, B_2, psi_2); C follows from B on an arm of the manifold, not at the fold."""

import numpy as np

from vibroimpact.theory.slow_flow import linearisation


def jacobian(system, psi, C):
    """Return the derivative (4, 4) of the rates with respect to (B_1, psi_1, B_2, psi_2)."""
    J, M = linearisation(system, psi, C)
    return J / np.diag(M)
