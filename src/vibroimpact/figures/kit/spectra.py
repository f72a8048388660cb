"""Lyapunov spectra of the motions that starts end in: a table, and two panels of companion_modulation."""

from typing import NamedTuple

import numpy as np
from matplotlib.lines import Line2D

from vibroimpact.figures.kit.style import BLACK, GREY
from vibroimpact.figures.kit.tables import curve
from vibroimpact.regimes.lyapunov import SIZE, Spectrum, spectrum
from vibroimpact.regimes.modulation import mean_and_error

EXPONENTS, RUNNING = "exponents", "running"
DIMENSION, SUM, CONTRACTION = "Kaplan-Yorke dimension", "sum of exponents", "contraction"
DOUBLE, OF_CYCLES = "double sticks per million cycles", 1e6
DRAWN = SIZE - 2
"""So many exponents are left where a ball sticks at times."""
FIRST = 50
"""Running estimates are drawn from this cycle on."""
REST = "from rest"
MARKS = ("o", "s", "D", "^", "v", "P")
GRID, MARGIN = 0.5, 0.1
"""Axes end at multiples of the one, the other at least beyond the exponents, wherever those of chaotic motions lie."""
_DOT = {"linestyle": "none", "markersize": 3.2, "markeredgewidth": 0.5}
_DOTS = {**_DOT, "markersize": 2.4, "elinewidth": 0.5, "capsize": 0}
_BAND = {"color": "0.8", "linewidth": 0}


class Watched(NamedTuple):
    """Spectrum of a motion without the cycles in which both balls stick at once; bootstrap errors of its exponents,
    (8,), and of its dimension; how many cycles were left out."""

    spectrum: Spectrum
    errors: np.ndarray
    dimension_error: float
    double_sticks: int


