"""Undamped boxes without force or coupling, one or both with its ball moving, kappa next to 1: nothing is forgotten.

Its motion in closed form with 45 digits: the gap is monotone between the times at which box and ball are equally fast.
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
    """The system: two boxes without coupling, of which the second may be damped."""
    return vi.System(
        epsilon=epsilon, kappa=kappa, alpha12_hat=0, gamma1_hat=0, gamma2_hat=gamma2_hat, gamma12_hat=0, sigma20_hat=0,
        sigma_e_hat=sigma_e_hat, f10_hat=0, f20_hat=0,
    )  # fmt: skip


def motion(system, start, cycles):
    """Number of impacts and final state [X1, Y1, X1', Y1'] (arb) from a start (4,) off the walls."""
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
    """Time of the next impact to float accuracy and its wall, 0 if there is none until just after the end."""

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
    """Time of an impact by Newton's method."""
    t = arb(guess)
    for _ in range(12):
        s, c = t.sin_cos()
        step = ((x * c + v * s - y - u * t - wall) / (v * c - x * s - u)).mid()
        t = (t - step).mid()
        if abs(step) < 1e-22:
            return t
    raise ArithmeticError("Newton's method has not converged")


def judged(system, start, cycles, second=(0, 0, 0, 0), many=False):
    """True error of the final state over the told one of a decided run, else None; its events must be the true ones.

    second: start of box 2 and its ball, which move as those of box 1 do in an undamped system; many: judge the state
    that an ensemble ends in.
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


def true_over_told(genes, most_impacts=30_000, many=False):
    """`judged` for genes (GENES,) between 0 and 1; None of a run that is not decided, or long."""
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
        return judged(system, starts[0], cycles, starts[1], many)
    except (ValueError, ArithmeticError):  # such a system resonates, or the run has too many events
        return None
