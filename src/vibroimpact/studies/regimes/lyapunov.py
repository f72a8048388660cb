"""Lyapunov exponents of a motion, from the exact Jacobian of the flow through impacts, chatter and sticking.

A frame of perturbations is carried along by the Jacobian of every cycle, saltation matrices included (Müller 1995), and
made orthonormal again, by QR (Benettin et al. 1980; Geist, Parlitz and Lauterborn 1990): the logarithms of the diagonal
of R are the growth of that cycle. The time of a start is no perturbation: a flow in the extended phase space has one
exponent more, 0, and its attractor one dimension more.

A ball that sticks loses two directions, both at once lose four. If that happens with a positive frequency, however low,
almost every point of the attractor has it in its past: four exponents are -inf, and the dimension is at most 4. Runs
without it see more, `Spectrum.without_double_sticks`.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.engine.variation import growth
from vibroimpact.system.matrices import damping_matrix

SIZE, BOTH = 8, 2
AT_ONCE = 1000
"""Cycles that are simulated at a time."""
_OTHERS = np.random.default_rng(1).normal(size=(SIZE, SIZE - 1))  # a frame with a pattern may span too little
_FRAME = np.linalg.qr(np.column_stack([np.ones(SIZE), _OTHERS]))[0]


class Exponent(NamedTuple):
    """Mean growth rate of a perturbation per forcing period, in nats, and its standard error, from block means."""

    mean: float
    error: float


def largest_exponent(system, state, blocks: int, cycles: int, discarded: int = 10) -> Exponent:
    """Largest Lyapunov exponent, with its scatter.

    On a periodic motion this is the log of its largest multiplier's modulus, over the period. The error takes the
    growth in different blocks as independent.

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
    factors = np.array([grown.factors for grown in _frame_growth(system, state, [cycles] * (discarded + blocks), 1)])
    if not factors.all():
        raise ArithmeticError("the perturbation vanished, so that it has no growth rate")
    rates = np.log(factors[discarded:]).mean(axis=(1, 2))
    return Exponent(float(rates.mean()), float(rates.std(ddof=1) / np.sqrt(blocks)))


@dataclass(frozen=True, eq=False)
class Spectrum:
    """All Lyapunov exponents of a motion, of the map from one forcing cycle to the next, largest first.

    growth: (n, 8) of the eight directions in each of n cycles; where a ball sticks, how it came to its wall is
        forgotten: -inf for two of them, for four where both stick at once.
    contraction: (n,) of volume in each cycle, in closed form: what the growths add up to.
    stuck: (n,) most balls that stick at one time in each cycle.
    """

    growth: np.ndarray
    contraction: np.ndarray
    stuck: np.ndarray

    @property
    def double_sticks(self) -> int:
        """Number of cycles in which both balls stick at once."""
        return int(np.count_nonzero(self.stuck == BOTH))

    def without_double_sticks(self) -> "Spectrum":
        """The spectrum over the cycles in which the balls do not both stick at once.

        It hardly depends on how many such cycles a run meets. Of four of its directions each sets in anew behind one,
        and turns to where it grows as it should within some ten cycles, which count.
        """
        others = self.stuck < BOTH
        return Spectrum(_largest_first(self.growth[others]), self.contraction[others], self.stuck[others])

    @property
    def exponents(self) -> np.ndarray:
        """(8,) per forcing period, in nats."""
        return self.growth.mean(axis=0)

    @property
    def dimension(self) -> float:
        """Kaplan-Yorke dimension of the attractor in the section at whole cycles, see `kaplan_yorke`."""
        return kaplan_yorke(self.exponents)

    def errors(self, block: int, resamples: int = 200, seed: int = 1) -> tuple[np.ndarray, float]:
        """Standard errors of the exponents, (8,), nan where they are -inf, and of the dimension.

        By the circular block bootstrap (Politis and Romano 1992): the n cycles are drawn anew in n / block stretches of
        `block` cycles, which keep what one cycle has to do with the next.
        """
        n, forgotten = len(self.growth), np.isneginf(self.exponents)
        finite = np.where(forgotten, 0.0, self.growth)
        sums = np.cumsum(np.concatenate([np.zeros((1, SIZE)), finite, finite[: block - 1]]), axis=0)
        stretches = (sums[block:] - sums[:-block]) / block
        drawn = stretches[np.random.default_rng(seed).integers(n, size=(resamples, n // block))].mean(axis=1)
        dimensions = [kaplan_yorke(np.where(forgotten, -np.inf, exponents)) for exponents in drawn]
        return np.where(forgotten, np.nan, drawn.std(axis=0, ddof=1)), float(np.std(dimensions, ddof=1))


def spectrum(system, state, cycles: int, discarded: int = 100) -> Spectrum:
    """All Lyapunov exponents over `cycles` forcing cycles after others, from a state as for `largest_exponent`."""
    whole, rest = divmod(discarded + cycles, AT_ONCE)
    parts = zip(*_frame_growth(system, state, [AT_ONCE] * whole + [rest] * (rest > 0), SIZE), strict=True)
    factors, impacts, stuck, _ = (np.concatenate(part)[discarded:] for part in parts)
    with np.errstate(divide="ignore"):
        rates = np.log(factors)
    rates[np.arange(SIZE) >= SIZE - 2 * stuck[:, None]] = -np.inf  # in floats, rounding
    return Spectrum(_largest_first(rates), contraction(system, impacts, stuck), stuck)


def _largest_first(rates):
    return rates[:, np.argsort(-rates.mean(axis=0), kind="stable")]


def contraction(system, impacts, stuck) -> np.ndarray:
    """Logarithm of the factor by which each cycle shrinks volumes of states, of its impacts and balls that stick, (n,).

    Flights shrink them by the damping, exp(-tr D t). In the gap of its module, its rate and the motion of their centre
    of mass an impact is triangular, with -kappa for the gap (the saltation) and -kappa for its rate (Newton's rule):
    the factor is kappa^2, whatever the flights around it. A ball that sticks leaves no volume: -inf.
    """
    volume = 2 * np.asarray(impacts) * np.log(system.kappa) - np.trace(damping_matrix(system)) * system.period
    return np.where(np.asarray(stuck) > 0, -np.inf, volume)


def kaplan_yorke(exponents) -> float:
    """Dimension at which volumes neither grow nor shrink (Kaplan and Yorke 1979), of exponents (n,), largest first.

    The sum of the largest exponents, interpolated linearly in their number, is 0 there; 0 if all are negative.
    """
    exponents = np.asarray(exponents)
    sums = np.cumsum(exponents)
    whole = int(np.argmax(sums < 0)) if (sums < 0).any() else len(sums)
    if whole in (0, len(sums)):
        return float(whole)
    return float(whole + sums[whole - 1] / -exponents[whole])


def _frame_growth(system, state, runs, directions):
    """Growth of a frame along each of some runs, of so many cycles, one after another."""
    frame = _FRAME[:, :directions]
    for cycles in runs:
        run = simulate(system, state, cycles)
        grown = growth(run, frame)
        frame, state = grown.frame, run.final
        yield grown
