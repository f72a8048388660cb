"""The boxes' response to the kicks in harmonics: the rungs between the describing function and the exact orbit.

A train of alternating unit impulses, one every T/2, is (4/T) sum cos(n Omega s) over odd n. Through the receptances
H(n Omega) = dynamic stiffness^-1 of the boxes, which are exact at any epsilon, it moves them by

    x(s) = (4/T) Re sum_{n = 1, 3, ..., N} H(n Omega) exp(i n Omega s).

N = 1 is the describing function of the balls, harmonic balance with one harmonic; with N -> infinity the symmetric
conditions are those of the exact orbit (Masri and Caughey 1966 for one module). Two facts about the impact itself need
no series. There, s = 0, the velocity of the kicked box jumps by 1 and the sum gives the mean of both sides: just
before, it is lower by 1/2. And the part -1/(n Omega)^2 of H, that of a free mass, sums to -T/8. Without it, x(0)
converges like 1/N: its error is 1/(pi Omega N) to leading order; with it, like 1/N^3. The mean velocity converges like
gamma/N.
"""

import numpy as np

from vibroimpact.system.matrices import damping_matrix, stiffness_matrix


class HarmonicResponse:
    """Odd harmonics 1, 3, ..., N of the boxes' motion under alternating trains of unit impulses.

    Args:
        highest: N, odd.
        free_mass: take the free mass's part of the own displacement in closed form: U_i = X_i + epsilon Y_i is then
            what has N harmonics, as U_i0 of (10.9) has one, and the saw-tooth keeps all.

    Raises:
        ValueError: highest is not an odd number from 1 on; or undamped boxes are in resonance with a harmonic.
    """

    def __init__(self, system, highest: int, free_mass: bool = False):
        if highest < 1 or highest % 2 == 0:
            raise ValueError(
                f"highest: {highest} is no odd number from 1 on; symmetric motions have odd harmonics only"
            )
        self.terms = (highest + 1) // 2
        self.frequencies = system.Omega * np.arange(1, highest + 1, 2)
        w = self.frequencies[:, None, None]
        stiffness = stiffness_matrix(system) - w**2 * np.eye(2) + 1j * w * damping_matrix(system)
        if np.linalg.cond(stiffness).max() > 1e12:
            raise ValueError(
                f"system: undamped boxes in resonance with a harmonic of Omega = {system.Omega}; add damping"
            )
        self._receptance = 4 / system.period * np.linalg.inv(stiffness)
        summed = 4 / system.period * np.sum(self.frequencies**-2.0)
        self._own = summed - system.period / 8 if free_mass else 0.0

    def between(self, times: np.ndarray, boxes: np.ndarray):
        """As ImpulseResponse.between: displacement, velocity and acceleration, each (*times.shape, n)."""
        lags = times[..., :, None] - times[..., None, :]
        turns = np.exp(1j * self.frequencies[:, None, None] * lags[..., None, :, :])
        series = self._receptance[:, boxes[:, None], boxes] * turns
        rate = 1j * self.frequencies[:, None, None]
        x, v, a = (np.sum(rate**k * series, axis=-3).real for k in range(3))
        own = np.eye(len(boxes))
        return x + self._own * own, v - 0.5 * own, a
