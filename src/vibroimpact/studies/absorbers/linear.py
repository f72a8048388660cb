"""Steady response of a linear system of boxes and attached masses, in the units of (10.2)."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigvals
from scipy.optimize import minimize_scalar

POINTS = 400
"""Number of frequencies in a band at which a response is sampled, in addition to the natural frequencies."""


@dataclass(frozen=True, eq=False)
class Linear:
    """Linear system M X'' + C X' + K X = F sin(Omega tau), dimensionless.

    The coordinates are X_1 and X_2 of the boxes. If there are absorbers, their coordinates Y_1 and Y_2 follow.

    mass, damping, stiffness: matrices M, C and K, shape (n, n).
    force: amplitudes F, shape (n,).
    scale: function of the frequency Omega that returns a factor by which F is multiplied.
    """

    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    force: np.ndarray
    scale: Callable = np.ones_like

    def amplitudes(self, Omega) -> np.ndarray:
        """Return the steady amplitudes of X_1 and X_2 at the frequencies `Omega`, shape (..., 2).

        An undamped resonance raises numpy.linalg.LinAlgError.
        """
        return np.abs(self._responses(Omega)[..., :2])

    def strokes(self, Omega) -> np.ndarray:
        """Return the strokes of both absorbers at the frequencies `Omega`, shape (..., 2).

        The stroke of an absorber is the amplitude of X_i - Y_i. An undamped resonance raises numpy.linalg.LinAlgError.
        """
        responses = self._responses(Omega)
        return np.abs(responses[..., :2] - responses[..., 2:])

    def _responses(self, Omega):
        """Return the complex amplitudes of all coordinates, shape (..., n)."""
        Omega = np.asarray(Omega, float)[..., None, None]
        impedance = self.stiffness - Omega**2 * self.mass + 1j * Omega * self.damping
        return np.linalg.solve(impedance, self.scale(Omega) * self.force[:, None])[..., 0]

    def peak(self, band: tuple[float, float]) -> float:
        """Return the largest amplitude of X_1 and X_2 in a band, or inf if the band contains an undamped resonance."""
        return self._highest(self.amplitudes, band)

    def stroke(self, band: tuple[float, float]) -> float:
        """Return the largest stroke of an absorber in a band, or inf if the band contains an undamped resonance."""
        return self._highest(self.strokes, band)

    def _highest(self, measure, band):
        """Return the largest value of `measure` in a band, or inf if the band contains an undamped resonance.

        measure: the method `amplitudes` or `strokes`.
        """
        low, high = band
        resonances = np.abs(eigvals(self.rate).imag)
        inside = resonances[(resonances > low) & (resonances < high)]
        grid = np.unique([*np.linspace(low, high, POINTS), *inside])
        try:
            heights = measure(grid).max(axis=1)
            ringed = np.concatenate([[-math.inf], heights, [-math.inf]])
            humps = np.flatnonzero((heights >= ringed[:-2]) & (heights >= ringed[2:]))
            return max(_height(measure, grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)]) for k in humps)
        except np.linalg.LinAlgError:
            return math.inf

    @property
    def rate(self) -> np.ndarray:
        """Matrix A of the motion without force, d/dtau [X, X'] = A [X, X'], shape (2n, 2n)."""
        n = len(self.force)
        upper = np.hstack([np.zeros((n, n)), np.eye(n)])
        return np.vstack([upper, -np.linalg.solve(self.mass, np.hstack([self.stiffness, self.damping]))])


def _height(measure, low, high):
    """Return the largest value of `measure` between two frequencies that enclose one local maximum."""
    best = minimize_scalar(
        lambda Omega: -measure(Omega).max(), bounds=(low, high), method="bounded", options={"xatol": 1e-10}
    )
    return float(max(-best.fun, *measure([low, high]).ravel()))
