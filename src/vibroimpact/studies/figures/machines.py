"""Machines in SI units: largest displacement against frequency, and the motion of a box and its ball."""

from itertools import cycle

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.lanes.ensemble import ensemble
from vibroimpact.figures.plotting.names import name_curves
from vibroimpact.figures.plotting.style import BLACK, DOUBLE_COLUMN, GREY, STABLE, heading, new_figure, styled
from vibroimpact.studies.absorbers.references import compared
from vibroimpact.studies.figures.companion_response import LINES
from vibroimpact.system import PhysicalSystem

SPEC = {
    "title": "Machines in SI units",
    "notebook": "physical_units",
    "caption": "Two coupled machines in SI units, each a box with a ball. a: largest displacement of both boxes "
        "against the frequency, with balls at several clearances :math:`L` (after a transient from rest), without "
        "balls, and with the best linear absorbers of the same mass. At a jump of a line, runs reach another motion. "
        "b: box 1 and its ball against time, from rest, including the transient.",
    "alt": "Two panels. a: largest displacement in millimetres against frequency in hertz: a tall resonance without "
        "balls, a low flat line of the best absorbers, and a line for each clearance of the balls. b: the "
        "motion of box 1 grows from rest until its wall strikes the ball, which then flies from wall to wall; dots "
        "mark the impacts.",
    "own": {
        "title": "Machines in SI units",
        "alt": "Two panels: the largest displacement in millimetres against the frequency in hertz, with a line for "
            "each linear system and each clearance; and the displacements of box 1 and of its ball against time, with "
            "dots at impacts.",
    },
    "equations": [r"\tau = \omega_{10} t, \quad \omega_{10}^2 = k_1/M, \quad X_i = x_i/L, \quad \varepsilon = m/M, "
        r"\quad \hat f_{i0} = F_{i0}/(\varepsilon k_1 L)"],
    "method": "direct integration of (10.1) from rest; linear systems in closed form",
    "columns": {
        "series": {"meaning": "linear system, or clearance", "unit": "text"},
        "frequency": {"meaning": r"frequency of the forces, $\omega/(2\pi)$", "unit": "hertz", "compared": "algebra"},
        "swing": {"meaning": r"largest $\lvert x_i\rvert$ of both boxes", "unit": "millimetres", "compared": {
            "without balls": "algebra", "best absorbers": "trajectory", "others": "extremes"}},
    },
    "tables": {
        "motion": {
            "file": "results/figures/machines.motion.csv",
            "about": "Motion of box 1 of `machines` and its ball from rest.",
            "columns": {
                "L": {"meaning": "clearance $L$", "unit": "metres", "compared": "algebra"},
                "frequency": {"meaning": r"frequency of the forces, $\omega/(2\pi)$", "unit": "hertz",
                    "compared": "algebra"},
                "time": {"meaning": "time from the start", "unit": "seconds of the machine", "compared": "trajectory"},
                "box, ball": {"meaning": "displacement $x_1$ or $y_1$", "unit": "millimetres",
                    "compared": "trajectory"},
                "at_wall": {"meaning": "True if the ball hits a wall at this time", "unit": "true or false"},
            },
        },
        "summary": {
            "file": "results/figures/machines.summary.csv",
            "about": "Power and displacement of the machines for each clearance, at the frequency with the largest "
                "displacement.",
            "columns": {
                "L": {"meaning": "clearance $L$", "unit": "metres"},
                "frequency": {"meaning": r"frequency of the forces, $\omega/(2\pi)$", "unit": "hertz"},
                "power": {"meaning": "mean power of the forces", "unit": "watts"},
                "share": {"meaning": "share of this power that impacts dissipate", "unit": "share"},
                "swing": {"meaning": r"largest $\lvert x_i\rvert$ of both boxes", "unit": "millimetres"},
                "force": {"meaning": "$F_{10}$ for which this clearance is as good as the best one is for the force of "
                    "the machines", "unit": "newtons"},
            },
        },
    },
}  # fmt: skip

MM = 1000.0
"""Millimetres in a metre."""
DASHES = (1, 1.2), (5, 1.5, 1, 1.5), (5, 1.5, 1, 1.5, 1, 1.5), (8, 2)
"""Line styles of the clearances; the clearance with the lowest peak has a bold solid line."""
BOX, BALL = {"color": GREY, "linewidth": 1.6, "zorder": 2.2}, {"color": BLACK, "linewidth": 0.5}
WALLS = {"color": BLACK, "linestyle": "none", "marker": "o", "markersize": 2.4, "zorder": 2.4}
FINE, PER_CYCLE = 301, 30


