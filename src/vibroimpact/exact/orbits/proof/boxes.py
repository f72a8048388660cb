"""Steady motion of the boxes under forcing and trains of impulses, in interval arithmetic (python-flint's arb)."""

import numpy as np
from flint import acb, acb_mat, arb, arb_mat

from vibroimpact.system.matrices import rate_matrix

_UNIT_IMPULSES = arb_mat(np.eye(4)[:, 2:].tolist())


class SteadyBoxes:
    """The boxes of a system whose matrices and forcing are the float64 numbers that the code holds, [X1, X2, X1', X2'].

    omega, period: of the forcing; rate (4, 4): of the free motion; start (4, 2): state just after an impulse, column j
    for a train on box j (sign +1: equal impulses, one a period; -1: alternating ones, one every half period);
    amplitude (4, 1) complex: without impulses the state is Im(amplitude exp(i omega tau)).

    Raises:
        ValueError: undamped boxes in resonance with the train or the forcing.
    """

    def __init__(self, system, sign: int):
        rate = rate_matrix(system)
        self.omega = arb(system.Omega)
        self.period = 2 * arb.pi() / self.omega
        self.rate = arb_mat(rate[:4, :4].tolist())
        closure = identity(4) - sign * (self.rate * (self.period if sign == 1 else self.period / 2)).exp()
        try:
            self.start = closure.solve(_UNIT_IMPULSES)
            receptance = acb_mat(identity(4)) * acb(0, self.omega) - acb_mat(self.rate)
            self.amplitude = receptance.solve(acb_mat([[acb(f)] for f in rate[:4, 4].tolist()]))
        except ZeroDivisionError:
            raise ValueError("system: its undamped boxes are in resonance with the impacts; add damping") from None

    def free(self, duration) -> arb_mat:
        """exp(rate duration) (4, 4) for a time or an interval of times."""
        return (self.rate * duration).exp()

    def forced(self, tau) -> acb_mat:
        """State (4, 1) as a complex number without impulses, whose imaginary part it is."""
        return self.amplitude * (acb(0, 1) * self.omega * tau).exp()


def identity(size: int) -> arb_mat:
    """Unit matrix."""
    return arb_mat(np.eye(size).tolist())
