"""Compute and draw the error and the run time of each model of each figure of the chapter."""

from importlib import import_module

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from vibroimpact.accuracy.model_choice import CHOICES
from vibroimpact.accuracy.timing import interleaved
from vibroimpact.accuracy.window import Window, window
from vibroimpact.exact.measures import modulation
from vibroimpact.exact.measures.periodicity import samples_per_cycle
from vibroimpact.figures.plotting import simulated
from vibroimpact.figures.plotting.style import (
    BLACK,
    DOUBLE_COLUMN,
    LEVEL,
    LIGHT_GREY,
    heading,
    new_figure,
    styled,
)
from vibroimpact.system import System
from vibroimpact.system.state import NAMES
from vibroimpact.theory.fixed_points.table import fixed_point_table

SPEC = {
    "title": "Error against run time of the models of each figure",
    "caption": "Largest error in percent of the axis (a) and run time (b) of each model of each figure. Filled: the "
        "model in use, by default the cheapest below the tolerance (dotted). Errors are differences from the exact "
        "orbits or, for simulations, from a run in arbitrary precision; for chaotic motions, statistics of bursts "
        "are compared. Grey lane: the reference itself, and errors below 0.001 %.",
    "alt": "Two panels with one row per model, grouped by figure from 10.6 to 10.11: errors and run times on "
        "logarithmic axes. The error of the slow flow is 4 to 6 %, with the first-order term some tenths of a per "
        "cent. In double precision, the steady motion of figure 10.8 is in the grey lane, the chaotic one of 10.11 "
        "above the tolerance.",
    "method": "each figure is computed with each of its models; the plotted quantities are compared",
    "file": "results/accuracy/models.csv",
    "columns": {
        "figure": {"meaning": "name of the figure", "unit": "text"},
        "model": {"meaning": "model of the figure, in ascending order of cost", "unit": "text", "values": ["slow_flow",
            "exact_orbit", "second_term", "float64", "reference"]},
        "compared_with": {"meaning": "reference of the error", "unit": "text", "values": ["exact_orbit",
            "reference", "statistics of bursts"]},
        "error": {"meaning": "largest error of a plotted quantity over the range of its axis; infinite if the model "
            "gives other motions", "unit": "per cent", "infinite": True},
        "tolerance": {"meaning": "largest error allowed for the figure", "unit": "per cent"},
        "seconds": {"meaning": "run time to compute the figure, without drawing; transients in arbitrary precision are "
            "extrapolated from the time per forcing period", "unit": "seconds"},
        "in_use": {"meaning": "True if the figure is drawn with this model", "unit": "true or false"},
    },
}  # fmt: skip

TOLERANCE = {"fixed_points": 10.0, "theoretical_response": 10.0, "simulation": 0.5}
"""Largest error allowed in a figure [percent of the axis], keyed by its notebook. For the theory it is epsilon = 10 %,
the order of magnitude of the theory's error; for a simulation it is about the width of a line. In a chaotic window,
rounding alone changes the statistics by more than this tolerance (4 % in figure 10.11); different processors would draw
different figures."""
COMPARED = 120
"""Largest number of forcing periods over which simulations are compared."""
ERROR_MIN, ERROR_MAX = 1e-3, 100.0
"""Smallest and largest error [percent] that is drawn to scale."""
AXIS_MIN, LANE_ERROR = 1e-5, 1e-4
"""Lower end of the axis, and position of errors below ERROR_MIN, such as the error 0 of the reference."""
GAP = 0.6
"""Space between the rows of two figures, in rows."""
MARK = {"color": BLACK, "marker": "o", "markersize": 5}
KEY = "model in use", "other model", "tolerance", "less than 0.001 %"


def compute(scenes: dict, seconds: float) -> pd.DataFrame:
    """Return the errors and run times of all models of each figure.

    Parameters
    ----------
    scenes : dict
        One dict per figure, keyed by the name of the figure. The dict of a figure has five keys: `module` (name of the
        Python module), `notebook` (name of the notebook), `model` (name of the model in use), `system` (parameters) and
        `settings` (of the figure or of the simulation).
    seconds : float
        Time [s] for which each run is repeated to measure the run time.

    Returns the columns of SPEC.
    """
    rows = []
    for figure, scene in scenes.items():
        notebook, module = scene["notebook"], import_module(scene["module"])
        measured = _simulations if notebook == "simulation" else _motions
        found = measured(module, System(**scene["system"]), scene["settings"], CHOICES[notebook], seconds)
        rows += [[figure, *row[:3], TOLERANCE[notebook], row[3], row[0] == scene["model"]] for row in found]
    return pd.DataFrame(rows, columns=[*SPEC["columns"]])


def _motions(module, system, settings, models, seconds):
    """Yield one tuple per model: model, name of the reference, error [percent], run time [s].

    module: Python module of a figure that shows fixed points or a theoretical response.
    """

    def made(model):
        try:
            return module.compute(system, fixed_point_table("", system), **settings, model=model)
        except ValueError:  # the model gives no motion for this figure
            return None

    tables = {model: made(model) for model in models}
    timed = interleaved([lambda model=model: made(model) for model in models], seconds)
    for (model, table), (_, cost) in zip(tables.items(), timed, strict=True):
        yield model, "exact_orbit", largest_error(table, tables["exact_orbit"]), cost


