"""Compute Lyapunov exponents from any initial state."""

from vibroimpact.exact.engine.ensemble import finals
from vibroimpact.exact.engine.simulation import checked_state
from vibroimpact.studies.regimes import lyapunov
from vibroimpact.studies.regimes.lyapunov import Exponent, Spectrum
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, whole

_MOST = 10_000_000


def largest_lyapunov(system: System, state, cycles: int = 2000, settle: int = 1000, blocks: int = 20) -> Exponent:
    """Return the largest Lyapunov exponent of the motion reached from an initial state, in nats per period.

    An exponent above about three errors indicates chaos. For a periodic motion it is the logarithm of the modulus of
    the largest Floquet multiplier, over the period. It is computed from the exact Jacobian through impacts, chatter and
    sticking, for the modules that take part.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    state : array_like
        Initial state at tau = 0, shape (8,); from rest a ball may stay idle forever.
    cycles : int, default 2000
        Forcing periods to average over, a multiple of `blocks`.
    settle : int, default 1000
        Forcing periods of the transient. Increase it for slow transients. With several attractors the initial state
        decides (`basins`).
    blocks : int, default 20
        Number of blocks of `cycles`, at least 2, whose scatter gives the error.

    Returns
    -------
    Exponent
        .mean and .error. The error includes the apparent rate of a perturbation that grows linearly in time, as for a
        ball at rest.

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
        raise ValueError(f"cycles: {cycles} is not a multiple of the {blocks} blocks")
    return lyapunov.largest_exponent(system, _settled(system, state, settle), blocks, cycles // blocks)


def lyapunov_spectrum(system: System, state, cycles: int = 2000, settle: int = 1000) -> Spectrum:
    """Return all Lyapunov exponents of the motion reached from an initial state, in nats per period.

    They are the exponents of the map from one forcing period to the next; the exponent 0 of the time itself is not
    included. A ball that sticks loses two directions, whose exponents are -inf. A perturbation that grows linearly in
    time t, as for a ball at rest, has the apparent exponent ln(t) / t, which no error covers.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    state, cycles, settle
        As for `largest_lyapunov`.

    Returns
    -------
    Spectrum
        .exponents, largest first, shape (8,), or (4,) if one module takes part (`PhysicalSystem.single`);
        .errors(block); .dimension (Kaplan-Yorke); .without_double_sticks().

    Raises
    ------
    ValueError
        If an argument is malformed.
    ArithmeticError
        If the run could not be finished.

    Examples
    --------
    >>> spectrum = lyapunov_spectrum(system, [0.0] * 8, cycles=200, settle=600)
    >>> bool(spectrum.exponents[0] < 0)  # a periodic motion attracts
    True
    """
    cycles = whole("cycles", cycles, 1, _MOST)
    return lyapunov.spectrum(system, _settled(system, state, settle), cycles)


def _settled(system, state, settle):
    """Return the state (8,) after a transient."""
    instance("system", system, System)
    return finals(system, checked_state(state)[None], whole("settle", settle, 0, _MOST))[0]
