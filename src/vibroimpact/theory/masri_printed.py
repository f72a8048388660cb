"""The limit of stability (10.26) as the chapter prints it; its derivation, which is left out there, is in masri.py."""

import numpy as np


def printed_limit(rho):
    """C above which a module's motion is stable according to (10.26), as printed: 4 / (4 + pi rho), shape of rho."""
    return 4 / (4 + np.pi * rho)


def limit_with_squares(rho):
    """(10.26) if its squares were lost in print: 4 / (4 + pi^2 rho^2) = (1 + kappa)^2 / (2 (1 + kappa^2))."""
    return 4 / (4 + (np.pi * rho) ** 2)
