"""Compute Lyapunov exponents from the exact Jacobian through impacts, chatter and sticking.

A frame is a set of perturbations of the state. In every cycle, the frame is multiplied by the Jacobian of this cycle,
which contains the saltation matrices (Müller 1995). A QR decomposition then orthonormalises the frame (Benettin et al.
1980; Geist, Parlitz and Lauterborn 1990). The moduli of the diagonal entries of R are the growth factors in this cycle.
The initial time is not perturbed. If the time were a further coordinate, there would be a further exponent 0, and the
dimension would be larger by one.

When a ball sticks, perturbations in two directions of the state space vanish. When both balls stick at the same time
(a double stick), perturbations in four directions vanish. If double sticks occur again and again, four exponents are
-inf, and the dimension of the attractor is at most 4.
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
# Initial perturbations. All vectors except the first are random, since vectors with a regular pattern may have no
# component in a direction of growth.
_VECTORS = np.column_stack([np.ones(8), np.random.default_rng(1).normal(size=(8, 7))])
_MOST = 10_000_000
_RESAMPLES = 200  # number of draws of the bootstrap


class Exponent(NamedTuple):
    """Mean growth rate [nats per forcing period] of a perturbation, and the error of this mean.

    The error is sqrt(a^2 + b^2). Here a is the standard error of the mean over blocks of cycles. If the growth rate is
    averaged from the time t0 to the time t1 [forcing periods], b = ln(t1 / t0) / (t1 - t0). A perturbation that grows
    in proportion to time has the exponent 0, but its mean growth rate is b. An example of such a perturbation is a
    small velocity of a ball that would otherwise be at rest.
    """

    mean: float
    error: float


class Measured(Exponent):
    """An `Exponent` with the further attribute `scatter`, the standard error of the mean over blocks of cycles."""

    scatter: float


def largest_lyapunov(
    system: System, state, cycles: int = 2000, settle: int = 1000, blocks: int = 20, discarded: int = 10
) -> Measured:
    """Return the largest Lyapunov exponent [nats per forcing period] of the motion that an initial state leads to.

    An exponent above about three times its error indicates chaos. If a motion repeats after n forcing periods, the
    exponent is ln |mu| / n, where mu is the largest Floquet multiplier.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    state : array_like
        Initial state at tau = 0, shape (8,). If there are several attractors, it selects one of them (see `basins`).
        If a ball is at rest in the initial state, the walls may never hit it.
    cycles : int, default 2000
        Number of forcing periods over which the growth rate is averaged, a multiple of `blocks`.
    settle : int, default 1000
        Number of forcing periods of the transient.
    blocks : int, default 20
        Number of blocks into which `cycles` are divided for the standard error, at least 2.
    discarded : int, default 10
        Number of blocks that are left out after the transient. In these blocks, the perturbation turns to the direction
        of largest growth.

    Returns
    -------
    Measured
        The exponent is .mean, and its standard error is .scatter. The attribute .error is larger, since it also allows
        for perturbations that grow in proportion to time.

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
        Logarithm of the growth factor in each direction, for each of n cycles. The shape is (n, 8), or (n, 4) if only
        one module is active. If a ball sticks in a cycle, two values of this cycle are -inf. If both balls stick at the
        same time, four values are -inf.
    contraction : ndarray
        Logarithm of the factor by which a volume in state space changes in each cycle, shape (n,).
    stuck : ndarray
        Largest number of balls that stick at the same time in each cycle, shape (n,).
    """

    growth: np.ndarray
    contraction: np.ndarray
    stuck: np.ndarray

    @property
    def double_sticks(self) -> int:
        """Number of cycles in which both balls stick at the same time."""
        return int(np.count_nonzero(self.stuck == BOTH))

    def without_double_sticks(self) -> "Spectrum":
        """Return the spectrum without the cycles in which both balls stick at the same time.

        After an excluded cycle, the perturbations need about ten cycles to turn to the directions of the exponents
        again. These ten cycles are included, since they change the result little.
        """
        others = self.stuck < BOTH
        return Spectrum(_largest_first(self.growth[others]), self.contraction[others], self.stuck[others])

    @property
    def exponents(self) -> np.ndarray:
        """Lyapunov exponents [nats per forcing period], largest first.

        The shape is (8,), or (4,) if only one module is active.
        """
        return self.growth.mean(axis=0)

    @property
    def dimension(self) -> float:
        """Kaplan-Yorke dimension of the attractor of the map from one forcing cycle to the next."""
        return kaplan_yorke(self.exponents)

    def errors(self, block: int) -> tuple[np.ndarray, float]:
        """Return the standard errors of all exponents, and the standard error of the dimension.

        The error of an exponent of -inf is nan. The circular block bootstrap (Politis and Romano 1992) preserves the
        correlation of successive cycles.

        Parameters
        ----------
        block : int
            Number of cycles per block, from 1 to half of the number of all cycles.

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
    """Return all Lyapunov exponents [nats per forcing period] of the motion that an initial state leads to.

    The exponents are those of the map from one forcing period to the next. Therefore they do not include the exponent 0
    of a perturbation along the flow. If a ball sticks, two exponents are -inf. If both balls stick at the same time,
    four exponents are -inf. A perturbation that grows in proportion to the time t has the exponent 0, but its computed
    exponent is about ln(t) / t. The computed errors do not include this deviation.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    state, cycles, settle
        As for `largest_lyapunov`.
    discarded : int, default 100
        Number of forcing periods that are left out after the transient. In these periods, each perturbation turns to
        the direction of its exponent.

    Returns
    -------
    Spectrum
        The exponents are .exponents, largest first. Their shape is (8,), or (4,) if only one module is active. The
        standard errors are .errors(block). The Kaplan-Yorke dimension is .dimension.

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
    """Return the logarithm of the factor by which a volume in state space changes in each cycle, shape (n,).

    impacts: number of impacts in each cycle, shape (n,).
    stuck: largest number of balls that stick at the same time in each cycle, shape (n,).

    A flight of time t multiplies the volume by exp(-tr(D) t). D is the damping matrix of the boxes of the active
    modules. An impact multiplies the volume by kappa^2, the determinant of the saltation matrix. Coordinates of a
    module are W and W' with W = X - Y, and position and velocity of the centre of mass of box and ball. In these
    coordinates, the saltation matrix is triangular with the diagonal (-kappa, -kappa, 1, 1). If a ball sticks, the
    volume becomes 0.
    """
    damping = np.diag(damping_matrix(system))[active_mask(system)[[0, 2]]].sum()
    volume = 2 * np.asarray(impacts) * np.log(system.kappa) - damping * system.period
    return np.where(np.asarray(stuck) > 0, -np.inf, volume)


def kaplan_yorke(exponents) -> float:
    """Return the Kaplan-Yorke dimension (1979) for the given exponents, shape (n,), largest first.

    The dimension is the number k for which the k largest exponents have the sum 0. Between whole numbers k, the sum is
    interpolated linearly.
    """
    exponents = np.asarray(exponents)
    sums = np.cumsum(exponents)
    full = int(np.argmax(sums < 0)) if (sums < 0).any() else len(sums)
    if full in (0, len(sums)):
        return float(full)
    return float(full + sums[full - 1] / -exponents[full])


def _frame_growth(system, state, runs, directions):
    """Simulate consecutive runs; yield the growth of a frame of perturbations in each run.

    runs: number of cycles of each run. directions: number of perturbations in the frame.
    """
    places = np.flatnonzero(active_mask(system))
    frame, state = np.zeros((8, directions)), inactive_at_rest(system, state)
    frame[places] = np.linalg.qr(_VECTORS[: len(places), : len(places)])[0][:, :directions]
    for cycles in runs:
        run = simulate(system, state, cycles)
        grown = growth(run, frame)
        frame, state = grown.frame, run.final
        yield grown


def _settled(system, state, settle):
    """Simulate a transient of `settle` forcing periods from `state`; return the final state, shape (8,)."""
    instance("system", system, System)
    return finals(system, checked_state(state)[None], whole("settle", settle, 0, _MOST))[0]
