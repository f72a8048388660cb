"""The strongly modulated response by the slow flow: drift along the manifold, loss of resonance, return.

A ball in resonance is on the stable part of the manifold, symmetric or, beyond symmetry breaking, asymmetric. Where the
box's amplitude has sunk to the fold, B = B_min, it is lost; from then on it is taken to rest in the middle of its box
and to do nothing, until at B = 1 the walls strike it and it is in resonance again (docs/derivation.md, section 12).
Nothing is fitted.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from vibroimpact.exact.orbits.newton import follow, newton
from vibroimpact.studies.theory.asymmetric_points import balance
from vibroimpact.studies.theory.branch import ASYMMETRIC, charts
from vibroimpact.theory.manifold import B_min, C_min, C_of_B, rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, impedances

RETURN = 1.0
"""The amplitude of a box whose walls reach a ball at rest in the middle."""
_PER_CYCLE = 24
_NODES = 2000
_BEYOND = 0.9  # v^2 at the end of the tables
_FOLLOWED, _SMALLEST, _JUMP = 0.01, 0.5, 0.1


@dataclass(frozen=True, eq=False)
class Relaxation:
    """Statistics of both balls in a relaxation, each (..., 2).

    bursts: mean length of the stretches in resonance that have ended, in forcing periods; nan where none has.
    share: part of the time that each ball is in resonance.
    largest: of B.
    """

    bursts: np.ndarray
    share: np.ndarray
    largest: np.ndarray


def describing_function(kappa: float):
    """Return B -> N on the stable part of the manifold and on from it along the asymmetric branch."""
    r, chart = rho(kappa), charts(kappa)[ASYMMETRIC]
    squared = np.linspace(0.0, _BEYOND, _NODES)
    skewed = np.abs(chart.z(squared) / chart.beta(squared))
    even = np.linspace(B_min(r), skewed[0], _NODES)[:-1]
    C = C_of_B(even, r)[1]
    B = np.concatenate([even, skewed])
    N = np.concatenate([FIRST_HARMONIC * C / (1 - (1 + 1j * r) * C), chart.n(squared) / chart.z(squared)])
    return lambda size: np.interp(size, B, N)


def relax(system, cycles: int, settle: int, start=(1.0, 1.0), forces=None) -> Relaxation:
    """Follow the slow flow for `cycles` forcing periods after `settle` others.

    Parameters
    ----------
    start : default (1.0, 1.0)
        Amplitudes b_i = B_i exp(-i psi_i) of both modules; both balls are in resonance.
    forces : optional
        (..., 2) in the place of those of the system; all are followed at once.
    """
    e, K = impedances(system)
    forces = np.array([system.f10_hat, system.f20_hat] if forces is None else forces)
    lowest = B_min(rho(system.kappa))
    ball, step = describing_function(system.kappa), system.epsilon * system.period / _PER_CYCLE

    def flow(b, resonant):
        return (forces - (e + resonant * ball(np.abs(b))) * b - K * (b - b[..., ::-1])) / 2j

    b, resonant = np.broadcast_to(np.array(start, dtype=complex), forces.shape), np.full(forces.shape, True)
    sizes, states = np.empty((2, cycles * _PER_CYCLE, *forces.shape))
    for number in range(-settle * _PER_CYCLE, cycles * _PER_CYCLE):
        b = b + step * flow(b + step / 2 * flow(b, resonant), resonant)
        size = np.abs(b)
        resonant = np.where(resonant, size > lowest, size >= RETURN)
        if number >= 0:
            sizes[number], states[number] = size, resonant
    bursts = np.apply_along_axis(_mean_length, 0, states) / _PER_CYCLE
    return Relaxation(bursts, states.mean(axis=0), sizes.max(axis=0))


def _mean_length(states):
    """Return the mean number of steps of the stretches that have begun and ended."""
    changes = np.diff(states)
    begins, ends = np.flatnonzero(changes > 0), np.flatnonzero(changes < 0)
    ends = ends[ends > begins[0]] if len(begins) else ends[:0]
    return np.mean(ends - begins[: len(ends)]) if len(ends) else np.nan


def lost_at(system, point) -> float:
    """Return the factor below 1 of both forces at which a fixed point with a symmetric module loses that at the fold.

    nan if it is not beyond the fold at first, or if both forces can fall to a half, or if it ends before at a fold of
    its own.

    Parameters
    ----------
    point
        An asymmetric fixed point of the system; it is followed in small steps.
    """
    symmetric = np.flatnonzero(~point.asymmetric & np.isfinite(point.C))
    if len(symmetric) != 1 or not point.asymmetric.any():
        return np.nan
    (symmetric,) = symmetric

    fold, chart = C_min(rho(system.kappa)), charts(system.kappa)[point.charts[symmetric]]

    def conditions(factor):
        return balance(system.with_(f10_hat=factor * system.f10_hat, f20_hat=factor * system.f20_hat), point.charts)

    def beyond(x):
        return chart.amplitudes(x[symmetric])[0] - fold

    last = point.x
    if beyond(last) > 0:
        for factor, x in follow(conditions, last, np.arange(1 - _FOLLOWED, _SMALLEST, -_FOLLOWED), _JUMP):
            if beyond(x) <= 0:
                ends = factor, factor + _FOLLOWED
                return brentq(lambda between, x=last: beyond(newton(conditions(between), x[None])[0]), *ends)
            last = x
    return np.nan
