"""Companion: modulated and other regimes in numbers, with uncertainties over starts; burst lengths and exponents."""

from string import ascii_lowercase

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from vibroimpact.figures.kit.style import (
    BLACK,
    DOUBLE_COLUMN,
    GREY,
    LEVEL,
    letter_panel,
    new_figure,
    side_by_side,
    styled,
)
from vibroimpact.figures.kit.tables import curve, join, select
from vibroimpact.regimes.classification import REGIMES, STRONGLY_MODULATED
from vibroimpact.regimes.classification import starts as spread_starts
from vibroimpact.regimes.lyapunov import largest_exponent
from vibroimpact.regimes.modulation import (
    PER_CYCLE,
    burst_lengths,
    cycle_amplitudes,
    extreme_depth,
    mean_and_error,
    measures,
    sampled,
    variation,
)
from vibroimpact.regimes.settling import Observation, settle

EXPONENT, SHARE = "largest Lyapunov exponent", "share of starts"
LINES = {1: {"color": BLACK, "linestyle": "-"}, 2: {"color": GREY, "linestyle": (0, (4.5, 1.5))}}
_DOT, _DIAMOND = {"marker": "o", "markersize": 3, "markeredgewidth": 0}, {"marker": "D", "markersize": 4}
DOTS = {
    "spread starts": {"label": "spread starts", "linestyle": "none", "color": GREY, **_DOT},
    "from rest": {"label": "from rest", "linestyle": "none", "color": "white", "markeredgecolor": BLACK, **_DIAMOND},
}
BARS = {"elinewidth": 0.7, "ecolor": GREY, "capsize": 0}
"""Standard errors of single exponents."""
GRID = 0.25
"""The axis of exponents ends at multiples of this, wherever those of chaotic motions lie."""
SHORTEST = 0.5
"""Bursts in cycles: two flights of a quarter of the period."""

SHOWN = 4
"""So many starts of a regime are watched over the longest of the windows."""


def compute(
    systems: dict, starts: int, seed: int, cycles: int, blocks: int, block: int, windows: list[int], observation: dict
) -> dict:
    """Measures of every regime that starts end in, case by case; the start from rest is kept apart.

    Args:
        systems: case -> system. starts: number of spread starts beside the one from rest.
        cycles: window of the measures. blocks, block: of the Lyapunov exponent, so many blocks of so many cycles.
        windows: lengths in cycles over which measures of the envelope are compared.
        observation: arguments of `regimes.settling.Observation`.

    Returns "measures": columns case, start ("rest", "spread"), regime, starts, quantity, module (0: both), mean,
    uncertainty (standard error over starts; binomial for the share of starts; of one start that of its exponent, from
    blocks, and blank else); "windows": columns case, module, cycles, quantity, mean, uncertainty, of strongly modulated
    spread starts; and "csv", what is drawn: burst lengths [cycles] and the part of bursts longer than that, the
    window that no burst outlasts, and the exponent of each start with its standard error, per period.
    """
    tables = [
        _case(case, system, starts, seed, cycles, blocks, block, windows, observation)
        for case, system in systems.items()
    ]
    rows, compared, curves = zip(*tables, strict=True)
    window = curve("bursts", "window", length=float(cycles), longer=np.nan)
    return {
        "measures": pd.concat(rows, ignore_index=True),
        "windows": pd.DataFrame(
            [row for part in compared for row in part],
            columns=["case", "module", "cycles", "quantity", "mean", "uncertainty"],
        ),
        "csv": join([*(part for parts in curves for part in parts), window]),
    }


def _case(case, system, starts, seed, cycles, blocks, block, windows, observation):
    regimes = settle(system, spread_starts(starts + 1, seed), Observation(**observation))
    groups = {("rest", regimes[0].name): regimes[:1]}
    for name in REGIMES:
        if members := [regime for regime in regimes[1:] if regime.name == name]:
            groups["spread", name] = members
    rows, curves, compared = [], [], []
    for (start, name), members in groups.items():
        states = [regime.run.final for regime in members]
        exponents = [largest_exponent(system, state, blocks, block) for state in states]
        found = [
            measures(system, state, cycles) | {(EXPONENT, 0): exponent.mean}
            for state, exponent in zip(states, exponents, strict=True)
        ]
        key = {"case": case, "start": start, "regime": name}
        if start == "spread":
            share = len(members) / starts
            error = np.sqrt(share * (1 - share) / starts)
            rows.append({**key, "starts": starts, "quantity": SHARE, "module": 0, "mean": share, "uncertainty": error})
        for quantity, module in found[0]:
            mean, error, count = mean_and_error([values[quantity, module] for values in found])
            if quantity == EXPONENT and count == 1:
                error = exponents[0].error
            named = {"quantity": quantity, "module": module, "mean": mean, "uncertainty": error}
            rows.append({**key, "starts": count, **named})
        curves.append(curve("exponents", case, label=f"{start}, {name}", **_columns(exponents)))
        if (start, name) == ("spread", STRONGLY_MODULATED):
            compared = _windows(case, system, states[:SHOWN], windows)
            curves += [_survival(case, system, states, cycles, module) for module in (1, 2)]
    return pd.DataFrame(rows), compared, curves


