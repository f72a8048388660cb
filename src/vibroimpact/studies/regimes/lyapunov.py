"""Compute Lyapunov exponents from the exact Jacobian through impacts, chatter and sticking.

The Jacobian of every cycle, saltation matrices included (Müller 1995), propagates a frame of perturbations. QR
orthonormalises the frame (Benettin et al. 1980; Geist, Parlitz and Lauterborn 1990). The logarithms of the diagonal of
R are the growth in the cycle. The initial time is not perturbed. As a further coordinate, it would add an exponent 0
and increase the dimension by one.

When a ball sticks, perturbations in two directions of the state space vanish. When both balls stick at the same time
(a double stick), perturbations in four directions vanish. If double sticks occur with a positive frequency, four
exponents are -inf, and the dimension of the attractor is at most 4.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from vibroimpact.exact.engine.simulation import checked_state, simulate
from vibroimpact.exact.engine.variation import growth
from vibroimpact.exact.lanes.ensemble import finals
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, whole
from vibroimpact.system.matrices import damping_matrix
from vibroimpact.system.state import active_mask, inactive_at_rest

BOTH = 2
CYCLES_PER_RUN = 1000
"""Number of forcing cycles that are simulated in one run."""
# Initial perturbations. Most are random, since regular vectors may have no component in a direction of growth.
_VECTORS = np.column_stack([np.ones(8), np.random.default_rng(1).normal(size=(8, 7))])
_MOST = 10_000_000
_RESAMPLES = 200  # number of draws of the bootstrap


class Exponent(NamedTuple):
    """Mean growth rate of a perturbation per forcing period, in nats, and its error.

    The error is sqrt(a^2 + b^2). Here a is the standard error of the mean over blocks, and b = ln(t1 / t0) / (t1 - t0)
    for an average from t0 to t1. A perturbation that grows in proportion to time has the mean b instead of 0. An
    example is a small velocity of a ball that is otherwise at rest.
    """

    mean: float
    error: float


class Measured(Exponent):
    """An `Exponent` with its `scatter`, the standard error of the mean over blocks of cycles."""

    scatter: float


def largest_lyapunov(
    system: System, state, cycles: int = 2000, settle: int = 1000, blocks: int = 20, discarded: int = 10
) -> Measured:
    """Return the largest Lyapunov exponent of the motion reached from an initial state, in nats per period.

    An exponent above about three times its error indicates chaos. For a periodic motion, the exponent is ln |mu| / n,
    with the largest Floquet multiplier mu and the period of n forcing periods.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    state : array_like
        Initial state at tau = 0, shape (8,). A ball that starts at rest may stay idle.
    cycles : int, default 2000
        Forcing periods to average over, a multiple of `blocks`.
    settle : int, default 1000
        Forcing periods of the transient. With several attractors, the initial state selects one (`basins`).
    blocks : int, default 20
        Number of blocks for the standard error, at least 2.
    discarded : int, default 10
        Number of discarded blocks after the transient, in which the perturbation turns to the direction of largest
        growth.

    Returns
    -------
    Measured
        .mean, the exponent; .scatter, its standard error; .error, which also allows for growth in proportion to time.

    Raises
    ------
    ValueError
        If an argument is malformed.
    ArithmeticError
        If the run could not be finished, or if every perturbation vanishes.

    References
    ----------
    Benettin et al. 1980; Mueller 1995 (saltation matrices).

    Examples
    --------
    >>> exponent = largest_lyapunov(system.with_(f10_hat=0.5, f20_hat=0.5), [0, 0, 0, 0, 0, 0.5, 0, -0.5])
    >>> bool(exponent.mean > 3 * exponent.error)
    True
    """
    blocks = whole("blocks", blocks, 2, _MOST)
    cycles = whole("cycles", cycles, blocks, _MOST)
    if cycles % blocks:
        raise ValueError(f"cycles: {cycles} is not a multiple of blocks = {blocks}")
    block, state = cycles // blocks, _settled(system, state, settle)
    factors = np.array([grown.factors for grown in _frame_growth(system, state, [block] * (discarded + blocks), 1)])
    if not factors.all():
        raise ArithmeticError("the motion has no finite Lyapunov exponent, since its perturbation vanishes")
    rates = np.log(factors[discarded:]).mean(axis=(1, 2))
    mean, scatter = rates.mean(), rates.std(ddof=1) / np.sqrt(blocks)
    first, last = max(discarded * block, 1), discarded * block + cycles
    with_time = np.log(last / first) / cycles
    found = Measured(float(mean), float(np.hypot(scatter, with_time)))
    found.scatter = float(scatter)
    return found


@dataclass(frozen=True, eq=False)
class Spectrum:
    """All Lyapunov exponents of the map from one forcing cycle to the next, largest first.

    Attributes
    ----------
    growth : ndarray
        Logarithm of the growth in each direction in each of n cycles, (n, 8), or (n, 4) if one module is active. If a
        ball sticks, two values are -inf, or four if both balls stick at the same time.
    contraction : ndarray
        Logarithm of the contraction of volume in each cycle, (n,).
    stuck : ndarray
        Largest number of balls that stick at the same time in each cycle, (n,).
    """

    growth: np.ndarray
    contraction: np.ndarray
    stuck: np.ndarray

    @property
    def double_sticks(self) -> int:
        """Number of cycles in which both balls stick at the same time."""
        return int(np.count_nonzero(self.stuck == BOTH))

    def without_double_sticks(self) -> "Spectrum":
        """Return the spectrum over the cycles in which the balls do not stick at the same time.

        After an excluded cycle, the perturbations need about ten cycles to align again. These cycles are included,
        since they change the result little.
        """
        others = self.stuck < BOTH
        return Spectrum(_largest_first(self.growth[others]), self.contraction[others], self.stuck[others])

    @property
    def exponents(self) -> np.ndarray:
        """Lyapunov exponents, (8,), or (4,) if one module is active, per forcing period, in nats."""
        return self.growth.mean(axis=0)

    @property
    def dimension(self) -> float:
        """Kaplan-Yorke dimension of the attractor of the map from one forcing cycle to the next, see `kaplan_yorke`."""
        return kaplan_yorke(self.exponents)

    def errors(self, block: int) -> tuple[np.ndarray, float]:
        """Return the standard errors of the exponents (nan for an exponent of -inf) and of the dimension.

        The circular block bootstrap (Politis and Romano 1992) preserves the correlation of successive cycles.

        Parameters
        ----------
        block : int
            Cycles per block, from 1 to half of all cycles.

        Raises
        ------
        ValueError
            If an argument is malformed, or if there are fewer than 2 cycles.
        """
        n, forgotten = len(self.growth), np.isneginf(self.exponents)
        if n < 2:
            raise ValueError(f"growth: got {n} cycles, expected at least 2")
        block = whole("block", block, 1, n // 2)
        finite = np.where(forgotten, 0.0, self.growth)
        sums = np.cumsum(np.concatenate([np.zeros_like(finite[:1]), finite, finite[: block - 1]]), axis=0)
        stretches = (sums[block:] - sums[:-block]) / block
        drawn = stretches[np.random.default_rng(1).integers(n, size=(_RESAMPLES, n // block))].mean(axis=1)
        dimensions = [kaplan_yorke(np.where(forgotten, -np.inf, exponents)) for exponents in drawn]
        return np.where(forgotten, np.nan, drawn.std(axis=0, ddof=1)), float(np.std(dimensions, ddof=1))


def lyapunov_spectrum(system: System, state, cycles: int = 2000, settle: int = 1000, discarded: int = 100) -> Spectrum:
    """Return all Lyapunov exponents of the motion reached from an initial state, in nats per period.

    The exponents are those of the map from one forcing period to the next, without the exponent 0 along the flow. If a
    ball sticks, two exponents are -inf, or four if both balls stick at the same time. The computed exponent of a
    perturbation that grows in proportion to the time t is about ln(t) / t instead of 0. The errors do not include this
    deviation.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    state, cycles, settle
        As for `largest_lyapunov`.
    discarded : int, default 100
        Discarded forcing periods after the transient, in which each perturbation turns to the direction of its
        exponent.

    Returns
    -------
    Spectrum
        .exponents, largest first, (8,), or (4,) if one module is active; .errors(block), their standard errors;
        .dimension (Kaplan-Yorke); .without_double_sticks().

    Raises
    ------
    ValueError
        If an argument is malformed.
    ArithmeticError
        If the run could not be finished.

    Examples
    --------
    >>> spectrum = lyapunov_spectrum(system, [0.0] * 8, cycles=200, settle=600)
    >>> bool(spectrum.exponents[0] < 0)  # the motion is periodic and stable
    True
    """
    cycles, state = whole("cycles", cycles, 1, _MOST), _settled(system, state, settle)
    full, rest = divmod(discarded + cycles, CYCLES_PER_RUN)
    size = np.count_nonzero(active_mask(system))
    parts = zip(*_frame_growth(system, state, [CYCLES_PER_RUN] * full + [rest] * (rest > 0), size), strict=True)
    factors, impacts, stuck, _ = (np.concatenate(part)[discarded:] for part in parts)
    with np.errstate(divide="ignore"):
        rates = np.log(factors)
    rates[np.arange(size) >= size - 2 * stuck[:, None]] = -np.inf  # the last 2 * stuck factors are 0 up to rounding
    return Spectrum(_largest_first(rates), contraction(system, impacts, stuck), stuck)


def _largest_first(rates):
    return rates[:, np.argsort(-rates.mean(axis=0), kind="stable")]


def contraction(system, impacts, stuck) -> np.ndarray:
    """Return the logarithm of the contraction of volume in state space in each cycle, shape (n,).

    impacts, stuck: number of impacts, and largest number of balls that stick at the same time, in each cycle.

    A flight of time t contracts the volume by exp(-tr(D) t), with the damping matrix D of the active modules. An impact
    contracts the volume by kappa^2. The saltation matrix is triangular in the coordinates W = X - Y, W', and position
    and velocity of the centre of mass. Its diagonal is (-kappa, -kappa, 1, 1). A stick contracts the volume to 0.
    """
    damping = np.diag(damping_matrix(system))[active_mask(system)[[0, 2]]].sum()
    volume = 2 * np.asarray(impacts) * np.log(system.kappa) - damping * system.period
    return np.where(np.asarray(stuck) > 0, -np.inf, volume)


def kaplan_yorke(exponents) -> float:
    """Return the Kaplan-Yorke dimension (1979) of exponents (n,), largest first.

    The dimension is the number k, by linear interpolation, for which the k largest exponents have the sum 0.
    """
    exponents = np.asarray(exponents)
    sums = np.cumsum(exponents)
    full = int(np.argmax(sums < 0)) if (sums < 0).any() else len(sums)
    if full in (0, len(sums)):
        return float(full)
    return float(full + sums[full - 1] / -exponents[full])


def _frame_growth(system, state, runs, directions):
    """Simulate consecutive runs of `runs` cycles; yield the growth of a frame of perturbations in each run."""
    places = np.flatnonzero(active_mask(system))
    frame, state = np.zeros((8, directions)), inactive_at_rest(system, state)
    frame[places] = np.linalg.qr(_VECTORS[: len(places), : len(places)])[0][:, :directions]
    for cycles in runs:
        run = simulate(system, state, cycles)
        grown = growth(run, frame)
        frame, state = grown.frame, run.final
        yield grown


def _settled(system, state, settle):
    """Return the state (8,) after a transient of `settle` forcing periods from `state`."""
    instance("system", system, System)
    return finals(system, checked_state(state)[None], whole("settle", settle, 0, _MOST))[0]
