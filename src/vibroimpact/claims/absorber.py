"""Checks of what the chapter says of balls as absorbers: efficiency, shocks, the best design."""

import math

import numpy as np

from vibroimpact.absorbers.decay import decay_time
from vibroimpact.absorbers.references import tuned, without_balls
from vibroimpact.absorbers.tuning import den_hartog
from vibroimpact.claims.finding import Finding
from vibroimpact.exact.engine.ensemble import ensemble
from vibroimpact.exact.engine.simulation import simulate

CHECKS = ("efficient", "absorbs_rapidly", "suppresses_shocks", "can_be_optimised")
IMPULSES = np.geomspace(0.5, 20.0, 13)
"""Velocities that a shock gives to box 1, in units of L omega_10; the first bring no ball to a wall."""
FAINT = 1e-3
"""One after which the boxes move as without balls."""
SWINGS = 3
"""Cycles within which the largest swing after a shock is over."""
NOTICED = 0.99
"""A time is called shorter, or a swing lower, from a hundredth on."""
SURE = 2
"""Spreads by which a peak has to be lower than another."""


def efficient(evidence):
    """Peaks over a band of frequencies, at the best clearance of those tried, against those without balls and fixed.

    The chapter cites others and sets no measure of "very efficient"; how far linear absorbers go is told beside.
    """
    peaks = evidence.absorber.query("quantity == 'peak'").set_index("who")
    balls, best = peaks.loc["balls"], peaks.loc["balls, best kappa"]
    parts = {
        "lower than without balls": balls["value"] + SURE * balls["spread"] < peaks.loc["without balls", "value"],
        "lower than with the balls fixed": balls["value"] + SURE * balls["spread"] < peaks.loc["balls fixed", "value"],
    }
    numbers = {"part of the peak without balls": balls["of_without"], "of linear absorbers": balls["of_absorbers"]}
    numbers |= {"spread, of the peak": balls["spread"] / balls["value"], "the best kappa": best["kappa"]}
    numbers |= {"without balls, there": best["of_without"], "of linear absorbers, there": best["of_absorbers"]}
    return Finding(parts, numbers | {"spread, of the peak there": best["spread"] / best["value"]})


def absorbs_rapidly(evidence):
    """After the shock that balls take best: what the impacts take, and how soon a tenth of the energy is left."""
    system, times = evidence.system, _times(evidence.system)
    impulse, soonest = IMPULSES[np.argmin(times)], min(times)
    run = simulate(_free(system), _struck(impulse), math.ceil(soonest / system.period))
    share = run.energy.impacts.sum() / (0.5 * impulse**2)
    without, absorbers = (one.decay_time() for one in (without_balls(system), tuned(system, den_hartog(system))))
    parts = {
        "impacts take most of the energy": share > 0.5,
        "sooner than without balls": soonest < NOTICED * without,
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
    }
    numbers = {"impulses": IMPULSES, "time, of that without balls": times, "swing, of that without balls": swings}
    numbers |= {"a ball meets a wall from": IMPULSES[met].min() if met.any() else None}
    return Finding(parts, numbers)


def _times(system):
    return [decay_time(system, impulse) for impulse in IMPULSES]


def _free(system):
    return system.with_(f10_hat=0.0, f20_hat=0.0)


def _struck(impulse):
    """At rest, box 1 with the velocity of an impulse."""
    return np.array([0.0, 0.0, 0.0, 0.0, impulse, 0.0, 0.0, 0.0])


def can_be_optimised(evidence):
    """Peaks lowered by a clearance inside what was tried, and by another restitution coefficient beyond their spread.

    Both at the clearance that is best for each coefficient, measured again there. Over small coefficients the lowest
    peak is level: which of them is best is left to chance.
    """
    force = evidence.clearance["f10_hat"]
    ratio = evidence.clearance["peak"] / (evidence.system.epsilon * force)
    lowest = evidence.absorber.query("quantity == 'lowest peak'")
    peaks = evidence.absorber.query("quantity == 'peak'").set_index("who")
    balls, best = peaks.loc["balls"], peaks.loc["balls, best kappa"]
    own = ratio[force.sub(evidence.system.f10_hat).abs().idxmin()]
    uncertain = math.hypot(balls["spread"], best["spread"])
    parts = {
        "by the clearance": force.min() < force[ratio.idxmin()] < force.max(),
        "by the restitution coefficient": best["value"] + SURE * uncertain < balls["value"],
        "to a lower peak than at the chapter's": best["value"] + SURE * best["spread"] < own,
    }
    numbers = {"best kappa": best["kappa"], "best forces, in place of the clearance": best["f10_hat"]}
    numbers |= {"kappa": lowest["kappa"].to_list(), "lowest peaks": lowest["value"].to_list()}
    numbers |= {"their spreads": lowest["spread"].to_list()}
    numbers |= {"level up to": evidence.absorber.set_index("quantity").loc["plateau", "value"]}
    numbers |= {"peak, of the chapter's": best["value"] / own}
    return Finding(parts, numbers | {"regime there": best["regime"], "at its own kappa": balls["regime"]})
