"""Companion: responses of two sectors in phase by a published program, beside all exact ones."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.exact.orbits.search import orbits
from vibroimpact.field import OF_THE_PROGRAM, two_sectors
from vibroimpact.figures.kit.style import BLACK, GREY, SINGLE_COLUMN, STABLE, UNSTABLE, letter_panel, new_figure, styled
from vibroimpact.figures.kit.tables import curve, join, select

SPEC = {
    "title": "A published program beside exact orbits",
    "caption": "The program of Weidemann, Bergman, Vakakis and Krack (2025), run for two sectors in phase, a case of "
        "ours: their examples have ten sectors. Lines: exact responses with one impact at each wall per period, thick "
        "where stable. Circles: harmonic balance of the program, filled where it calls the response stable. Crosses: "
        "where its time stepping ends from there. a: "
        "amplitude of a ball's triangle over the clearance. b: difference of a ball's speeds to either side over their "
        "sum, 0 if both flights are alike.",
    "alt": "Two panels over the frequency. Above, an upper branch that is stable up to 0.988 and unstable beyond, and "
        "a lower one, unstable. From the point of change a stable grey line leads on, hardly rising, below the filled "
        "circles and through the crosses. Below, the grey line rises from 0 like a root, through the crosses.",
    "method": "exact responses; values of the program CC",
    "columns": {
        "panel": {"meaning": "exact, or of the program", "values": ["response", "program"]},
        "series": {"meaning": "of the exact responses; of the program", "values": ["lower", "upper",
            "asymmetric", "harmonic balance", "time stepping"]},
        "r": {"meaning": "forcing frequency over that of a sector whose absorber is fixed", "unit": "dimensionless",
            "compared": "algebra"},
        "theta": {"meaning": "amplitude of a ball's triangle over the clearance", "unit": "dimensionless",
            "compared": "roots"},
        "lean": {"meaning": "difference of a ball's speeds to either side over their sum; blank for harmonic balance",
            "unit": "dimensionless", "compared": "roots"},
        "stable": {"meaning": "all multipliers are inside the unit circle; of the program, what it says",
            "unit": "true or false"},
    },
}  # fmt: skip

PARTS = (0.979, 0.9875, 18), (0.98775, 0.988, 11), (0.98825, 0.992, 16)
"""Frequencies, denser where symmetry breaks."""
EXACT, THEIRS = "response", "program"
SYMMETRIC, ASYMMETRIC = ("lower", "upper"), "asymmetric"
BALANCE, STEPPING = "harmonic balance", "time stepping"


def compute() -> pd.DataFrame:
    """Return the exact responses in phase over the frequency r, and what the program finds.

    Columns panel ("response": series "lower", "upper", "asymmetric", one of two mirror images; "program": series
    "harmonic balance", "time stepping"), r, theta, lean, stable.
    """
    frequencies = np.concatenate([np.linspace(*part) for part in PARTS]).round(6)
    rows = [row for r in frequencies for row in _responses(float(r))]
    exact = pd.DataFrame(rows, columns=["series", "r", "theta", "lean", "stable"])
    curves = [
        curve(EXACT, series, **{name: part[name].to_numpy() for name in ("r", "theta", "lean", "stable")})
        for series, part in exact.groupby("series", sort=False)
    ]
    r, theta, stable, simulated, lean = zip(*OF_THE_PROGRAM, strict=True)
    curves.append(curve(THEIRS, BALANCE, r=r, theta=theta, lean=np.nan, stable=stable))
    followed = np.array(stable)
    ends = {"theta": np.array(simulated)[followed], "lean": np.abs(lean)[followed]}
    return join([*curves, curve(THEIRS, STEPPING, r=np.array(r)[followed], **ends, stable=True)])


def _responses(r):
    """Return (series, r, theta, lean, stable) of each response at one frequency whose sectors move alike."""
    system = two_sectors(r)
    alike = [one for one in orbits(system) if one.admissible and np.allclose(one.state[:2], one.state[2:4], atol=1e-7)]
    symmetric = sorted((one for one in alike if one.symmetric), key=lambda one: one.C[0])
    leaning = [one for one in alike if not one.symmetric and _lean(one) > 0]
    for series, orbit in [*zip(SYMMETRIC, symmetric, strict=False), *((ASYMMETRIC, one) for one in leaning)]:
        yield series, r, orbit.C[0] / (1 + system.epsilon), _lean(orbit), orbit.stable


def _lean(orbit):
    minus, plus = orbit.ball_speeds[0]
    return (plus - minus) / (plus + minus)


@styled
def draw(table: pd.DataFrame) -> Figure:
    """Draw the table of `compute`: amplitudes above, how unequal the speeds of a ball are below."""
    figure = new_figure(SINGLE_COLUMN, 110.0)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[1.5, 1.0])
    for series in (*SYMMETRIC, ASYMMETRIC):
        colour = {"color": GREY if series == ASYMMETRIC else BLACK}
        rows = select(table, EXACT, series)
        stable = rows.where(rows["stable"].astype(bool))
        for axes, column in ((above, "theta"), (below, "lean")):
            axes.plot(rows["r"], rows[column], **UNSTABLE | colour)
            axes.plot(rows["r"], stable[column], **STABLE | colour)
    balance, stepping = select(table, THEIRS, BALANCE), select(table, THEIRS, STEPPING)
    for stable, face, name in ((True, BLACK, "said stable"), (False, "white", "said unstable")):
        rows = balance[balance["stable"].astype(bool) == stable]
        above.plot(
            rows["r"], rows["theta"], "o", color=BLACK, markerfacecolor=face, markersize=4.6, label=name, clip_on=False
        )
    for axes, column in ((above, "theta"), (below, "lean")):
        axes.plot(
            stepping["r"], stepping[column], "x", color=BLACK, markersize=6.5, label="time stepping", clip_on=False
        )
    for axes, letter in ((above, "a"), (below, "b")):
        letter_panel(axes, letter)
    words = {"textcoords": "offset points", "fontsize": 9}
    above.annotate("asymmetric", (0.9897, 1.643), (0, -11), ha="center", color=GREY, **words)
    above.annotate("symmetric, unstable", (0.991, 1.804), (-8, 2), ha="right", **words)
    above.annotate("symmetric, stable", (0.9845, 1.505), (-8, 2), ha="right", **words)
    above.set(ylabel=r"$\theta$")
    below.set(xlabel="$r$", ylabel="difference of speeds", xlim=(PARTS[0][0], PARTS[-1][1]))
    figure.legend(*above.get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=8.5)
    return figure
