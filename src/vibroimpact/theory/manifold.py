"""The slow invariant manifold (SIM) of a module in 1:1 resonance, (10.15)-(10.17) and (10.25).

Everywhere B, C and rho, (10.15), are numbers or arrays that broadcast, dimensionless; angles are in radians.
"""

import numpy as np


def rho(kappa):
    """rho = 2 (1 - kappa) / (pi (1 + kappa)), (10.15): what an impact dissipates; 0 for elastic impacts."""
    return 2 * (1 - kappa) / (np.pi * (1 + kappa))


def B_of_C(C, rho):
    """Amplitude B >= 0 of U on the manifold, (10.16), for any real C."""
    return np.hypot(1 - C, rho * C)


def slope(C, rho):
    """dB/dC along the manifold: negative on the lower arm, 0 at the fold C_min, positive on the upper arm."""
    return ((1 + rho**2) * C - 1) / B_of_C(C, rho)


def C_of_B(B, rho):
    """Amplitudes C of the saw-tooth on the lower (C <= C_min) and the upper arm of the manifold, (10.15).

    Raises:
        ValueError: some B is below B_min, where the manifold has no real point.
    """
    B = np.asarray(B, dtype=float)
    above = B - B_min(rho)
    if not np.all(above >= 0):
        raise ValueError(f"B: {np.min(B)} is not at least B_min = {B_min(rho)} for rho = {rho}")
    # Both differences are factored: exact at the fold, no cancellation on the lower arm near C = 0.
    root = np.sqrt((1 + rho**2) * above * (B + B_min(rho)))
    return (1 - B) * (1 + B) / (1 + root), (1 + root) / (1 + rho**2)


def B_min(rho):
    """Smallest amplitude B on the manifold, (10.25)."""
    return rho / np.sqrt(1 + rho**2)


def C_min(rho):
    """Amplitude C at the fold, where B = B_min, (10.25)."""
    return 1 / (1 + rho**2)


def impact_phase(C, rho):
    """theta + phi in (-pi, pi], the phase of U at the impact with the wall W = +1: U = 1 - C, (10.12), by (10.17)."""
    return np.arctan2(1 - C, rho * C)


def overshoot(C, rho):
    """Largest |W_0| - 1 over a cycle of (10.10) at a manifold point; 0 where the ball stays between the walls.

    W_0 is stationary where B cos(tau_0 + phi) = +-2 C / pi, so the maximum is found without sampling.
    """
    C = np.asarray(C, dtype=float)
    B = B_of_C(C, rho)
    turn = np.arccos(np.clip(2 * C / (np.pi * B), -1, 1))
    # Time since the impact at W = +1 of the two stationary points of the flight that follows.
    since = np.remainder(np.stack([turn, -turn]) - impact_phase(C, rho), 2 * np.pi)
    W = (1 - C) * np.cos(since) + rho * C * np.sin(since) + C * (1 - 2 * since / np.pi)
    return np.max(np.where(since <= np.pi, np.abs(W) - 1, 0), axis=0, initial=0)
