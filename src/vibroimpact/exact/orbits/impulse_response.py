"""Compute the steady responses of the boxes to the forcing and to trains of unit impulses in closed form."""

import math
from functools import lru_cache

import numpy as np
from scipy.linalg import expm

from vibroimpact.system.matrices import dynamic_stiffness, rate_matrix

_TAYLOR_ORDER = 5
_NODES_PER_RADIAN = 128  # with this number, the Taylor remainder is (1/256)^6 / 6! = 5e-18
_FINE_NODES = 4096
_UNIT_IMPULSES = np.eye(4)[:, 2:]


def forced_amplitude(system) -> np.ndarray:
    """Return the complex amplitude a of the boxes without balls, shape (2,).

    The displacements are X = Im(a exp(i Omega tau)). Raise ValueError if the boxes have an undamped resonance at the
    forcing frequency.
    """
    try:
        return np.linalg.solve(dynamic_stiffness(system.with_inactive_damped()), system.forcing.astype(complex))
    except np.linalg.LinAlgError:
        raise ValueError(_resonance(system, "")) from None


def _resonance(system, multiple):
    """Return the error message for an undamped resonance of the boxes at a multiple of the forcing frequency.

    multiple: words for the multiple, such as "a multiple of ", or "" for the forcing frequency itself.
    """
    return (
        f"system: the boxes have an undamped resonance at {multiple}the forcing frequency Omega = {system.Omega}; "
        "add damping (gamma1_hat, gamma2_hat)"
    )


class ImpulseResponse:
    """Steady motion [X1, X2, X1', X2'] of the unforced boxes under a train of unit impulses on one box.

    sign: +1 for equal impulses, one per forcing period; -1 for alternating impulses, one per half period. The
    constructor raises ValueError if the boxes have an undamped resonance at a frequency of the train.
    """

    def __init__(self, system, sign: int):
        self.sign = sign
        self.interval = system.period if sign == 1 else system.period / 2
        self._rate = rate_matrix(system)[:4, :4]
        advance = expm(self._rate * self.interval)
        closure = np.eye(4) - sign * advance
        # The smallest singular value is tested. A condition number would miss a resonance of both boxes, since
        # `closure` is then zero.
        if np.linalg.norm(closure, -2) <= 1e-12 * (1.0 + np.linalg.norm(advance, 2)):
            raise ValueError(_resonance(system, f"{'a' if sign == 1 else 'an odd'} multiple of "))
        start = np.linalg.solve(closure, _UNIT_IMPULSES)
        nodes = math.ceil(self.interval * np.linalg.norm(self._rate, 2) * _NODES_PER_RADIAN)
        self._spacing = self.interval / nodes
        # Taylor series are stored at the first nodes only, since a table of all nodes would grow as 1/Omega.
        self._fine = max(_FINE_NODES, math.isqrt(nodes))
        at_nodes = powers(expm(self._rate * self._spacing), min(nodes + 1, self._fine)) @ start
        self._onward = powers(expm(self._rate * self._spacing * self._fine), nodes // self._fine + 1)
        taylor = [np.linalg.matrix_power(self._rate, k) / math.factorial(k) for k in range(_TAYLOR_ORDER + 1)]
        self._series = np.stack([(term @ at_nodes).swapaxes(1, 2) for term in taylor], axis=2)
        self._readings = np.stack([np.eye(4)[:2], np.eye(4)[2:], self._rate[2:]], axis=2)

    def __call__(self, s: np.ndarray, boxes: np.ndarray) -> np.ndarray:
        """Return the motion [X1, X2, X1', X2'] at the times s after an impulse of the train, shape (..., 4).

        boxes: index (0 or 1) of the box on which the impulses act. At the time of an impulse, the motion is the state
        just after the impulse.
        """
        impulses, within = np.divmod(s, self.interval)
        node = np.rint(within / self._spacing).astype(int)
        step = (within - node * self._spacing)[..., None]
        onward, node = np.divmod(node, self._fine)
        terms = self._series[node, boxes]
        value = terms[..., _TAYLOR_ORDER, :]
        for k in reversed(range(_TAYLOR_ORDER)):
            value = value * step + terms[..., k, :]
        if len(self._onward) > 1:
            value = (self._onward[onward] @ value[..., None])[..., 0]
        return value if self.sign == 1 else value * (1 - 2 * (impulses[..., None] % 2))

    def between(self, times: np.ndarray, boxes: np.ndarray):
        """Return displacements, velocities and accelerations of the boxes just before impulses.

        Each of the three arrays has the shape (..., n, n). Entry [..., m, k] is the response of box boxes[m] at
        times[..., m] to impulses on box boxes[k] at times[..., k].
        """
        motion = self(times[..., :, None] - times[..., None, :], boxes)
        own = np.arange(len(boxes))
        motion[..., own, own, :] -= _UNIT_IMPULSES.T[boxes]
        return np.moveaxis(motion @ self._readings[boxes], -1, 0)


def powers(matrix: np.ndarray, count: int) -> np.ndarray:
    """Return the powers matrix^n for n = 0 .. count - 1, stacked along the first axis."""
    powers = np.eye(len(matrix))[None]
    while len(powers) < count:  # rounding errors grow only with log(count)
        powers = np.concatenate([powers, powers @ np.linalg.matrix_power(matrix, len(powers))])
    return powers[:count]


def impulse_response(system, sign: int) -> ImpulseResponse:
    """Return the ImpulseResponse of a system from a cache.

    Systems that differ only in their forces have the same ImpulseResponse.
    """
    return _kept(system.with_inactive_damped().with_(f10_hat=0.0, f20_hat=0.0), sign)


_kept = lru_cache(maxsize=16)(ImpulseResponse)