def watch(system, states, cycles: int, block: int) -> list[Watched]:
    """Watch each motion over so many cycles after ten blocks of them; the blocks are those of the bootstrap, which
    needs two."""
    found, block = [], max(1, min(block, cycles // 2))
    for state in states:
        one = spectrum(system, state, cycles, 10 * block)
        single = one.without_double_sticks()
        found.append(Watched(single, *single.errors(block), one.double_sticks))
    return found


def rows(key: dict, found) -> list[dict]:
    """Rows of the table for motions of one regime: mean, standard error over them, mean bootstrap error of one.

    Sum and contraction are of the cycles in which no ball sticks. Double sticks are counted over all motions.
    """
    columns = {f"exponent {k + 1}": [(one.spectrum.exponents[k], one.errors[k]) for one in found] for k in range(SIZE)}
    columns[DIMENSION] = [(one.spectrum.dimension, one.dimension_error) for one in found]
    columns[SUM] = [(_free(one, one.growth.sum(axis=1)), np.nan) for one, *_ in found]
    columns[CONTRACTION] = [(_free(one, one.contraction), np.nan) for one, *_ in found]
    values = {name: _summary(*zip(*column, strict=True)) for name, column in columns.items()}
    values[DOUBLE] = _rate(sum(one.double_sticks for one in found), sum(len(one.spectrum.growth) for one in found))
    return [{**key, "starts": len(found), "quantity": name, **summary} for name, summary in values.items()]


def _rate(count, others):
    """Rate of rare events with the standard error of their number, which is that of one event where none was met."""
    scale = OF_CYCLES / (count + others)
    return {"mean": scale * count, "uncertainty": scale * np.sqrt(max(count, 1)), "bootstrap": np.nan}


def _free(one, values):
    """Mean over the cycles in which no ball sticks."""
    return values[one.stuck == 0].mean()


def _summary(values, errors):
    if -np.inf in values:
        return {"mean": -np.inf, "uncertainty": np.nan, "bootstrap": np.nan}
    mean, error, _ = mean_and_error(values)
    return {"mean": mean, "uncertainty": error, "bootstrap": float(np.mean(errors))}


def curves(case: str, label: str, found):
    """What is drawn of the motions of one regime: each exponent of each, with its error."""
    for k in range(DRAWN):
        exponent, error = zip(*((one.spectrum.exponents[k], one.errors[k]) for one in found), strict=True)
        yield curve(EXPONENTS, f"{case}, {k + 1}", label=label, number=k + 1, exponent=_finite(exponent), error=error)


def running(case: str, found):
    """Estimates after more and more cycles, mean over motions, and the error expected of them by the bootstrap."""
    cycles = min(len(one.spectrum.growth) for one in found)
    after = np.unique(np.geomspace(min(FIRST, cycles), cycles, 25).astype(int))
    for k in range(DRAWN):
        estimates = np.mean([one.spectrum.running[after - 1, k] for one in found], axis=0)
        error = np.mean([one.errors[k] for one in found]) * np.sqrt(cycles / after / len(found))
        yield curve(RUNNING, f"{case}, {k + 1}", number=k + 1, cycles=after, estimate=_finite(estimates), spread=error)


def _finite(values):
    """Blank where there is no exponent."""
    values = np.asarray(values, dtype=float)
    return np.where(np.isfinite(values), values, np.nan)


def draw_exponents(axes, table, _="") -> None:
    """Exponents of every start with their standard errors against their number, cases side by side."""
    cases = cases_of(table)
    width = 0.8 / len(cases)
    for place, (case, mark) in enumerate(zip(cases, MARKS, strict=False)):
        mine = table[_case(table) == case]
        rest = mine["label"].str.startswith("rest")
        begin = mine["number"] - 0.4 + width * place
        beside = mine.groupby("number").cumcount() / (len(mine) / mine["number"].nunique())
        for part, name, fill in ((~rest, case, GREY), (rest, REST, "white")):
            looks = {"marker": mark, "color": fill, "markeredgecolor": GREY if fill == GREY else BLACK}
            bars = axes.errorbar(
                (begin + width * 0.85 * beside)[part],
                mine["exponent"][part],
                yerr=mine["error"][part],
                ecolor=GREY,
                **looks,
                **_DOTS,
            )
            for artist in bars.get_children():
                artist.set_label(name)
    _common(axes, table["exponent"])
    axes.set(xlabel="number $k$", xticks=range(1, DRAWN + 1), xlim=(0.5, DRAWN + 0.5))
    handles = [
        Line2D([], [], marker=mark, color=GREY, label=case, **_DOT) for case, mark in zip(cases, MARKS, strict=False)
    ]
    open_mark = Line2D([], [], marker=MARKS[0], color="white", markeredgecolor=BLACK, label=REST, **_DOT)
    axes.legend(handles=[*handles, open_mark], fontsize=8.5, handlelength=1.0)


def draw_running(axes, table, _="") -> None:
    """Running estimates of one case within twice the error that the bootstrap expects of them."""
    for number, line in table.groupby("number"):
        low, high = (line["estimate"] + sign * 2 * line["spread"] for sign in (-1, 1))
        axes.fill_between(line["cycles"], low, high, label=RUNNING, **_BAND)
        axes.plot(line["cycles"], line["estimate"], color=BLACK, linewidth=0.9, label=RUNNING)
        looks = {
            "marker": f"${number:g}$",
            "markersize": 4.5,
            "markeredgewidth": 0,
            "color": BLACK,
            "clip_on": False,
            "label": RUNNING,
        }
        axes.plot(1.17 * line["cycles"].iloc[-1], line["estimate"].iloc[-1], **looks)
    _common(axes, table["estimate"])
    axes.set(xscale="log", xlabel="cycles", xlim=(table["cycles"].min(), table["cycles"].max()))


def cases_of(table) -> list[str]:
    """The cases that a table of exponents has, in its order."""
    return list(dict.fromkeys(_case(table)))


def _case(table):
    return table["series"].str.rsplit(", ", n=1).str[0]


def _common(axes, values):
    axes.axhline(0, color=BLACK, linewidth=0.6)
    low, high = values.min() - MARGIN, values.max() + MARGIN
    axes.set_ylim(np.floor(low / GRID) * GRID, np.ceil(high / GRID) * GRID)
    axes.set_ylabel(r"$\lambda_k$ per forcing period")
