"""Compute and draw the error of each model against its cost, in one panel per figure of the chapter."""

from importlib import import_module
from string import ascii_lowercase

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
    side_by_side,
    styled,
)
from vibroimpact.system import System
from vibroimpact.system.state import NAMES
from vibroimpact.theory.fixed_points.table import fixed_point_table

SPEC = {
    "title": "Error against run time of the models of each figure",
    "caption": "Largest error of each model of a figure, in percent of the axis, against its run time. The theory is "
        "compared with exact orbits, a simulation with a run in arbitrary precision; for chaotic motions, statistics "
        "of bursts are compared. Filled: the model in use, the cheapest below the tolerance (dotted). Grey lane: the "
        "reference itself, and errors below 0.001 %.",
    "alt": "A panel per figure from 10.6 to 10.11 with error against run time on logarithmic axes and a named mark for "
        "each model. The error of the slow flow is 4 to 6 %, that of the second term some tenths of a per cent. In "
        "double precision, the steady motion of figure 10.8 is in the grey lane, the chaotic one of 10.11 above the "
        "tolerance.",
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
MARK = {"color": BLACK, "marker": "o", "markersize": 5}
KEY = "model in use", "other model", "tolerance", "less than 0.001 %"


def compute(scenes: dict, seconds: float) -> pd.DataFrame:
    """Return the errors and run times of all models of each figure.

    Parameters
    ----------
    scenes : dict
        For each figure, by name: its `module`, `notebook`, `model` in use, parameters of its `system`, and `settings`
        of the figure or of its simulation (see `vibroimpact.accuracy.window.window`).
    seconds : float
        Time [s] for which each run is repeated to measure its run time.

    Returns columns figure, model, compared_with, error, tolerance, seconds, in_use; see SPEC.
    """
    rows = []
    for figure, scene in scenes.items():
        notebook, module = scene["notebook"], import_module(scene["module"])
        measured = _simulations if notebook == "simulation" else _motions
        found = measured(module, System(**scene["system"]), scene["settings"], CHOICES[notebook], seconds)
        rows += [[figure, *row[:3], TOLERANCE[notebook], row[3], row[0] == scene["model"]] for row in found]
    return pd.DataFrame(rows, columns=[*SPEC["columns"]])


def _motions(module, system, settings, models, seconds):
    """Yield, for each model of a figure of fixed points: its name, what it is compared with, its error, its cost [s].

    The cost is the run time of the whole computation from the parameters.
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
    """Return, for each model of a simulated motion: its name, what it is compared with, its error, its cost [s].

    The runs in float64 and in arbitrary precision both start where the transient in float64 ends, since the transient
    takes a minute in arbitrary precision. The run time of the transient in arbitrary precision is estimated from that
    of a window with few samples, in proportion to the number of periods, and added to the cost.
    """
    whole = window(system, settings | {"model": "float64"})
    part = settings | {"initial_state": whole.samples[list(NAMES)].iloc[0].tolist(), "transient_cycles": 0}
    part["window_cycles"] = min(part["window_cycles"], COMPARED)
    run = window(system, part | {"model": "float64"})
    ((_, fast),) = interleaved([lambda: window(system, settings | {"model": "float64"})], seconds)
    ((reference, slow),) = interleaved([lambda: window(system, part | {"model": "reference"})], seconds)
    if transient := settings["transient_cycles"]:
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
    """Return the largest difference between two tables of a figure [percent of the range of the axis].

    Points P_i of planes are compared, and curves at the times that both tables have. The result is inf if a table is
    None, or if the tables show different points.
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
    """Return the values to compare from one column, keyed by panel, series and, for curves, time."""
    rows = table[table["series"].str.startswith("P_")] if column != "value" else table.dropna(subset="value")
    return rows.set_index(["panel", "series", *(["tau"] if column == "value" else [])])[column]


def burst_statistics(system, run: Window, reference: Window) -> np.ndarray:
    """Return statistics of the bursts [percent]: share of time in bursts of ball 2, and amplitudes of X_2.

    X_2 has one amplitude in each forcing period. The smallest, the mean and the largest of these amplitudes are given
    in percent of the range of X_2 in `reference`.
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
    """Draw the table of `compute`: one panel per figure, filled markers for the models in use, the tolerance dotted."""
    scenes = list(dict.fromkeys(table["figure"]))
    columns, rows = side_by_side(len(scenes))
    figure = new_figure(DOUBLE_COLUMN, 44.0 * rows + 14.0)
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    ends = table["seconds"].min() / 3, table["seconds"].max() * 3
    for axes, scene, letter in zip(grid, scenes, ascii_lowercase * len(scenes), strict=False):
        here = table[table["figure"] == scene]
        axes.axhspan(AXIS_MIN, ERROR_MIN, color=LIGHT_GREY, linewidth=0, zorder=0)
        axes.axhline(here["tolerance"].iloc[0], **LEVEL)
        for row in here.itertuples():
            place = row.seconds, LANE_ERROR if row.error < ERROR_MIN else min(row.error, ERROR_MAX)
            axes.plot(*place, **MARK | {"markerfacecolor": BLACK if row.in_use else "white"})
            left = row.seconds > np.sqrt(ends[0] * ends[1])
            aside = {"xytext": (5, 4), "ha": "right", "va": "bottom"} if left else {"xytext": (5, -1), "va": "center"}
            words = f"{row.model.replace('_', ' ')}, {float(f'{row.seconds:.2g}'):g} s"
            axes.annotate(words, place, textcoords="offset points", fontsize=8, **aside)
        axes.set(xscale="log", yscale="log", xlim=ends, ylim=(AXIS_MIN, 1.5 * ERROR_MAX))
        axes.set_yticks(10.0 ** np.arange(-3, 3), ["0.001", "0.01", "0.1", "1", "10", "100"])
        axes.minorticks_off()
        heading(axes, letter, f"Fig. 10.{int(scene[6:])}" if scene.startswith("fig10_") else scene)
    for axes in grid[len(scenes) :]:
        axes.set_axis_off()
    for axes in grid[max(0, len(scenes) - columns) : len(scenes)]:
        axes.set_xlabel("run time [s]")
        axes.tick_params(labelbottom=True)
    for axes in grid[::columns]:
        axes.set_ylabel("error [% of the axis]")
    handles = [Line2D([], [], linestyle="none", **MARK | {"markerfacecolor": face}) for face in (BLACK, "white")]
    handles += [Line2D([], [], **LEVEL), Patch(color=LIGHT_GREY)]
    figure.legend(handles, KEY, loc="outside lower center", ncols=len(KEY))
    return figure
