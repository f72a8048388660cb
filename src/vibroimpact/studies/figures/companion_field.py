"""Companion: responses of two sectors in phase by a published program, beside all exact ones."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.exact.orbits.search import orbits
from vibroimpact.figures.plotting.style import BLACK, SINGLE_COLUMN, STABLE, UNSTABLE, heading, new_figure, styled
from vibroimpact.studies.field import OF_THE_PROGRAM, two_sectors
from vibroimpact.studies.figures.plotting.regime_colours import COLOURS
from vibroimpact.studies.regimes.classification import ASYMMETRIC

SPEC = {
    "title": "A published program beside exact orbits",
    "caption": "The program of Weidemann, Bergman, Vakakis and Krack (2025), run for two sectors in phase, a case of "
        "ours: their examples have ten sectors. Lines: exact responses with one impact at each wall per period, thick "
        "where stable. Circles: harmonic balance of the program, filled where it calls the response stable. Crosses: "
        "where its time stepping ends from there. a: "
        "amplitude of a ball's triangle over the clearance. b: difference of a ball's speeds to either side over their "
        "sum, 0 if both flights are alike.",
    "alt": "Two panels over the frequency. Above, an upper branch that is stable up to 0.988 and unstable beyond, and "
        "a lower one, unstable. From the point of change a stable green line leads on, hardly rising, below the filled "
        "circles and through the crosses. Below, the green line rises from 0 like a root, through the crosses.",
    "method": "exact responses; values of the program CC",
    "columns": {
        "series": {"meaning": "the branch of exact responses", "values": ["lower", "upper", "asymmetric"]},
        "r": {"meaning": "forcing frequency over that of a sector whose absorber is fixed", "unit": "dimensionless",
            "compared": "algebra"},
        "theta": {"meaning": "amplitude of a ball's triangle over the clearance", "unit": "dimensionless",
            "compared": "roots"},
        "lean": {"meaning": "difference of a ball's speeds to either side over their sum", "unit": "dimensionless",
            "compared": "roots"},
        "stable": {"meaning": "all multipliers are inside the unit circle", "unit": "true or false"},
    },
    "tables": {
        "program": {
            "file": "results/figures/companion_field.program.csv",
            "about": "What the published program finds for the two sectors of `companion_field`.",
            "columns": {
                "r": {"meaning": "forcing frequency over that of a sector whose absorber is fixed",
                    "unit": "dimensionless", "compared": "algebra"},
                "theta": {"meaning": "amplitude of a ball's triangle over the clearance, by its harmonic balance",
                    "unit": "dimensionless", "compared": "algebra"},
                "stable": {"meaning": "what it says of that response", "unit": "true or false"},
                "simulated, lean": {"meaning": "of a response that it calls stable, where its time stepping ends: "
                    "amplitude, and difference of a ball's speeds over their sum", "unit": "dimensionless",
                    "compared": "algebra"},
            },
        },
    },
}  # fmt: skip

PARTS = (0.979, 0.9875, 18), (0.98775, 0.988, 11), (0.98825, 0.992, 16)
"""Frequencies, denser where symmetry breaks."""
BRANCHES = ("lower", "upper", ASYMMETRIC)


def compute() -> dict:
    """Return the exact responses in phase over the frequency r, and what the program finds.

    "csv": columns series ("lower", "upper", "asymmetric", one of two mirror images), r, theta, lean, stable. "program":
    r, theta, stable, simulated, lean (both of its time stepping, of stable responses).
    """
    frequencies = np.concatenate([np.linspace(*part) for part in PARTS]).round(6)
    rows = [row for r in frequencies for row in _responses(float(r))]
    program = pd.DataFrame(OF_THE_PROGRAM, columns=["r", "theta", "stable", "simulated", "lean"])
    program["lean"] = program["lean"].abs()
    program.loc[~program["stable"], ["simulated", "lean"]] = np.nan
    exact = pd.DataFrame(rows, columns=["series", "r", "theta", "lean", "stable"])
    return {
        "csv": exact.sort_values("series", key=lambda names: names.map(BRANCHES.index), kind="stable"),
        "program": program,
    }


def _responses(r):
    """Return (series, r, theta, lean, stable) of each response at one frequency whose sectors move alike."""
    system = two_sectors(r)
    alike = [one for one in orbits(system) if one.admissible and np.allclose(one.state[:2], one.state[2:4], atol=1e-7)]
    symmetric = sorted((one for one in alike if one.symmetric), key=lambda one: one.C[0])
    others = [one for one in alike if not one.symmetric and _flight_asymmetry(one) > 0]
    for series, orbit in [*zip(BRANCHES, symmetric, strict=False), *((ASYMMETRIC, one) for one in others)]:
        yield series, r, orbit.C[0] / (1 + system.epsilon), _flight_asymmetry(orbit), orbit.stable


def _flight_asymmetry(orbit):
    minus, plus = orbit.ball_speeds[0]
    return (plus - minus) / (plus + minus)


@styled
def draw(tables: dict) -> Figure:
    """Draw the tables of `compute`: amplitudes above, how unequal the speeds of a ball are below."""
    exact, program = tables["csv"], tables["program"]
    figure = new_figure(SINGLE_COLUMN, 114.0)
    panels = figure.subplots(2, 1, sharex=True, height_ratios=[1.5, 1.0])
    above, below = panels
    for series, rows in exact.groupby("series", sort=False):
        colour = {"color": COLOURS[ASYMMETRIC] if series == ASYMMETRIC else BLACK}
        stable = rows.where(rows["stable"].astype(bool))
        for axes, column in zip(panels, ("theta", "lean"), strict=True):
            axes.plot(rows["r"], rows[column], **UNSTABLE | colour)
            axes.plot(rows["r"], stable[column], **STABLE | colour)
    marks = {"color": BLACK, "linestyle": "none", "clip_on": False}
    for stable, face in ((True, BLACK), (False, "white")):
        rows = program[program["stable"].astype(bool) == stable]
        name = f"program: called {'stable' if stable else 'unstable'}"
        above.plot(rows["r"], rows["theta"], marker="o", markerfacecolor=face, markersize=4.6, label=name, **marks)
    for axes, column in zip(panels, ("simulated", "lean"), strict=True):
        axes.plot(program["r"], program[column], marker="x", markersize=6.5, label="program: time stepping", **marks)
    words = {"textcoords": "offset points"}
    above.annotate("asymmetric", (0.9899, 1.643), (0, -11), ha="center", color=COLOURS[ASYMMETRIC], **words)
    above.annotate("symmetric, unstable", (0.991, 1.804), (-8, 2), ha="right", **words)
    above.annotate("symmetric, stable", (0.9845, 1.505), (-8, 2), ha="right", **words)
    heading(above, "a", "how far the balls swing")
    heading(below, "b", "how unequal their flights are")
    above.set(ylabel="amplitude over clearance, $\\theta$")
    below.set(
        xlabel="frequency over that of a sector, $r$", ylabel="difference of speeds", xlim=(PARTS[0][0], PARTS[-1][1])
    )
    figure.legend(*above.get_legend_handles_labels(), loc="outside lower center", ncols=2, fontsize=9)
    return figure
