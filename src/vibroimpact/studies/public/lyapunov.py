"""Lyapunov exponents from any start, in one call."""

from vibroimpact.exact.engine.ensemble import finals
from vibroimpact.exact.engine.simulation import checked_state
from vibroimpact.studies.regimes import lyapunov
from vibroimpact.studies.regimes.lyapunov import Exponent, Spectrum
from vibroimpact.system import System
from vibroimpact.system.arguments import instance, whole

_MOST = 10_000_000


def largest_lyapunov(system: System, state, cycles: int = 2000, settle: int = 1000, blocks: int = 20) -> Exponent:
    """Return the largest Lyapunov exponent of the motion that a start ends in: its mean and error, in nats per period.

    Above 0 by more than some three errors: chaos. On a periodic motion it is the log of the modulus of the largest
    Floquet multiplier, over the period. From the exact Jacobian through impacts, chatter and sticking (Benettin et al.
    1980; saltation: Mueller 1995), of the modules that take part. The error includes what growth in proportion to
    time would show, as that of a ball at rest.

    >>> exponent = largest_lyapunov(system.with_(f10_hat=0.5, f20_hat=0.5), [0, 0, 0, 0, 0, 0.5, 0, -0.5])
    >>> bool(exponent.mean > 3 * exponent.error)
    True

    Parameters
    ----------
    state
        (8,) start at tau = 0; from rest a ball may stay idle for good.
    cycles : int, default 2000
        Forcing periods that are averaged over, a multiple of `blocks`.
    settle : int, default 1000
        Those before them. Raise `settle` where a motion settles slowly; the start decides where several motions attract
        (`basins`).
    blocks : int, default 20
        Parts of `cycles`, at least 2, whose scatter gives the error.

    Raises
    ------
    ValueError
        If an argument is malformed.
    ArithmeticError
        If the run could not be finished, or the motion forgets every perturbation.
    """
    blocks = whole("blocks", blocks, 2, _MOST)
    cycles = whole("cycles", cycles, blocks, _MOST)
    if cycles % blocks:
        raise ValueError(f"cycles: {cycles} is not a multiple of the {blocks} blocks")
    return lyapunov.largest_exponent(system, _settled(system, state, settle), blocks, cycles // blocks)


def lyapunov_spectrum(system: System, state, cycles: int = 2000, settle: int = 1000) -> Spectrum:
    """Return all Lyapunov exponents of the motion that a start ends in, largest first, in nats per forcing period.

    `.exponents` (8,), or (4,) if one module takes part (`PhysicalSystem.single`), `.errors(block)`, `.dimension`
    (Kaplan-Yorke), `.without_double_sticks()`: a ball that sticks loses two directions for good, whose exponents are
    -inf. They are those of the map from one period to the next; the time itself, exponent 0, is not among them. A
    perturbation that grows with time t, as that of a ball at rest, shows ln(t) / t, which no error covers.

    >>> spectrum = lyapunov_spectrum(system, [0.0] * 8, cycles=200, settle=600)
    >>> bool(spectrum.exponents[0] < 0)  # a periodic motion attracts
    True

    Parameters
    ----------
    state, cycles, settle
        As for `largest_lyapunov`.

    Raises
    ------
    ValueError
        If an argument is malformed.
    ArithmeticError
        If the run could not be finished.
    """
    cycles = whole("cycles", cycles, 1, _MOST)
    return lyapunov.spectrum(system, _settled(system, state, settle), cycles)


def _settled(system, state, settle):
    """Return the state (8,) after a transient."""
    instance("system", system, System)
    return finals(system, checked_state(state)[None], whole("settle", settle, 0, _MOST))[0]
