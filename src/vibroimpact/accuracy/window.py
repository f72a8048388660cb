"""Simulate a motion and return the window after its transient, in float64 or in the reference arithmetic."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.system import System
from vibroimpact.system.extras import need
from vibroimpact.system.state import KINDS, NAMES

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the dependency check)

ARITHMETICS = "float64", "reference"
DIGITS = 40
SPAN = ("transient_cycles", "window_cycles", "samples_per_cycle")


@dataclass(frozen=True, eq=False)
class Window:
    """Window of a simulation.

    samples: columns tau and the state, at evenly spaced times, both ends included. events: columns tau, module, wall,
    kind and the state just after the event. strobe: columns as in samples, at the start of every forcing cycle of the
    whole run and at its end. trust: validation metadata of the run.
    """

    samples: pd.DataFrame
    events: pd.DataFrame
    strobe: pd.DataFrame
    trust: dict


def window(system: System, settings: dict) -> Window:
    """Simulate a case and return its window.

    Parameters
    ----------
    system : System
        Dimensionless parameters.
    settings : dict
        Keys initial_state (8,); transient_cycles, before the window; window_cycles; samples_per_cycle; model, "float64"
        or "reference". The reference uses `digits` decimal digits, by default DIGITS, doubled until two runs agree.

    Raises
    ------
    ValueError
        If the model is unknown.
    """
    cycles = settings["transient_cycles"] + settings["window_cycles"]
    starts = np.arange(settings["transient_cycles"]) * system.period
    times = window_times(system.period, *(settings[name] for name in SPAN))
    run, trust = _integrate(system, settings, cycles, np.concatenate([starts, times]))
    samples, every = run.samples[len(starts) :], slice(None, None, settings["samples_per_cycle"])
    return Window(
        samples=_states(times, samples),
        events=_events(run.events[run.events["tau"] >= times[0]]),
        strobe=_states(
            np.concatenate([starts, times[every]]), np.concatenate([run.samples[: len(starts)], samples[every]])
        ),
        trust=trust,
    )


def window_times(period: float, transient_cycles: int, window_cycles: int, samples_per_cycle: int) -> np.ndarray:
    """Return the sample times of the window, both ends included, at the same phases in every cycle."""
    return (transient_cycles + np.arange(window_cycles * samples_per_cycle + 1) / samples_per_cycle) * period


def _integrate(system, settings, cycles, times):
    """Return the run and its validation metadata."""
    if settings["model"] not in ARITHMETICS:
        raise ValueError(f"model: {settings['model']!r} is not {' or '.join(ARITHMETICS)}")
    if settings["model"] == "float64":
        run = simulate(system, settings["initial_state"], cycles, sample_times=times)
        certificate = {name: value for name, value in vars(run.certificate).items() if np.isfinite(value)}
        return run, {"method": "float64", "certificate": certificate}
    from vibroimpact.accuracy.reference.run import proven_run  # loads packages that float64 runs do not need

    proof = proven_run(
        system,
        settings["initial_state"],
        cycles,
        digits=settings.get("digits", DIGITS),
        sample_times=times,
        exact_floats=False,
    )
    digits = [proof.coarse.digits, proof.run.digits]
    return proof.run, {"method": "arbitrary precision", "digits": digits, "agreement": proof.agreement}


def _states(times, states):
    return pd.DataFrame(np.column_stack([times, states]), columns=["tau", *NAMES])


def _events(events):
    table = pd.DataFrame({name: events[name] for name in ("tau", "module", "wall")})
    table["kind"] = [KINDS[kind] for kind in events["kind"]]
    table[list(NAMES)] = events["state"]
    return table
