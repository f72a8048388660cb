"""Companion: modulated and other regimes in numbers, with uncertainties over starts; burst lengths and spectra."""

from string import ascii_lowercase

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.companions import spectra
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
from vibroimpact.regimes.classification import CHAOS, REGIMES, STRONGLY_MODULATED
from vibroimpact.regimes.classification import starts as spread_starts
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
        cycles: window of the measures. blocks, block: of Lyapunov exponents of chaotic spread starts, so
            many blocks of so many cycles; exponents of other starts come from the window.
        windows: lengths in cycles over which measures of the envelope are compared.
        observation: arguments of `regimes.settling.Observation`.

    Returns "measures": columns case, start ("rest", "spread"), regime, starts, quantity, module (0: both), mean,
    uncertainty (standard error over starts; binomial for the share of starts; of one start that of its exponent, from
    blocks, and blank else); "windows": columns case, module, cycles, quantity, mean, uncertainty, of strongly modulated
    spread starts; "spectra": columns case, start, regime, starts, quantity, mean, uncertainty, bootstrap (see
    `spectra.rows`); and "csv", what is drawn: burst lengths [cycles] and the part of bursts longer than that, the
    window that no burst outlasts, the exponents of each start with their standard errors, per period, and running means
    of those of modulated starts.
    """
    tables = [
        _case(case, system, starts, seed, cycles, blocks, block, windows, observation)
        for case, system in systems.items()
    ]
    rows, compared, exponents, curves = zip(*tables, strict=True)
    window = curve("bursts", "window", length=float(cycles), longer=np.nan)
    return {
        "measures": pd.concat(rows, ignore_index=True),
        "spectra": pd.DataFrame([row for part in exponents for row in part]),
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
    rows, curves, compared, exponents = [], [], [], []
    for (start, name), members in groups.items():
        states = [regime.run.final for regime in members]
        lasts = start == "spread" and name in CHAOS
        watched = spectra.watch(system, states, blocks * block if lasts else cycles, block)
        found = [
            measures(system, state, cycles) | {(EXPONENT, 0): one.spectrum.exponents[0]}
            for state, one in zip(states, watched, strict=True)
        ]
        key = {"case": case, "start": start, "regime": name}
        if start == "spread":
            share = len(members) / starts
            error = np.sqrt(share * (1 - share) / starts)
            rows.append({**key, "starts": starts, "quantity": SHARE, "module": 0, "mean": share, "uncertainty": error})
        for quantity, module in found[0]:
            mean, error, count = mean_and_error([values[quantity, module] for values in found])
            if quantity == EXPONENT and count == 1:
                error = watched[0].errors[0]
            named = {"quantity": quantity, "module": module, "mean": mean, "uncertainty": error}
            rows.append({**key, "starts": count, **named})
        exponents += spectra.rows(key, watched)
        curves += spectra.curves(case, f"{start}, {name}", watched)
        if (start, name) == ("spread", STRONGLY_MODULATED):
            compared = _windows(case, system, states[:SHOWN], windows)
            curves += [_survival(case, system, states, cycles, module) for module in (1, 2)]
            curves += spectra.running(case, watched)
    return pd.DataFrame(rows), compared, exponents, curves


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
    """Draw the table of `compute`: bursts of each case that has any, exponents, how those of the last one settle."""
    table = tables["csv"]
    exponents = table[table["panel"] == spectra.EXPONENTS]
    modulated = [case for case in spectra.cases_of(exponents) if len(select(table, "bursts", f"{case}, module 1"))]
    settling = table[(table["panel"] == spectra.RUNNING) & table["series"].str.startswith(tuple(modulated[-1:]))]
    panels = [(_bursts, table, case) for case in modulated] + [(spectra.draw_exponents, exponents, "")]
    panels += [(spectra.draw_running, settling, case) for case in modulated[-1:]]
    columns, rows = side_by_side(len(panels), 2)
    figure = new_figure(DOUBLE_COLUMN, 58.0 * rows)
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes in grid[len(panels) :]:
        axes.set_axis_off()
    for axes, (drawn, part, case), letter in zip(grid, panels, ascii_lowercase, strict=False):
        drawn(axes, part, case)
        letter_panel(axes, letter)
        axes.set_title(case, loc="right", pad=3)
    return figure


def _bursts(axes, table, case):
    bursts = table[table["panel"] == "bursts"]
    (window,) = bursts[bursts["series"] == "window"]["length"]
    for module, style in LINES.items():
        line = select(bursts, "bursts", f"{case}, module {module}")
        axes.plot(line["length"], line["longer"], label=f"module {module}", **style)
    axes.axvline(window, **LEVEL)
    side = {"xycoords": axes.get_xaxis_transform(), "textcoords": "offset points", "rotation": 90, "va": "center"}
    axes.annotate("end of the window", (window, 0.5), (4, 0), **side, fontsize=8.5)
    limits = {"xlim": (SHORTEST, _decade(1.1 * window)), "ylim": (_decade(bursts["longer"].min()) / 10, 1.5)}
    axes.set(xscale="log", yscale="log", xlabel="burst length, cycles", ylabel="fraction at least this long", **limits)
    axes.legend(fontsize=8.5, loc="center right", bbox_to_anchor=(0.78, 0.55), handlelength=1.4)


def _decade(value):
    """The next power of ten from a value on: axes end there, wherever the longest of these chaotic bursts does."""
    return 10.0 ** np.ceil(np.log10(value))
