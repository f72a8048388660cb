"""Checks of what the chapter says of balls as absorbers: efficiency, shocks, the best design, what can be harvested."""

import math

import numpy as np

from vibroimpact.absorbers.decay import decay_time
from vibroimpact.absorbers.references import tuned, without_balls
from vibroimpact.absorbers.tuning import den_hartog
from vibroimpact.claims.finding import Finding
from vibroimpact.exact.engine.ensemble import ensemble
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.orbits.search import orbits
from vibroimpact.regimes.classification import starts

CHECKS = ("efficient", "absorbs_rapidly", "suppresses_shocks", "can_be_optimised", "modulation_favours_harvesting")
IMPULSES = np.geomspace(0.5, 20.0, 13)
"""Velocities that a shock gives to box 1, in units of L omega_10; the first bring no ball to a wall."""
FAINT = 1e-3
"""One after which the boxes move as without balls."""
SWINGS = 3
"""Cycles within which the largest swing after a shock is over."""
NOTICED = 0.99
"""What is called shorter, or lower, is so by a hundredth at least."""
STARTS, SEED, CYCLES, SETTLE = 17, 2, 700, 200
"""Of the modulated response; rest, the first start, is left out: from there one ball may stay idle."""


def efficient(evidence):
    """Peaks over a band of frequencies, at the best clearance of those tried, against those of linear systems."""
    peaks = evidence.absorber.query("quantity == 'peak'").set_index("who")
    balls, best = peaks.loc["balls"], peaks.loc["balls, best kappa"]
    parts = {
        "peak without balls at least halved": balls["of_without"] <= 0.5,
        "lower than with the balls fixed": balls["value"] < peaks.loc["balls fixed", "value"],
        "no higher than with linear absorbers of the same mass": balls["of_absorbers"] <= 1,
    }
    numbers = {"part of the peak without balls": balls["of_without"], "of linear absorbers": balls["of_absorbers"]}
    at_best = {"the best kappa": best["kappa"], "without balls, there": best["of_without"]}
    return Finding(parts, numbers | at_best | {"of linear absorbers, there": best["of_absorbers"]})


def absorbs_rapidly(evidence):
    """After the shock that balls take best: what the impacts take, and how soon a tenth of the energy is left."""
    system, times = evidence.system, _times(evidence.system)
    impulse, soonest = IMPULSES[np.argmin(times)], min(times)
    run = simulate(_free(system), _struck(impulse), math.ceil(soonest / system.period))
    share = run.energy.impacts.sum() / (0.5 * impulse**2)
    without, absorbers = (one.decay_time() for one in (without_balls(system), tuned(system, den_hartog(system))))
    parts = {
        "impacts take most of the energy": share > 0.5,
        "twice as soon as without balls": soonest <= without / 2,
        "as soon as with linear absorbers of the same mass": soonest <= absorbers,
    }
    numbers = {"share of the impacts": share, "impulse": impulse, "time with balls": soonest}
    return Finding(parts, numbers | {"without balls": without, "with linear absorbers": absorbers})


def suppresses_shocks(evidence):
    """Over shocks from weak to strong: time until a tenth of the energy is left, and the largest swing per impulse."""
    system = evidence.system
    times = np.array(_times(system)) / without_balls(system).decay_time()
    shocks = np.array([FAINT, *IMPULSES])
    runs = ensemble(_free(system), [_struck(shock) for shock in shocks], SWINGS)
    swings = runs["largest"][:, 0] / shocks
    swings, met = swings[1:] / swings[0], runs["impacts"][1:].any(axis=1)
    parts = {
        "felt for a shorter time, if a ball meets a wall": met.any() and (times[met] < NOTICED).all(),
        "with a lower swing, if a ball meets a wall": met.any() and (swings[met] < NOTICED).all(),
        "however weak the shock is": (times < NOTICED).all(),
    }
    numbers = {"impulses": IMPULSES, "time, of that without balls": times, "swing, of that without balls": swings}
    return Finding(parts, numbers)


def _times(system):
    return [decay_time(system, impulse) for impulse in IMPULSES]


def _free(system):
    return system.with_(f10_hat=0.0, f20_hat=0.0)


def _struck(impulse):
    """At rest, box 1 with the velocity of an impulse."""
    return np.array([0.0, 0.0, 0.0, 0.0, impulse, 0.0, 0.0, 0.0])


def can_be_optimised(evidence):
    """Whether a clearance and a restitution coefficient are best, none of them the last that was tried."""
    clearance, design = (_per_force(table) for table in (evidence.clearance, evidence.design))
    best = design.loc[design["ratio"].idxmin()]
    own = clearance["f10_hat"].sub(evidence.system.f10_hat).abs().idxmin()
    found = evidence.absorber.query("quantity == 'peak'").set_index("who")["regime"]
    parts = {
        "by the clearance": _inside(clearance, "f10_hat"),
        "by the restitution coefficient": _inside(design, "kappa"),
        "to a lower peak than at the chapter's": best["ratio"] < clearance.loc[own, "ratio"],
    }
    numbers = {"best kappa": best["kappa"], "of those from": design["kappa"].min(), "to": design["kappa"].max()}
    numbers |= {"best forces, in place of the clearance": best["f10_hat"]}
    numbers |= {"peak, of the chapter's": best["ratio"] / clearance.loc[own, "ratio"]}
    return Finding(parts, numbers | {"regime there": found["balls, best kappa"], "at its own kappa": found["balls"]})


def _per_force(table):
    return table.assign(ratio=table["peak"] / table["f10_hat"])


def _inside(table, name):
    """Whether the lowest peak is at neither end of what was tried."""
    return table[name].min() < table.loc[table["ratio"].idxmin(), name] < table[name].max()


def modulation_favours_harvesting(evidence, case):
    """What the impacts take in the modulated response, against the 1:1 responses at the same forces."""
    system = evidence.systems[case]
    runs = ensemble(system, starts(STARTS, SEED)[1:], CYCLES, settle=SETTLE, energy=True)["energy"]
    taken, given = (runs[name].sum(axis=1) / (CYCLES - SETTLE) for name in ("impacts", "work"))
    periodic = [simulate(system, orbit.state, 1).energy for orbit in orbits(system) if orbit.admissible]
    power = max(energy.impacts.sum() for energy in periodic)
    share = max(energy.impact_share for energy in periodic)
    parts = {
        "impacts take more in a cycle": _least(taken) > power,
        "and a larger share of the input": _least(taken / given) > share,
    }
    numbers = {"energy a cycle, modulated": taken.mean(), "in the 1:1 response": power}
    return Finding(parts, numbers | {"share of the input, modulated": (taken / given).mean(), "share, 1:1": share})


def _least(values):
    """Their mean less three times its standard error."""
    return values.mean() - 3 * values.std(ddof=1) / math.sqrt(len(values))