def compute(plant: dict, clearances, frequencies: dict, cycles: int, settle: int, shown: dict) -> dict:
    """Return the largest displacements of the boxes against frequency, and a motion in time.

    The machines with balls are simulated from rest; the linear machines are computed in closed form.

    Parameters
    ----------
    plant : dict
        Arguments of PhysicalSystem except L, omega1 and omega2, in SI units.
    clearances : sequence of float
        Clearances L [m].
    frequencies : dict
        `range` [Hz] and `values`, the number of frequencies.
    cycles : int
        Number of forcing periods of each run, including the transient.
    settle : int
        Number of forcing periods of the transient, which is omitted.
    shown : dict
        `L` [m], `frequency` [Hz] and `cycles` (number of forcing periods) of the motion that is shown in time.

    Returns
    -------
    dict
        The tables in SPEC.
    """
    hertz = np.linspace(*frequencies["range"], frequencies["values"])
    curves = [*_linear(_machines(plant, clearances[0], hertz[0]), hertz[[0, -1]])]
    rows = []
    for L in clearances:
        machines = [_machines(plant, L, one) for one in hertz]
        runs = ensemble([one.dimensionless() for one in machines], np.zeros(8), cycles, settle=settle, energy=True)
        swing = MM * L * runs["largest"].max(axis=1)
        curves.append(pd.DataFrame({"series": f"L = {MM * L:g} mm", "frequency": hertz, "swing": swing}))
        worst = int(swing.argmax())
        machine, energy = machines[worst], runs["energy"][worst]
        joule, frequency, work = machine.k1 * L**2, machine.omega1 / (2 * np.pi), energy["work"].sum()
        power = joule * work * frequency / (cycles - settle)
        rows.append((L, frequency, power, energy["impacts"].sum() / work, swing[worst]))
    summary = pd.DataFrame(rows, columns=["L", "frequency", "power", "share", "swing"])
    summary["force"] = plant["F10"] * summary["L"] / summary["L"][summary["swing"].idxmin()]
    place = {name: shown[name] for name in ("L", "frequency")}
    motion = _motion(_machines(plant, *place.values()), shown["cycles"])
    return {"csv": pd.concat(curves), "motion": pd.DataFrame({**place, **motion}), "summary": summary}


def _machines(plant, L, hertz):
    return PhysicalSystem(**plant, L=L, omega1=2 * np.pi * hertz, omega2=2 * np.pi * hertz)


def _linear(machine, band):
    """Yield the curves of two linear machines: one without balls, and one with the best absorbers.

    Each curve gives the largest displacement [mm] against the frequency [Hz].
    """
    unit, fine = machine.omega10 / (2 * np.pi), np.linspace(*band, FINE)
    linear = compared(machine.dimensionless(), tuple(band / unit))
    for name in LINES:
        swing = MM * machine.L * linear[name].amplitudes(fine / unit).max(axis=1)
        yield pd.DataFrame({"series": name, "frequency": fine, "swing": swing})


def _motion(machine, cycles):
    """Simulate box 1 and its ball from rest, and return the columns of their motion."""
    system = machine.dimensionless()
    tau = np.arange(cycles * PER_CYCLE) / PER_CYCLE * system.period
    run = simulate(system, np.zeros(8), cycles, sample_times=tau)
    hits = run.events[run.events["module"] == 1]
    times, places = np.concatenate([tau, hits["tau"]]), np.concatenate([run.samples, hits["state"]])
    order = np.argsort(times, kind="stable")
    box, ball = MM * machine.L * places[order, :2].T
    return {"time": times[order] / machine.omega10, "box": box, "ball": ball, "at_wall": order >= len(tau)}


@styled
def draw(tables: dict[str, pd.DataFrame]) -> Figure:
    """Draw the tables of `compute`: largest displacements against frequency, and a motion in time."""
    swings, shown = dict(iter(tables["csv"].groupby("series", sort=False))), tables["motion"]
    figure = new_figure(DOUBLE_COLUMN, 66.0)
    response, motion = figure.subplots(1, 2)
    looks = dict(LINES)
    with_balls = {name: line for name, line in swings.items() if name not in LINES}
    best = min(with_balls, key=lambda name: with_balls[name]["swing"].max())
    for name, dashes in zip(with_balls, cycle(DASHES)):
        looks[name] = STABLE if name == best else {"linestyle": (0, dashes), "linewidth": 0.9, "color": BLACK}
    drawn = {name: response.plot(swings[name]["frequency"], swings[name]["swing"], **looks[name]) for name in looks}
    response.set(xlabel="frequency, Hz", ylabel="largest displacement, mm")
    response.set_ylim(0.0, 1.08 * tables["csv"]["swing"].max())
    motion.plot(shown["time"], shown["box"], label="box 1", **BOX)
    motion.plot(shown["time"], shown["ball"], label="its ball", **BALL)
    walls = shown[shown["at_wall"]]
    motion.plot(walls["time"], walls["ball"], label="ball at a wall", **WALLS)
    motion.set(xlabel="time, s", ylabel="displacement, mm")
    L, hertz = shown[["L", "frequency"]].iloc[0]
    heading(response, "a", f"lowest peak with balls: {_clearance(best)}")
    heading(motion, "b", f"motion at $L = {MM * L:g}$ mm, {hertz:g} Hz")
    motion.legend(loc="lower left", fontsize=9)
    names = [(name if name in LINES else _clearance(name), lines) for name, lines in drawn.items()]
    name_curves(figure, {response: names})
    return figure


def _clearance(name):
    """Return the name of a series, such as "L = 5 mm", with the formula in math mode."""
    return f"${name.removesuffix(' mm')}$ mm"
