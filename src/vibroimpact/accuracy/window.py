"""Simulate a motion and return the window after its transient, in float64 or in the reference arithmetic."""

from dataclasses import dataclass

import numpy as np

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.frames import of_run
from vibroimpact.system import System
from vibroimpact.system.extras import need
from vibroimpact.system.state import NAMES

need("figures", "pandas")

import pandas as pd  # noqa: E402 (after the dependency check)

ARITHMETICS = "float64", "reference"
DIGITS = 40


@dataclass(frozen=True, eq=False)
class Window:
    """Results of a simulation in the window, which is the part after the transient.

    samples: tau and the state at evenly spaced times of the window.
    events: impacts, sticks and releases in the window.
    strobe: tau and the state at the start of every forcing cycle of the whole run, and at the end of the run.
    trust: method of the simulation, and evidence of its accuracy.
    """

    samples: pd.DataFrame
    events: pd.DataFrame
    strobe: pd.DataFrame
    trust: dict


def window(system: System, settings: dict) -> Window:
    """Simulate a case and return its window.

    settings: dictionary with the following keys.

    - initial_state: initial state, shape (8,).
    - transient_cycles: number of forcing cycles before the window.
    - window_cycles: number of forcing cycles in the window.
    - samples_per_cycle: number of samples per forcing cycle.
    - model: "float64" or "reference".
    - digits: number of decimal digits of the first reference run (optional).

    Raises
    ------
    ValueError
        If the model is unknown.
    """
    cycles = settings["transient_cycles"] + settings["window_cycles"]
    starts = np.arange(settings["transient_cycles"]) * system.period
    per_cycle = settings["samples_per_cycle"]
    phases = np.arange(settings["window_cycles"] * per_cycle + 1) / per_cycle  # every cycle has the same sample phases
    times = (settings["transient_cycles"] + phases) * system.period
    run, trust = _integrate(system, settings, cycles, np.concatenate([starts, times]))
    states = pd.DataFrame(np.column_stack([[*starts, *times], run.samples]), columns=["tau", *NAMES])
    samples, events = states[len(starts) :].reset_index(drop=True), of_run(run)
    return Window(
        samples=samples,
        events=events[events["tau"] >= times[0]].reset_index(drop=True),
        strobe=pd.concat([states[: len(starts)], samples[::per_cycle]], ignore_index=True),
        trust=trust,
    )


def _integrate(system, settings, cycles, times):
    """Return the run and the value of `Window.trust`."""
    if settings["model"] not in ARITHMETICS:
        raise ValueError(f"model: {settings['model']!r} should be {' or '.join(ARITHMETICS)}")
    if settings["model"] == "float64":
        run = simulate(system, settings["initial_state"], cycles, sample_times=times)
        certificate = {name: value for name, value in vars(run.certificate).items() if np.isfinite(value)}
        return run, {"method": "float64", "certificate": certificate}
    from vibroimpact.accuracy.reference.run import proven_run  # needs packages that float64 runs do not use

    options = {"digits": settings.get("digits", DIGITS), "sample_times": times, "exact_floats": False}
    proof = proven_run(system, settings["initial_state"], cycles, **options)
    digits = [proof.coarse.digits, proof.run.digits]
    return proof.run, {"method": "arbitrary precision", "digits": digits, "agreement": proof.agreement}
