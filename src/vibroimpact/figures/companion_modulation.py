"""Companion: modulated and other regimes in numbers, with uncertainties over starts; burst lengths and spectra."""

from string import ascii_lowercase

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.figures.kit.style import (
    BLACK,
    DOUBLE_COLUMN,
    GREY,
    LEVEL,
    letter_panel,
    new_figure,
    styled,
)
from vibroimpact.figures.kit.tables import curve, join, select
from vibroimpact.regimes import spectra
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

SPEC = {
    "title": "How long resonance lasts",
    "caption": "How long the balls stay in resonance in the modulated responses: the part of all resonant bursts that "
        "last at least so long. They are watched over a window (dotted) and cut off at its end.",
    "alt": "A panel for each case with a modulated response: the share of resonant bursts that last longer than a "
        "given number of cycles, falling on logarithmic axes, a line for each module, and a dotted line at the length "
        "of the window.",
    "method": "direct integration of (10.1) from many starts, until it repeats; Lyapunov exponents along the "
        "linearised flow",
    "columns": {
        "panel": {"values": ["bursts"]},
        "series": {"meaning": "the case with the module, or the window that bursts are watched over"},
        "length": {"meaning": "length of a resonant burst: two or more flights in a row that lead to the other wall "
            "and last between a quarter and three quarters of the period; or that of the window",
            "unit": "forcing periods", "compared": {"window": "algebra", "others": "sample"}},
        "longer": {"meaning": "part of the bursts, of all strongly modulated spread starts of the case, that are at "
            "least this long", "unit": "share", "compared": "sample"},
    },
    "tables": {
        "measures": {
            "file": "results/regimes/modulation.csv",
            "about": "What the responses of each case are like, mean over the starts that end in a regime.",
            "columns": {
                "case": {},
                "start": {"meaning": "the start from rest, or the spread ones", "unit": "text", "values": ["rest",
                    "spread"]},
                "regime": {},
                "starts": {"meaning": "starts behind the mean; of the share of starts, all spread ones",
                    "unit": "number"},
                "quantity": {"meaning": "amplitude variation: standard deviation over mean of the amplitude of $X_i$, "
                    "cycle by cycle. impacts per cycle. sticks per 1000 cycles. resonant share: part of the time in "
                    "bursts, unbroken sequences of two or more flights to the other wall that last between a quarter "
                    "and three quarters of the period. burst length: their mean. largest Lyapunov exponent. share of "
                    "starts: spread ones that end in this regime", "unit": "text", "values": ["amplitude variation",
                    "impacts per cycle", "sticks per 1000 cycles", "resonant share", "burst length",
                    "largest Lyapunov exponent", "share of starts"]},
                "module": {"meaning": "the module, 1 or 2; 0 for quantities of both together", "unit": "number"},
                "mean": {"meaning": "mean of the quantity: pure numbers, but for burst length (forcing periods), the "
                    "exponent and impacts (per forcing period), and sticks (per 1000 of them)",
                    "unit": "of its quantity"},
                "uncertainty": {"meaning": "standard error over the starts, binomial for their share; of one start "
                    "that of its exponent, blank else", "unit": "of its quantity"},
            },
        },
        "windows": {
            "file": "results/regimes/modulation_windows.csv",
            "about": "Two measures of modulation over windows of several lengths, for spread starts that end strongly "
                "modulated.",
            "columns": {
                "case, module": {}, "cycles": {"meaning": "length of the window", "unit": "forcing periods"},
                "quantity": {"meaning": "amplitude variation: standard deviation over mean of the amplitude of $X_i$, "
                    "cycle by cycle. depth from extremes: (largest - smallest) over (largest + smallest), which grows "
                    "with the window", "unit": "text", "values": ["amplitude variation", "depth from extremes"]},
                "mean": {"meaning": "mean over at most four starts", "unit": "dimensionless"},
                "uncertainty": {"meaning": "its standard error, blank for one start", "unit": "dimensionless"},
            },
        },
        "spectra": {
            "file": "results/regimes/spectra.csv",
            "about": "Lyapunov spectra of the responses of each case, of the map from one forcing cycle to the next "
                "([regimes](regimes.md)).",
            "columns": {
                "case": {},
                "start": {"meaning": "the start from rest, or the spread ones", "unit": "text", "values": ["rest",
                    "spread"]},
                "regime": {}, "starts": {"meaning": "starts behind the mean", "unit": "number"},
                "quantity": {"meaning": "exponent 1 to exponent 8: per forcing period, largest first, without the "
                    "cycles in which both balls stick at once. Kaplan-Yorke dimension: of these exponents, seen once "
                    "per cycle; a ball that idles adds to it, and where double sticks occur the attractor itself has "
                    "at most 4. double sticks per million cycles: cycles in which both balls stick at once, counted "
                    "over all starts together. sum of exponents: "
                    "over the cycles in which no ball sticks. contraction: what damping and impacts say it is, "
                    r"$2\ln\kappa$ for every impact, less $2\pi/\Omega$ times the trace of the damping matrix",
                    "unit": "text", "values": ["exponent 1", "exponent 2", "exponent 3", "exponent 4", "exponent 5",
                    "exponent 6", "exponent 7", "exponent 8", "Kaplan-Yorke dimension", "sum of exponents",
                    "contraction", "double sticks per million cycles"]},
                "mean": {"meaning": "its mean over the starts, -inf where a ball sticks at times: the motion forgets "
                    "two directions", "unit": "of its quantity"},
                "uncertainty": {"meaning": "its standard error over the starts, blank for one start; of double sticks "
                    "that of a count", "unit": "of its quantity"},
                "bootstrap": {"meaning": "the standard error of one start by block bootstrap, mean over the starts; "
                    "blank for sums and double sticks", "unit": "of its quantity"},
            },
        },
    },
}  # fmt: skip

EXPONENT, SHARE = "largest Lyapunov exponent", "share of starts"
LINES = {1: {"color": BLACK, "linestyle": "-"}, 2: {"color": GREY, "linestyle": (0, (4.5, 1.5))}}
SHORTEST = 0.5
"""Bursts in cycles: two flights of a quarter of the period."""
SHOWN = 4
"""Starts of a regime that are observed over the longest of the windows."""


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
    `spectra.rows`); and "csv", what is drawn: burst lengths [cycles] and the part of bursts longer than that, and
    the window that no burst outlasts.
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
        if (start, name) == ("spread", STRONGLY_MODULATED):
            compared = _windows(case, system, states[:SHOWN], windows)
            curves += [_survival(case, system, states, cycles, module) for module in (1, 2)]
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
    """Draw the table of `compute`: a panel for each case that has bursts."""
    table = tables["csv"]
    cases = list(dict.fromkeys(name.rsplit(", ", 1)[0] for name in table["series"] if ", module " in name))
    figure = new_figure(DOUBLE_COLUMN, 58.0)
    for axes, case, letter in zip(
        figure.subplots(1, max(len(cases), 1), squeeze=False)[0], cases, ascii_lowercase, strict=False
    ):
        _bursts(axes, table, case)
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