def _simulations(module, system, settings, models, seconds):
    """Return one tuple per model: model, name of the reference, error [percent], run time [s].

    The function is for figures that show a simulated motion.
    """
    whole = window(system, settings | {"model": "float64"})
    # The compared runs start after the transient, since the transient takes a minute in arbitrary precision.
    part = settings | {"initial_state": whole.samples[list(NAMES)].iloc[0].tolist(), "transient_cycles": 0}
    part["window_cycles"] = min(part["window_cycles"], COMPARED)
    run = window(system, part | {"model": "float64"})
    ((_, fast),) = interleaved([lambda: window(system, settings | {"model": "float64"})], seconds)
    ((reference, slow),) = interleaved([lambda: window(system, part | {"model": "reference"})], seconds)
    if transient := settings["transient_cycles"]:
        # The run time of the transient in arbitrary precision is estimated from a run with few samples per period.
        few = part | {"model": "reference", "samples_per_cycle": 8}
        slow += interleaved([lambda: window(system, few)], seconds)[0][1] * transient / part["window_cycles"]
    chaotic = "horizon" in run.trust["certificate"]
    if chaotic:
        of_run, of_reference = (burst_statistics(system, one, reference) for one in (run, reference))
        error = float(np.abs(of_run - of_reference).max())
    else:
        error = largest_error(*(simulated.compute(system, one.samples, one.events) for one in (run, reference)))
    compared_with = "statistics of bursts" if chaotic else "reference"
    return zip(models, [compared_with] * 2, (error, 0.0), (fast, slow), strict=True)


def largest_error(table, reference) -> float:
    """Return the largest difference between two tables of a figure [percent].

    The compared quantities are the points P_i and the curves. Curves are compared at the times that are in both tables.
    A difference in a column is divided by the range of this column in `reference`. Each panel has its own range. The
    result is inf if a table is None, or if the tables contain different points P_i.
    """
    if table is None or reference is None:
        return np.inf
    errors = [0.0]
    for column in {"C", "B", "value"} & {*table}:
        one, other = _plotted(table, column), _plotted(reference, column)
        if column != "value" and not one.index.equals(other.index):
            return np.inf
        spans = reference.groupby("panel")[column].agg(np.ptp)
        apart = (one - other).abs().groupby("panel").max() / spans
        errors.append(100 * apart.max())
    return float(np.nanmax(errors))


def _plotted(table, column):
    """Return one column of a table as a pandas Series, with only the rows that `largest_error` compares.

    The index is (panel, series) for the points P_i, and (panel, series, tau) for curves.
    """
    rows = table[table["series"].str.startswith("P_")] if column != "value" else table.dropna(subset="value")
    return rows.set_index(["panel", "series", *(["tau"] if column == "value" else [])])[column]


def burst_statistics(system, run: Window, reference: Window) -> np.ndarray:
    """Return four statistics of a run with bursts of resonance [percent].

    The first is the share of the time in which ball 2 is in a burst. The other three are the smallest, mean and largest
    amplitude of X_2, divided by the range of X_2 in `reference`. Each forcing period has one amplitude.
    """
    impacts = run.events[(run.events["module"] == 2) & (run.events["kind"] == "impact")]
    bursts = modulation.bursts(impacts["tau"], impacts["wall"], system.period)
    per_cycle = samples_per_cycle(run.samples["tau"].to_numpy(), system.period)
    amplitudes = modulation.cycle_amplitudes(run.samples["X2"], per_cycle)
    share = np.diff(bursts, axis=1).sum() / np.ptp(run.samples["tau"])
    extremes = np.array([amplitudes.min(), amplitudes.mean(), amplitudes.max()])
    return 100 * np.array([share, *extremes / np.ptp(reference.samples["X2"])])


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw errors and run times of the table of `compute`, with filled markers for the models in use."""
    starts = table["figure"].ne(table["figure"].shift())
    places = (np.arange(len(table)) + GAP * (starts.cumsum() - 1)).to_numpy()
    figure = new_figure(DOUBLE_COLUMN, 5.5 * places[-1] + 32.0)
    errors, times = figure.subplots(1, 2, sharey=True)
    errors.axvspan(AXIS_MIN, ERROR_MIN, color=LIGHT_GREY, linewidth=0, zorder=0)
    for row, place in zip(table.itertuples(), places, strict=True):
        mark = MARK | {"markerfacecolor": BLACK if row.in_use else "white"}
        errors.vlines(row.tolerance, place - 0.5, place + 0.5, **LEVEL)
        errors.plot(LANE_ERROR if row.error < ERROR_MIN else min(row.error, ERROR_MAX), place, **mark)
        times.plot(row.seconds, place, **mark)
        times.annotate(
            f"{float(f'{row.seconds:.2g}'):g}", (row.seconds, place), (6, 0), textcoords="offset points", va="center"
        )
    models = table["model"].replace("second_term", "with first-order term").str.replace("_", " ")
    names = table["figure"].str.replace("^fig10_0?", "Fig. 10.", regex=True)
    errors.set_yticks(places, models.where(~starts, names + ":   " + models))
    errors.set(
        xscale="log", xlim=(AXIS_MIN, 2 * ERROR_MAX), ylim=(places[-1] + 0.7, -0.7), xlabel="error, % of the axis range"
    )
    errors.set_xticks(10.0 ** np.arange(-3, 3), ["0.001", "0.01", "0.1", "1", "10", "100"])
    times.set(xscale="log", xlim=(table["seconds"].min() / 3, table["seconds"].max() * 6), xlabel="run time [s]")
    for axes, letter, words in ((errors, "a", "error"), (times, "b", "run time")):
        axes.minorticks_off()
        axes.tick_params(axis="y", length=0)
        heading(axes, letter, words)
    handles = [Line2D([], [], linestyle="none", **MARK | {"markerfacecolor": face}) for face in (BLACK, "white")]
    handles += [Line2D([], [], **LEVEL), Patch(color=LIGHT_GREY)]
    figure.legend(handles, KEY, loc="outside lower center", ncols=len(KEY))
    return figure
