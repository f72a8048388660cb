"""Measure the slow variables of (10.9)-(10.12) in a sampled motion, to compare them with fixed points."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.system.amplitude import sawtooth_amplitude

WALLS = (1, -1)


def amplitude_and_lag(tau, values, Omega: float) -> tuple[np.ndarray, np.ndarray]:
    """Return B and psi [rad] of the first harmonic B sin(Omega tau - psi) of each column of `values`.

    tau: evenly spaced times over whole forcing periods, without the end point, shape (n,). values: values at these
    times, shape (n, k). psi is in [-pi, pi].
    """
    turning = np.exp(-1j * Omega * np.asarray(tau))[:, None]
    phasor = 2j * np.mean(np.asarray(values) * turning, axis=0)
    return np.abs(phasor), -np.angle(phasor)


@dataclass(frozen=True, eq=False)
class SlowVariables:
    """Slow variables of a sampled motion.

    Attributes
    ----------
    B, psi : ndarray
        Amplitude and phase lag [rad] of the first harmonic of U_i, shape (2,).
    C : ndarray
        Saw-tooth amplitude, computed from the mean positions of the ball at its two walls, shape (2,).
    impact_phases : ndarray
        Mean phases of impacts as fractions of the forcing period, in [0, 1), shape (2, 2). The indices are
        [module, wall +1 / wall -1].
    """

    B: np.ndarray
    psi: np.ndarray
    C: np.ndarray
    impact_phases: np.ndarray

    def distance(self, point) -> float:
        """Return the distance between the phasors B_i exp(-i psi_i) of this motion and those of a fixed point."""
        return float(np.linalg.norm(self.B * np.exp(-1j * self.psi) - point.B * np.exp(-1j * np.asarray(point.psi))))


def measure(system, tau, displacements, impacts) -> SlowVariables:
    """Return the slow variables of a periodic motion.

    tau: evenly spaced sample times over whole forcing periods, without the end point, shape (n,).
    displacements: X1, Y1, X2, Y2 at the sample times, shape (n, 4).
    impacts: mapping with the keys tau, module, wall, Y1, Y2 and an array of shape (m,) for each key.
    Raise ValueError if a ball has no impact at one of its walls.
    """
    X, Y = displacements[:, 0::2], displacements[:, 1::2]
    B, psi = amplitude_and_lag(tau, X + system.epsilon * Y, system.Omega)
    C, phases = np.empty(2), np.empty((2, 2))
    module, wall = np.asarray(impacts["module"]), np.asarray(impacts["wall"])
    phasors = np.exp(2j * np.pi * np.remainder(np.asarray(impacts["tau"]) / system.period, 1.0))
    for i in (1, 2):
        ball, ends = np.asarray(impacts[f"Y{i}"]), np.empty(2)
        for column, side in enumerate(WALLS):
            here = (module == i) & (wall == side)
            if not here.any():
                raise ValueError(f"impacts: module {i} has no impact at the wall {side:+d}")
            phases[i - 1, column] = np.angle(phasors[here].mean()) / (2 * np.pi) % 1.0
            ends[column] = ball[here].mean()
        C[i - 1] = sawtooth_amplitude(system.epsilon, ends[1] - ends[0])
    return SlowVariables(B=B, psi=psi, C=C, impact_phases=phases)
