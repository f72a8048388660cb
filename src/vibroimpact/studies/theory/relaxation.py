"""Compute the strongly modulated response by the slow flow: drift along the manifold, loss of resonance, return.

A ball in resonance is on the stable part of the manifold. Beyond symmetry breaking, the motions on this part are
asymmetric. When the amplitude B of the box has fallen to the fold of the manifold, B = B_min, the ball leaves
resonance. The model assumes that the ball then rests in the middle of its box and has no effect on the box. When B has
grown to 1, the walls reach the ball. Then the ball is in resonance again (docs/derivation.md, section 12). No parameter
is fitted.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from vibroimpact.exact.orbits.newton import follow, newton
from vibroimpact.studies.theory.asymmetric_points import Balance
from vibroimpact.studies.theory.branch import ASYMMETRIC, charts
from vibroimpact.theory.manifold import B_min, C_min, C_of_B, rho
from vibroimpact.theory.slow_flow import FIRST_HARMONIC, impedances

RETURN = 1.0
"""Amplitude B of a box at which its walls reach a ball that rests in the middle of the box."""
_PER_CYCLE = 24
_NODES = 2000
_LARGEST_SQUARED = 0.9  # largest v^2 in the tables of `describing_function`
_FOLLOWED, _SMALLEST, _JUMP = 0.01, 0.5, 0.1


@dataclass(frozen=True, eq=False)
class Relaxation:
    """Results of `relax` for both modules.

    share: fraction of the time in which each ball is in resonance, shape (..., 2).
    largest: largest amplitude B of each box, shape (..., 2).
    """

    share: np.ndarray
    largest: np.ndarray


def describing_function(kappa: float):
    """Return the describing function of a ball on the stable part of the manifold, as a function of B."""
    r, chart = rho(kappa), charts(kappa)[ASYMMETRIC]
    squared = np.linspace(0.0, _LARGEST_SQUARED, _NODES)
    skewed = np.abs(chart.z(squared) / chart.beta(squared))
    even = np.linspace(B_min(r), skewed[0], _NODES)[:-1]
    C = C_of_B(even, r)[1]
    B = np.concatenate([even, skewed])
    N = np.concatenate([FIRST_HARMONIC * C / (1 - (1 + 1j * r) * C), chart.n(squared) / chart.z(squared)])
    return lambda size: np.interp(size, B, N)


def relax(system, cycles: int, settle: int, start=(1.0, 1.0), forces=None) -> Relaxation:
    """Follow the slow flow for `cycles` forcing periods after a transient of `settle` periods.

    start: initial complex amplitudes b_i = B_i exp(-i psi_i) of both modules. Both balls start in resonance.
    forces: pairs (f10_hat, f20_hat) that replace the forces of the system, shape (..., 2). Each pair is followed
    separately.
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
    return Relaxation(states.mean(axis=0), sizes.max(axis=0))


def lost_at(system, point) -> float:
    """Multiply both forces by a falling factor; return the factor at which a module leaves resonance.

    The fixed point `point` has one symmetric and one asymmetric module. The symmetric module leaves resonance when its
    amplitude C has fallen to the fold of the manifold. The factor decreases from 1. If no such factor above 0.5 is
    found, return nan.
    """
    symmetric = np.flatnonzero(~point.asymmetric & np.isfinite(point.C))
    if len(symmetric) != 1 or not point.asymmetric.any():
        return np.nan
    (symmetric,) = symmetric

    fold, chart = C_min(rho(system.kappa)), charts(system.kappa)[point.charts[symmetric]]

    def conditions(factor):
        return Balance(system.with_(f10_hat=factor * system.f10_hat, f20_hat=factor * system.f20_hat), point.charts)

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
