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
    """Return samples and events of the motion of a case, from the files in `inputs` or, without files, simulated.

    Files of another case, other parameters or other settings raise ValueError.
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
    """Return a text in Markdown on whether a simulated motion repeats, and on its flight times.

    displacements: in the window, (n, 4), with `per_cycle` samples per forcing period. impacts: in the window, columns
    tau, module, wall.
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
    """Return module and mean flight times [periods] from walls +1 and -1 of each ball that leaves both walls."""
    found = []
    for module, mine in impacts.groupby("module"):
        flown = mine["tau"].diff().shift(-1).groupby(mine["wall"]).mean() / period
        if {1, -1} <= {*flown.dropna().index}:
            found.append((module, flown[1], flown[-1]))
    return found


def repetition(displacements, per_cycle: int) -> str:
    """Return a phrase on how many periods a motion takes to repeat, and on its largest change until then."""
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
