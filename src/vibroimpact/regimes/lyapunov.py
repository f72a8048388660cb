"""Largest Lyapunov exponent of a motion, from the exact Jacobian of the flow through impacts, chatter and sticking."""

import numpy as np

from vibroimpact.exact.simulation import simulate


def largest_exponent(system, state, blocks: int, cycles: int, discarded: int = 10) -> float:
    """Mean growth rate of a perturbation per forcing period, in nats.

    A perturbation is carried along by the Jacobian of each block of cycles (saltation matrices included) and made of
    length one again (Benettin et al. 1980; Müller 1995 for saltations). On a periodic motion this is the log of its
    largest multiplier's modulus, over the period.

    Args:
        state: (8,) on the attractor, at the start of a forcing cycle.
        blocks: how many blocks are averaged over.
        cycles: forcing cycles in a block.
        discarded: blocks before those, for the perturbation to turn to the direction of largest growth.

    Raises:
        ArithmeticError: the perturbation vanished: the motion forgets it altogether.
    """
    direction, growth = np.full(8, 8**-0.5), []
    for _ in range(discarded + blocks):
        run = simulate(system, state, cycles)
        direction, state = run.jacobian @ direction, run.final
        length = np.linalg.norm(direction)
        if length == 0:
            raise ArithmeticError("the perturbation vanished, so that it has no growth rate")
        direction /= length
        growth.append(np.log(length))
    return float(np.mean(growth[discarded:]) / cycles)
