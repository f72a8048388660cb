"""The motion that a notebook shows: simulated with its own parameters, or read from `inputs`, files of a build.

A file that was made with other parameters than those of the notebook is refused.
"""

import json
from pathlib import Path

import pandas as pd

from vibroimpact import tables
from vibroimpact.accuracy.window import window
from vibroimpact.exact.measures.periodicity import distance_after
from vibroimpact.figures.plotting.case_points import HINT
from vibroimpact.figures.plotting.markdown import EXACTLY
from vibroimpact.studies.regimes.classification import ASYMMETRIC, SYMMETRIC, Regime
from vibroimpact.system import System

SETTLED = 1e-6
"""A periodic motion that changes by more from period to period has not settled yet."""
KINDS = {
    SYMMETRIC: "as the motions of the chapter's theory are",
    ASYMMETRIC: "as no motion of the chapter's theory is",
}


def simulated(case: str, parameters: dict, settings: dict, inputs: dict) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Samples and events of the simulated window of a case, from the files in inputs if they are given.

    Args:
        parameters: of the system, by name.
        settings: of the simulation, see `vibroimpact.accuracy.window.window`.

    Raises:
        ValueError: the files hold another case, or were made with other parameters or settings.
    """
    if inputs:
        made = json.loads(Path(inputs["summary"]).read_text(encoding="utf-8"))
        asked = {"case": case, **parameters, **settings}
        _expect_same_settings({"case": made["case"], **made["system"], **made["settings"]}, asked, inputs["summary"])
        return tables.read(inputs["samples"]), tables.read(inputs["events"])
    made = window(System(**parameters), settings)
    return made.samples, made.events


def exact(regime: Regime, displacements, per_cycle: int, nearness: float) -> str:
    """Return the kind of a simulated motion, and how it agrees with its window, in Markdown.

    Args:
        regime: of the motion in the long run.
        displacements: shape (n, 4), per_cycle times in a forcing period, over the window.
        nearness: a change of the displacements by which a motion may still count as the same.
    """
    kind = KINDS.get(regime.name, "")
    return (
        f"{EXACTLY} this is its own motion, simulated. In the long run it is **{regime.name}**"
        + f"{f', {kind}' if kind else ''}; {repetition(regime.repeats, displacements, per_cycle, nearness)}."
    )


def repetition(repeats: int | None, displacements, per_cycle: int, nearness: float) -> str:
    """Say after how many periods a motion repeats in the long run (None: it does not), and what the window shows.

    A window that disagrees with the long run, before the motion settles or leaves, is said to.
    """
    whole = (len(displacements) - 1) // per_cycle
    changes = {lag: distance_after(displacements, per_cycle, lag) for lag in range(1, whole + 1)}
    if repeats is None:
        near = next((lag for lag in changes if changes[lag] <= nearness and lag <= max(1, whole // 2)), None)
        if near is None:
            return f"it **does not repeat**: {_measured(changes, 1)}"
        return f"it **leaves** what the window shows, where it nearly repeats: {_measured(changes, near)}"
    after = f"**repeats {'every period' if repeats == 1 else f'after {repeats} periods'}**"
    if repeats > whole:
        return f"it {after}, which is longer than the window"
    settled = "" if changes[repeats] <= SETTLED else " once it has settled"
    return f"it {after}{settled}: {_measured(changes, repeats)}"


def _measured(changes, lag):
    return f"in the window it changes after {_periods(lag)} by up to {changes[lag]:.2g}"


def _periods(number):
    return "one period" if number == 1 else f"{number} periods"


def _expect_same_settings(made, asked, path):
    for name in made | asked:
        if made.get(name) != asked.get(name):
            raise ValueError(
                f"inputs: {path} was made with {name} = {made.get(name)}, asked for is {asked.get(name)}; {HINT}"
            )
