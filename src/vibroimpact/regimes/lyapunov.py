"""Largest Lyapunov exponent of a motion, from the exact Jacobian of the flow through impacts, chatter and sticking."""

from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.simulation import simulate


class Exponent(NamedTuple):
    """Mean growth rate of a perturbation per forcing period, in nats, and its standard error, from block means."""

    mean: float
    error: float


def largest_exponent(system, state, blocks: int, cycles: int, discarded: int = 10) -> Exponent:
    """Largest Lyapunov exponent, with its scatter.

    A perturbation is carried along by the Jacobian of each block of cycles (saltation matrices included) and made of
    length one again (Benettin et al. 1980; Müller 1995 for saltations). On a periodic motion this is the log of its
    largest multiplier's modulus, over the period. The error takes the growth in different blocks as independent.

    Args:
        state: (8,) on the attractor, at the start of a forcing cycle.
        blocks: how many blocks are averaged over, at least 2.
        cycles: forcing cycles in a block.
        discarded: blocks before those, for the perturbation to turn to the direction of largest growth.

    Raises:
        ValueError: fewer than 2 blocks.
        ArithmeticError: the perturbation vanished: the motion forgets it altogether.
    """
    if blocks < 2:
        raise ValueError(f"blocks: {blocks} is below 2, which a standard error needs")
    rates = growth_rates(system, state, discarded + blocks, cycles)[discarded:]
    return Exponent(float(rates.mean()), float(rates.std(ddof=1) / np.sqrt(blocks)))


def growth_rates(system, state, blocks: int, cycles: int) -> np.ndarray:
    """Growth rate per forcing period of a perturbation in each block, shape (blocks,); see `largest_exponent`.

    Raises:
        ArithmeticError: the perturbation vanished.
    """
    direction, growth = np.full(8, 8**-0.5), []
    for _ in range(blocks):
        run = simulate(system, state, cycles)
        direction, state = run.jacobian @ direction, run.final
        length = np.linalg.norm(direction)
        if length == 0:
            raise ArithmeticError("the perturbation vanished, so that it has no growth rate")
        direction /= length
        growth.append(np.log(length))
    return np.array(growth) / cycles
