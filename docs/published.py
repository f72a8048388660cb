"""Recompute results of other authors with vibroimpact; each row of published.md names one of these functions."""

import numpy as np
from scipy.optimize import brentq

import vibroimpact as vi


def wall(F, omega, c, kappa):
    """Return an oscillator that hits a wall. A ball of mass 1e12 acts as the wall. Lengths are divided by L = 50."""
    return vi.PhysicalSystem.single(M=1, m=1e12, k=1, c=c, F=F, L=50, kappa=kappa, omega=omega).dimensionless()


def speeds(orbit):
    """Return the speeds at which the oscillator hits the wall."""
    return 50 * abs(orbit.run.events["state"][:, 4]) / orbit.system.kappa


def sector(r, clearance=0.3):
    """Return one sector of the chain of Weidemann et al. (2025). All sectors move in phase, without coupling force."""
    given = dict(M=0.98, m=0.02, k=1, c=0.002, F=0.002, kappa=0.8)
    return vi.PhysicalSystem.single(**given, L=clearance, omega=r).dimensionless()


def resonant(system):
    """Return the admissible symmetric orbits with two impacts per period."""
    return [orbit for orbit in vi.orbits(system) if orbit.symmetric and orbit.admissible]


def flight(stiffness, x, V):
    """Return the duration of a flight and X at its end. The flight starts with X = x and the ball speed V."""
    cell = vi.PhysicalSystem.single(M=1, m=0.3, k=stiffness, c=0, F=0, kappa=1 - 1e-12).dimensionless()
    v = V / stiffness**0.5  # dimensionless speed; tau is the time multiplied by stiffness**0.5
    impact = vi.simulate(cell, [x, x - 1, 0, 0, -0.3 * v, v, 0, 0], 9).events[0]
    return impact["tau"] / stiffness**0.5, impact["state"][0]


def half_period(stiffness, V, low, high):
    """Return half the period of a symmetric free motion. X is in [low, high] at the impacts on the wall W = 1."""
    x = brentq(lambda x: flight(stiffness, x, V)[1] + x, low, high)
    return flight(stiffness, x, V)[0]


def damper():
    machine = vi.PhysicalSystem.single(M=1, m=0.3, k=1, c=0, F=0, kappa=1 - 1e-12).dimensionless()
    low, medium, high = (vi.simulate(machine, [0] * 5 + [v, 0, 0], 4).events["tau"] for v in (-1, -2, -10))
    return [*low[low < 20], sum(low < 20), sum(medium < 20), sum(high < 10)]


def ball():
    return [V * half_period(1, V, low, low + 0.2) / 2 for V, low in ((0.5, 0.3), (2.0, 0.2))]


def chain():
    branches = (0.655, 0.072, -0.193)
    return [np.pi / half_period(2, 0.1 / 0.3, x - 0.001, x + 0.001) for x in branches]


def stop():
    start = np.array([0.5, -49, 0, 0, 0, 0, 0, 0]) / 50
    orbit = vi.periodic_orbit(wall(1, 1, 0.1, 0.8), vi.simulate(wall(1, 1, 0.1, 0.8), start, 200).final)
    (impact,) = orbit.run.events
    free = vi.periodic_orbit(wall(0.05, 1, 0.1, 0.8), start)
    return [(impact["tau"] - np.pi / 2) % (2 * np.pi), 50 * impact["state"][4], 0.05 / (50 * free.amplitudes[0])]


def one_in_n():
    starts = np.array([[-1.58, -49.8, 0, 0, -1.5, 0, 0, 0], [-0.39, -49.8, 0, 0, -1.21, 0, 0, 0]]) / 50
    orbits = [vi.periodic_orbit(wall(1, 3.7, 0, 0.8), start, 2) for start in starts]
    for n in (1, 2, 5, 10):
        system, rest = wall(1, 2 * n, 0, 0.4), [0, 0.001 / 50 - 1, 0, 0, 0, 0, 0, 0]
        orbits.append(vi.periodic_orbit(system, vi.simulate(system, rest, 60 * n).final, n))
    return [speed for orbit in orbits for speed in speeds(orbit)]


def doubling():
    starts = np.array([[-0.065, -49, 0, 0, 0.755, 0, 0, 0], [0.05, -49, 0, 0, 0.47, 0, 0, 0]]) / 50
    systems = [wall(F, 0.81, 0.04, 0.9) for F in (0.3475333988945534, 0.36)]
    at, off = (vi.periodic_orbit(system, start, 2) for system, start in zip(systems, starts, strict=True))
    return [*speeds(at), *at.multipliers[2:].real, *speeds(off), off.multipliers[2].real]


def upper():
    return [max(resonant(sector(r)), key=lambda orbit: orbit.C[0]) for r in (0.98, 0.9885, 0.99, 0.992)]


def sectors():
    return [0.98 * orbit.C[0] for orbit in upper()]


def multipliers():
    return [float(abs(vi.prove(orbit).multipliers[0]).mid()) for orbit in upper()]


def clearance():
    low, high = 0.33, 0.34
    while high - low > 1e-5:
        middle = (low + high) / 2
        low, high = (middle, high) if resonant(sector(0.98846, middle)) else (low, middle)
    return [low]


def masri():
    machine = vi.PhysicalSystem.single(M=1, m=0.1, k=1, c=0.02, F=1, L=10, kappa=0.8).dimensionless()
    (motion,) = (orbit for orbit in vi.orbits(machine) if orbit.admissible)
    orbit = vi.periodic_orbit(machine, motion.state)
    return [10 * motion.ball_speeds[0, 0], 10 * orbit.amplitudes[0], abs(orbit.multipliers[0])]


def chatter():
    spring = vi.PhysicalSystem.single(M=1e-3, m=1e12, k=100, c=0, F=0, kappa=0.9).dimensionless()
    # The floor is at X = 9.81e-5, above the equilibrium X = 0 of the mass.
    run = vi.simulate(spring, [1 + 9.81e-5, 1 + 9.81e-5, 0, 0, 0, 0, 0, 0], 44)
    times = run.events["tau"] / 1e5**0.5
    return [*times[[0, 1, 9, 49, 99, 149]], times[-1]]