def _columns(exponents):
    means, errors = zip(*exponents, strict=True)
    return {"exponent": means, "error": errors}


def _windows(case, system, states, windows):
    """Measures of the envelope over windows of several lengths, which begin together."""
    runs = [sampled(system, state, max(windows)) for state in states]
    rows = []
    for module in (1, 2):
        envelopes = [cycle_amplitudes(run.samples[:, 2 * module - 2], PER_CYCLE) for run in runs]
        for cycles in windows:
            for name, measure in (("amplitude variation", variation), ("depth from extremes", extreme_depth)):
                mean, error, _ = mean_and_error([measure(envelope[:cycles]) for envelope in envelopes])
                rows.append((case, module, cycles, name, mean, error))
    return rows


def _survival(case, system, states, cycles, module):
    """Fraction of the bursts that are at least this long, over all starts."""
    lengths = np.sort(np.concatenate([burst_lengths(system, state, cycles, module) for state in states]))
    longer = 1 - np.arange(len(lengths)) / len(lengths)
    return curve("bursts", f"{case}, module {module}", length=lengths, longer=longer)


@styled
def draw(tables: dict) -> Figure:
    """Draw the table of `compute`: how long bursts last, for each case with bursts, and the exponents of all starts."""
    table = tables["csv"]
    exponents = table[table["panel"] == "exponents"]
    cases = list(dict.fromkeys(exponents["series"]))
    modulated = [case for case in cases if len(select(table, "bursts", f"{case}, module 1"))]
    columns, rows = side_by_side(len(modulated) + 1)
    figure = new_figure(DOUBLE_COLUMN, 58.0 * rows)
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes in grid[len(modulated) + 1 :]:
        axes.set_axis_off()
    bursts = table[table["panel"] == "bursts"]
    (window,) = bursts[bursts["series"] == "window"]["length"]
    limits = {"xlim": (SHORTEST, _decade(1.1 * window)), "ylim": (_decade(bursts["longer"].min()) / 10, 1.5)}
    for axes, case, letter in zip(grid, modulated, ascii_lowercase, strict=False):
        for module, style in LINES.items():
            line = select(bursts, "bursts", f"{case}, module {module}")
            axes.plot(line["length"], line["longer"], label=f"module {module}", **style)
        axes.axvline(window, **LEVEL)
        side = {"xycoords": axes.get_xaxis_transform(), "textcoords": "offset points", "rotation": 90, "va": "center"}
        axes.annotate("end of the window", (window, 0.5), (4, 0), **side, fontsize=8.5)
        axes.set(xscale="log", yscale="log", xlabel="burst length, cycles", **limits)
        axes.legend(fontsize=8.5, loc="center right", bbox_to_anchor=(0.78, 0.55), handlelength=1.4)
        letter_panel(axes, letter)
        axes.set_title(case, loc="right", pad=3)
    grid[0].set_ylabel("fraction of bursts at least this long")
    _exponents(grid[len(modulated)], exponents, cases)
    letter_panel(grid[len(modulated)], ascii_lowercase[len(modulated)])
    return figure


def _decade(value):
    """The next power of ten from a value on: axes end there, wherever the longest of these chaotic bursts does."""
    return 10.0 ** np.ceil(np.log10(value))


def _exponents(axes, exponents, cases):
    for place, case in enumerate(cases):
        rows = exponents[exponents["series"] == case]
        rest = rows["label"].str.startswith("rest")
        x = place + np.linspace(-0.25, 0.25, len(rows))
        for mine, at, name in ((~rest, x[~rest], "spread starts"), (rest, place - 0.33, "from rest")):
            bars = axes.errorbar(at, rows["exponent"][mine], yerr=rows["error"][mine], **BARS, **DOTS[name])
            for part in bars.get_children():
                part.set_label(name)
    axes.axhline(0, color=BLACK, linewidth=0.6)
    low, high = ((exponents["exponent"] + sign * exponents["error"]) for sign in (-1, 1))
    low, high = low.min(), high.max()
    axes.set(xticks=range(len(cases)), xticklabels=cases, xlim=(-0.5, len(cases) - 0.5))
    axes.set(ylim=(np.floor(low / GRID) * GRID, np.ceil(high / GRID) * GRID))
    axes.set_ylabel(r"$\lambda_{\max}$ per forcing period")
    axes.legend(
        handles=[Line2D([], [], **style) for style in DOTS.values()], fontsize=8.5, handlelength=1.0, loc="upper left"
    )
    axes.tick_params(axis="x", length=0)
