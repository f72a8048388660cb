"""The slow flow in (B_1, psi_1, B_2, psi_2), C following B on its arm of the manifold; not defined at the fold."""

import numpy as np

from vibroimpact.theory.slow_flow import linearisation


def jacobian(system, psi, C):
    J, M = linearisation(system, psi, C)
    return J / np.diag(M)
