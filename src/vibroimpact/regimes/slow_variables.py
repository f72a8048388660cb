"""The slow variables of (10.9)-(10.12) as they are found in a sampled motion, for comparison with fixed points."""

import numpy as np


def amplitude_and_lag(tau, values, Omega: float) -> tuple[np.ndarray, np.ndarray]:
    """B and psi [rad] of the first harmonic B sin(Omega tau - psi), per column of values.

    Args:
        tau: evenly spaced times that cover whole forcing periods, the end left out, shape (n,).
        values: shape (n, k), U_1 and U_2 say.

    Returns:
        B and psi in (-pi, pi], each shape (k,).
    """
    turning = np.exp(-1j * Omega * np.asarray(tau))[:, None]
    phasor = 2j * np.mean(np.asarray(values) * turning, axis=0)
    return np.abs(phasor), -np.angle(phasor)


def sawtooth_amplitude(ball_velocity, epsilon: float, Omega: float):
    """C of a saw-tooth with the slope of the ball's flight: Z = W - U = -(1 + epsilon) Y, half a period long.

    Args:
        ball_velocity: Y' of the flight, any shape, either sign.
    """
    return (1 + epsilon) * np.pi * np.abs(ball_velocity) / (2 * Omega)


def phase_in_cycle(tau, period: float):
    """Fraction of the forcing period, in [0, 1), at which events happen."""
    return np.remainder(np.asarray(tau) / period, 1.0)


def mean_phase(phases) -> tuple[float, float]:
    """Mean of phases (fractions of a period) on the circle, in [0, 1), and the largest distance from it."""
    turns = np.asarray(phases)
    mean = np.angle(np.mean(np.exp(2j * np.pi * turns))) / (2 * np.pi) % 1.0
    distance = np.abs((turns - mean + 0.5) % 1.0 - 0.5)
    return float(mean), float(np.max(distance))
