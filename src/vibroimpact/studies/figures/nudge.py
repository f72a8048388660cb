"""Perturb an exact periodic motion by a millionth of the clearance, and simulate how the perturbation grows."""

import io

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from PIL import Image

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.figures.plotting.style import BLACK, DOUBLE_COLUMN, GREY, heading, new_figure, styled
from vibroimpact.frames import to_frame
from vibroimpact.studies.claims.verdict_grid import exact_orbits
from vibroimpact.system.state import NAMES
from vibroimpact.system.verdict import STABLE
from vibroimpact.theory.criteria import PRINTED, of_fixed_point
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points

SPEC = {
    "title": "A nudge of a millionth",
    "caption": "Exact motion next to a fixed point that the chapter calls stable, with ball 2 moved by a millionth of "
        "the clearance to each side. (a) Distance from the periodic motion, once per forcing period; line: growth by "
        "its largest multiplier. (b) Length of each flight of ball 2 in forcing periods; the periodic motion has one "
        "half.",
    "alt": "Left: the distance from the periodic motion follows a straight line on a logarithmic axis, then stays "
        "large. Right: the flights, at first equal, permanently split into long and short ones.",
    "method": "exact orbit of the fixed point, and a simulation that starts next to it",
}  # fmt: skip

PERTURBATION, CYCLES, PER_CYCLE = 1e-6, 40, 40
"""Initial shift of ball 2 from the orbit in units of L, length of the run in forcing periods, samples per period."""
BALL = "Y2"
COLUMNS = {
    "motion": ["t", "X1", "Y1", "X2", "Y2"],
    "impacts": ["t", "module", "wall"],
    "distance": ["t", "distance"],
    "flights": ["t", "length"],
    "orbit": ["label", "multiplier"],
}


def compute(system) -> dict:
    """Perturb an unstable exact orbit whose fixed point is stable by (10.26), and simulate the motion.

    Without such an orbit, the tables have no rows. Times t are in forcing periods.

    Returns
    -------
    dict
        - "motion": X1, Y1, X2, Y2 at each sample and each event.
        - "impacts": module and wall of each impact.
        - "distance": Euclidean distance from the orbit, once a period.
        - "flights": time at the end of each flight of ball 2, and length of the flight in forcing periods.
        - "orbit": label of the fixed point, and modulus of the largest multiplier.
    """
    label, orbit = _called_stable(system)
    if orbit is None:
        return {name: pd.DataFrame(columns=columns) for name, columns in COLUMNS.items()}
    start = orbit.state + PERTURBATION * (np.array(NAMES) == BALL)
    times = np.arange(CYCLES * PER_CYCLE + 1) / PER_CYCLE
    run = simulate(system, start, CYCLES, sample_times=times * system.period)
    samples = pd.DataFrame(run.samples, columns=NAMES).assign(tau=times * system.period)
    moments = pd.concat([samples, to_frame(run)], ignore_index=True)
    moments = moments.assign(t=moments["tau"] / system.period)
    impacts = moments[moments["kind"] == "impact"]
    ends = impacts[impacts["module"] == 2]["t"].to_numpy()
    away = np.linalg.norm(run.samples[::PER_CYCLE] - orbit.state, axis=1)
    rows = {
        "motion": moments.drop_duplicates("tau").sort_values("tau", ignore_index=True),
        "impacts": impacts.reset_index(drop=True),
        "distance": np.column_stack([times[::PER_CYCLE], away]),
        "flights": np.column_stack([ends[1:], np.diff(ends)]),
        "orbit": [[label, abs(orbit.multipliers[0])]],
    }
    return {name: pd.DataFrame(found, columns=COLUMNS[name]) for name, found in rows.items()}


def page_data(tables: dict[str, pd.DataFrame]) -> dict:
    """Return the data of the animation in the report."""
    rounded = {name: tables[name].astype(float).round(4) for name in ("motion", "impacts", "flights")}
    return {
        "cycles": int(tables["distance"]["t"].max()) if len(tables["distance"]) else 0,
        "motion": rounded["motion"].to_dict("list"),
        **{name: rounded[name].to_numpy().tolist() for name in ("impacts", "flights")},
        "distance": [float(f"{value:.3g}") for value in tables["distance"]["distance"]],
        "multiplier": [float(f"{value:.6g}") for value in tables["orbit"]["multiplier"]],
        "label": tables["orbit"]["label"].tolist(),
    }


def animate(tables: dict[str, pd.DataFrame], path) -> None:
    """Write the figure as an animated GIF file; each frame shows two more forcing periods."""
    frames = []
    for cycle in range(1, CYCLES + 1, 2):
        past = {name: tables[name][tables[name]["t"] <= cycle] for name in ("distance", "flights")}
        frame = io.BytesIO()
        draw(tables | past).savefig(frame, dpi=120)
        frames.append(Image.open(frame).convert("L"))
    durations = [300] * (len(frames) - 1) + [3000]  # durations in milliseconds; the last frame stays longer
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=durations, loop=0)


def _called_stable(system):
    """Return the most unstable admissible orbit whose fixed point is stable by (10.26), with the label of this point.

    The result is (label, orbit), or (None, None) if no such orbit is unstable. The most unstable orbit has the
    largest multiplier.
    """
    points = fixed_points(system)
    orbits = exact_orbits(system, [point.C for point in points], symmetric_solutions(system))
    found = [
        (point.label, orbit)
        for point, orbit in zip(points, orbits, strict=True)
        if orbit is not None and of_fixed_point(system, point)[PRINTED] == STABLE
        if orbit.admissible and abs(orbit.multipliers[0]) > 1
    ]
    return max(found, key=lambda one: abs(one[1].multipliers[0]), default=(None, None))


@styled
def draw(tables: dict[str, pd.DataFrame]) -> Figure:
    """Draw the tables of `compute`: the distance in the left panel, and the flights in the right panel.

    A line in the left panel shows the growth that the largest multiplier predicts.
    """
    figure = new_figure(DOUBLE_COLUMN, 62.0)
    left, right = figure.subplots(1, 2)
    distance, flights = tables["distance"], tables["flights"]
    for multiplier in tables["orbit"]["multiplier"]:
        t = np.array([0.0, -np.log(PERTURBATION) / np.log(multiplier)])
        left.plot(t, PERTURBATION * multiplier**t, color=GREY, linewidth=1.0)
        left.text(
            t[1] / 2 + 1, PERTURBATION**0.5, f"times {multiplier:.2f}\nper period", ha="left", va="top", fontsize=8
        )
    left.plot(distance["t"], distance["distance"], color=BLACK, marker="o", markersize=2.5, linewidth=0)
    left.set(
        yscale="log", ylim=(PERTURBATION / 3, 3), xlabel="forcing periods", ylabel="distance from the periodic motion"
    )
    right.axhline(0.5, color=GREY, linewidth=1.0)
    right.plot(flights["t"], flights["length"], color=BLACK, marker="o", markersize=2.5, linewidth=0)
    right.set(ylim=(0.2, 0.8), xlabel="forcing periods", ylabel="flights of ball 2, in periods")
    for axes, letter in ((left, "a"), (right, "b")):
        axes.set_xlim(0, CYCLES)
        heading(axes, letter)
    return figure
