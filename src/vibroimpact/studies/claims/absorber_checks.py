"""Checks of the chapter's claims on balls as absorbers: efficiency, shocks, the best design."""

import math

import numpy as np

from vibroimpact.exact.engine.ensemble import ensemble
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.studies.absorbers.decay import decay_time
from vibroimpact.studies.absorbers.references import tuned, without_balls
from vibroimpact.studies.absorbers.tuning import den_hartog
from vibroimpact.studies.claims.finding import Finding

CHECKS = ("efficient", "absorbs_rapidly", "suppresses_shocks", "can_be_optimised")
IMPULSES = np.geomspace(0.5, 20.0, 13)
"""Velocities of box 1 after a shock, in units of L omega_10; at the first ones no ball reaches a wall."""
FAINT = 1e-3
"""A shock after which the boxes move as without balls."""
SWINGS = 3
"""Cycles that contain the largest swing after a shock."""
NOTICED = 0.99
"""Smallest relative difference at which a time counts as shorter, or a swing as lower."""
PATIENCE = 10_000
"""Largest number of forcing periods of a decay."""
HALF = 0.5
"""Share of the energy above which it counts as most of it."""
SURE = 2
"""Number of standard errors by which a peak must be lower than another."""


def efficient(evidence):
    """Compare the peaks over a band, at the best clearance, with those without balls and with fixed balls.

    The chapter cites others and sets no measure of "very efficient": where balls lower the peak, that part is left
    open. How far linear absorbers go is told beside.
    """
    peaks = evidence.absorber.query("quantity == 'peak'").set_index("who")
    balls, best = peaks.loc["balls"], peaks.loc["balls, best kappa"]
    parts = {
        "lower than without balls": balls["value"] + SURE * balls["spread"] < peaks.loc["without balls", "value"],
        "lower than with the balls fixed": balls["value"] + SURE * balls["spread"] < peaks.loc["balls fixed", "value"],
    }
    parts["very efficient, of which the text has no measure"] = None if all(parts.values()) else False
    numbers = {"part of the peak without balls": balls["of_without"], "of linear absorbers": balls["of_absorbers"]}
    numbers |= {"spread, of the peak": balls["spread"] / balls["value"], "the best kappa": best["kappa"]}
    numbers |= {"without balls, there": best["of_without"], "of linear absorbers, there": best["of_absorbers"]}
    return Finding(parts, numbers | {"spread, of the peak there": best["spread"] / best["value"]})


def absorbs_rapidly(evidence):
    """Measure the energy dissipated by impacts, and the time, until a tenth of the energy of a shock is left.

    Shocks that bring no ball to a wall are left out of the parts.
    """
    system, times = evidence.system, _times(evidence.system)
    runs = [
        simulate(_free(system), _struck(impulse), math.ceil(min(time / system.period, PATIENCE)))
        for impulse, time in zip(IMPULSES, times, strict=True)
    ]
    shares = np.array([run.energy.impacts.sum() for run in runs]) / (0.5 * IMPULSES**2)
    met = shares > 0
    without, absorbers = (one.decay_time() for one in (without_balls(system), tuned(system, den_hartog(system))))
    parts = {
        "impacts take most of the energy of some shock": (shares > HALF).any(),
        "of every shock that brings a ball to a wall": met.any() and (shares[met] > HALF).all(),
        "sooner than without balls after each of these": met.any() and (times[met] < NOTICED * without).all(),
    }
    numbers = {"impulses": IMPULSES, "shares of the impacts": shares, "times with balls": times}
    return Finding(parts, numbers | {"without balls": without, "with linear absorbers": absorbers})


def suppresses_shocks(evidence):
    """Measure the time until a tenth of the energy is left, and the largest swing per impulse, over shocks."""
    system = evidence.system
    times = _times(system) / without_balls(system).decay_time()
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
    return np.array([decay_time(system, impulse, cycles=PATIENCE) for impulse in IMPULSES])


def _free(system):
    return system.with_(f10_hat=0.0, f20_hat=0.0)


def _struck(impulse):
    """Return the state at rest with the velocity of an impulse for box 1."""
    return np.array([0.0, 0.0, 0.0, 0.0, impulse, 0.0, 0.0, 0.0])


def can_be_optimised(evidence):
    """Check that peaks are reduced by a clearance inside the range, and by another restitution coefficient.

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
