"""Motions of boxes without damping, force or coupling in closed form, with 45 digits.

Restitution is next to 1, so that errors do not decay. One or both balls move. The gap is monotone between the times at
which box and ball have the same velocity, so that no impact is missed.
"""

import math

import numpy as np
from flint import arb, ctx
from scipy.optimize import brentq

import vibroimpact as vi

BITS = 150
GENES = 10
DEFECTS = (2**-53, 2**-52, 3 * 2**-53, 2**-51, 2**-50, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6)  # 1 - kappa


def one_box(epsilon, kappa, sigma_e_hat, gamma2_hat=0.25):
    """Return a system of two boxes without coupling; only the second box may be damped."""
    return vi.System(
        epsilon=epsilon, kappa=kappa, alpha12_hat=0, gamma1_hat=0, gamma2_hat=gamma2_hat, gamma12_hat=0, sigma20_hat=0,
        sigma_e_hat=sigma_e_hat, f10_hat=0, f20_hat=0,
    )  # fmt: skip


def motion(system, start, cycles):
    """Return number of impacts and final state [X1, Y1, X1', Y1'] (arb) for a start (4,) between the walls."""
    with ctx.workprec(BITS):
        epsilon, kappa, impacts, wall = arb(system.epsilon), arb(system.kappa), 0, 0
        impulse = epsilon * (1 + kappa) / (1 + epsilon)
        x, y, v, u = map(arb, start)
        left = 2 * arb.pi() * cycles / arb(system.Omega)
        while True:
            guess, wall = _next_wall(*map(float, (x, y, v, u, left)), wall)
            t = _refined(x, y, v, u, guess, wall) if wall else left
            if not t < left:
                s, c = left.sin_cos()
                return impacts, [x * c + v * s, y + u * left, v * c - x * s, u]
            s, c = t.sin_cos()
            x, v, left = (x * c + v * s).mid(), (v * c - x * s).mid(), (left - t).mid()
            y, relative = x - wall, v - u
            assert wall * relative > 0
            v = (v - impulse * relative).mid()
            u, impacts = (v + kappa * relative).mid(), impacts + 1


def _next_wall(x, y, v, u, left, wall):
    """Return time (to float accuracy) and wall of the next impact; the wall is 0 without an impact before the end."""

    def gap(t):
        return x * math.cos(t) + v * math.sin(t) - y - u * t

    size, last, low, turn = math.hypot(x, v), left + 1e-6, 0.0, 0
    if size > abs(u):
        phase, lag = math.atan2(x, v), math.acos(u / size)
        turns = sorted(angle % (2 * math.pi) for angle in (lag - phase, -lag - phase))
    before = wall or gap(0.0)
    while low < last:
        high = min(last, turns[turn % 2] + 2 * math.pi * (turn // 2)) if size > abs(u) else last
        ahead = 1 if gap(high) > before else -1
        if ahead * gap(high) > 1:
            return brentq(lambda t: (gap(t) if t > low else before) - ahead, low, high, xtol=1e-15), ahead  # noqa: B023
        low, before, turn = high, gap(high), turn + 1
    return 0.0, 0


def _refined(x, y, v, u, guess, wall):
    """Return the time of an impact, refined by Newton's method."""
    t = arb(guess)
    for _ in range(12):
        s, c = t.sin_cos()
        step = ((x * c + v * s - y - u * t - wall) / (v * c - x * s - u)).mid()
        t = (t - step).mid()
        if abs(step) < 1e-22:
            return t
    raise ArithmeticError("Newton's method has not converged")


def run_error_ratio(system, start, cycles, second=(0, 0, 0, 0), many=False):
    """Return the ratio of true to estimated error of the final state; None if the run is undecided.

    The number of impacts must be exact. second: start of box 2 and its ball, which obey the same equations as box 1 in
    an undamped system. many: use the final state of an ensemble.
    """
    starts = np.array([start, second], dtype=float)
    state = [*starts[:, :2].ravel(), *starts[:, 2:].ravel()]
    run = vi.simulate(system, state, cycles)
    if not run.certificate.decided:
        return None
    ended = vi.ensemble(system, state, cycles, settle=cycles)["final"] if many else run.final
    worst, impacts = 0.0, 0
    for module, one in enumerate(starts):
        if one.any():
            count, final = motion(system, one.tolist(), cycles)
            impacts += count
            got = ended.reshape(2, 2, 2)[:, module].ravel()
            worst = max([worst, *(abs(float(exact - arb(float(x)))) for exact, x in zip(final, got, strict=True))])
    assert len(run.events) == impacts, (system, starts, cycles)
    return worst / run.certificate.error


def error_ratio(genes, most_impacts=30_000, many=False):
    """Return `run_error_ratio` for genes (GENES,) between 0 and 1; None if the run is undecided or long."""
    epsilon, omega, size = 10 ** (-2 + 3 * genes[1]), 10 ** (-0.5 + 0.8 * genes[2]), 10 ** (-1 + 2.2 * genes[3])
    starts, both, cycles = [], genes[9] > 0.5, int(10 ** (1.5 + 1.5 * genes[8]))
    for four in (genes[4:8], genes[[6, 4, 5, 7]] if both else 0.5 * np.ones(4)):
        x, v = (size * (2 * gene - 1) * (abs(2 * gene - 1) > 0.3) for gene in four[:2])
        u, gap = size * (2 * four[2] - 1), 0.999 * (2 * four[3] - 1)
        starts.append([x, x - gap, v, u])
        if (abs(u) + math.hypot(x, v)) * cycles * math.pi / omega > most_impacts:
            return None
    try:
        defect = DEFECTS[int(9.999 * genes[0])]
        system = one_box(epsilon, 1 - defect, (omega - 1) / epsilon, 0.0 if both else 0.25)
        return run_error_ratio(system, starts[0], cycles, starts[1], many)
    except (ValueError, ArithmeticError):  # a resonant system, or a run with too many events
        return None
