"""Provide the motion that a notebook shows: simulate it, or read it from files of a build.

The files must belong to the parameters of the notebook.
"""

import json
from pathlib import Path

import pandas as pd

from vibroimpact import tables
from vibroimpact.accuracy.window import window
from vibroimpact.exact.measures.periodicity import distance_after, mirror_distance
from vibroimpact.figures.plotting.case_points import HINT
from vibroimpact.figures.plotting.markdown import EXACTLY, digits
from vibroimpact.system import System

SETTLED, NEAR = 1e-6, 0.02
"""Largest change of a displacement in a motion that repeats, and in one that nearly repeats; the walls are at 1."""
AS_SYMMETRIC = "as the motions of the chapter's theory"
AS_ASYMMETRIC = "as in no motion of the chapter's theory"


def simulated(case: str, parameters: dict, settings: dict, inputs: dict) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return samples and events of the motion of a case.

    Read the samples and events from the files in `inputs`. If `inputs` is empty, simulate the motion. Raise ValueError
    if the files belong to another case, to other parameters or to other settings.
    """
    if inputs:
        summary = json.loads(Path(inputs["summary"]).read_text(encoding="utf-8"))
        given = {"case": summary["case"], **summary["system"], **summary["settings"]}
        own = {"case": case, **parameters, **settings}
        for name in given | own:
            if given.get(name) != own.get(name):
                raise ValueError(
                    f"inputs: {inputs['summary']} was computed with {name} = {given.get(name)}, "
                    f"but the notebook has {name} = {own.get(name)}; {HINT}"
                )
        return tables.read(inputs["samples"]), tables.read(inputs["events"])
    made = window(System(**parameters), settings)
    return made.samples, made.events


def exact(displacements, per_cycle: int, impacts: pd.DataFrame, period: float) -> str:
    """Return a text in Markdown on whether a simulated motion repeats, and on the flight times of its balls.

    displacements: boxes and balls at the sample times, shape (n, 4). per_cycle: number of samples per forcing period.
    impacts: table of the impacts, with columns tau, module, wall. period: forcing period.
    """
    mirror = mirror_distance(displacements, per_cycle)
    kind = f"symmetric, {AS_SYMMETRIC}" if mirror <= SETTLED else f"**asymmetric**, {AS_ASYMMETRIC}"
    lengths = flights(impacts, period)
    flown = "; ".join(
        f"ball {module} flies for {plus:.3f} and {minus:.3f} of a period" for module, plus, minus in lengths
    )
    repeated = repetition(displacements, per_cycle)
    return f"{EXACTLY} this is its own motion, simulated. It {repeated}" + (
        f". It is {kind}: {flown}." if lengths and "**repeats every" in repeated else "."
    )


def flights(impacts: pd.DataFrame, period: float) -> list[tuple[int, float, float]]:
    """Return one tuple per ball: module, mean duration of flights from wall +1, mean duration of flights from wall -1.

    Durations are in forcing periods. A ball without flights from both walls has no tuple.
    """
    found = []
    for module, mine in impacts.groupby("module"):
        flown = mine["tau"].diff().shift(-1).groupby(mine["wall"]).mean() / period
        if {1, -1} <= {*flown.dropna().index}:
            found.append((module, flown[1], flown[-1]))
    return found


def repetition(displacements, per_cycle: int) -> str:
    """Return a phrase on how many forcing periods a motion takes to repeat.

    The phrase also gives the largest change of a displacement over this number of periods. If the motion does not
    even nearly repeat, the phrase gives the largest change over one period.
    """
    longest = max(1, (len(displacements) - 1) // (2 * per_cycle))
    changes = {lag: distance_after(displacements, per_cycle, lag) for lag in range(1, longest + 1)}
    settled, near = (next((n for n in changes if changes[n] <= limit), None) for limit in (SETTLED, NEAR))
    lag = settled or near or 1
    after = "one period" if lag == 1 else f"{lag} periods"
    if settled:
        words = f"**repeats {'every period' if lag == 1 else f'after {after}'}**"
    else:
        words = "**nearly repeats**, but has not settled" if near else "**does not repeat**"
    return f"{words}: in the window it changes after {after} by up to {digits(changes[lag], 2)}"
