"""Levels of the model hierarchy for every figure: errors of the plotted quantities, and costs.

The order of the levels is fixed here, from the cheapest to the dearest, so that no figure depends on a timing. A figure
needs a level whose error its lines cannot show: less than half their width, as a share of the axis.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from types import SimpleNamespace

import numpy as np

from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.accuracy.timing import shortest_time
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.orbits.search import orbits
from vibroimpact.system import System
from vibroimpact.system.extras import need
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points
from vibroimpact.theory.response import leading_order

need("figures", "pandas")
need("reference", "mpmath")

import mpmath as mp  # noqa: E402 (after the word on what is missing)
import pandas as pd  # noqa: E402 (after the word on what is missing)

HIERARCHY = ("closed_form", "slow_flow", "simulation", "orbit", "proven simulation")
"""Levels by rising cost. An orbit costs more than a transient: all are sought before the stable one is picked."""

DIGITS = 30
SETTLED = 1e-6
"""Largest change after a forcing period of a motion that has settled: one step of Newton's method squares it away."""


@dataclass(frozen=True)
class Level:
    """One model of a figure's quantities: its error as a share of the axis, or the reason without one, and the work.

    compiles: True if the first call of the work may take longer than others, for compilation or caches.
    """

    name: str
    error: float
    work: Callable | None = None
    note: str = ""
    compiles: bool = True


def in_use(scene: dict, simulation: dict | None = None) -> str:
    """The level that the config names for a figure; a simulation carried with extra digits is the proven one."""
    proven = scene["model"] == "simulation" and "digits" in (simulation or {})
    return "proven simulation" if proven else scene["model"]


COLUMNS = ["figure", "level", "error", "tolerance", "meets", "cost_s", "in_use", "note"]


def rows(figure: str, tolerance: float, levels: list[Level], level_in_use: str, seconds: float) -> list[dict]:
    """The rows of the table for one figure: level, error, tolerance, cost in seconds, True for the level in use.

    Args:
        tolerance: the smallest error that the figure's lines can show, as a share of an axis.
        seconds: how long the work of a level is repeated for its time.
    """
    return [
        {
            "figure": figure,
            "level": level.name,
            "error": level.error,
            "tolerance": tolerance,
            "meets": level.error <= tolerance,
            "cost_s": _cost(level, seconds),
            "in_use": level.name == level_in_use,
            "note": level.note,
        }
        for level in sorted(levels, key=lambda level: HIERARCHY.index(level.name))
    ]


def _cost(level, seconds):
    if level.work is None:
        return np.nan
    if level.compiles:
        level.work()
    return shortest_time(level.work, seconds)


def _share(values, truth, span):
    """Largest difference as a share of an axis of this span; 0 without one, also where nothing moves."""
    difference = np.nanmax(np.abs(np.asarray(values, float) - np.asarray(truth, float)))
    return float(difference / span) if difference else 0.0


def _span(values):
    return float(np.ptp(np.asarray(values, float)))


def closed_form_levels(figure: str, scene: dict, system: dict, table: pd.DataFrame, work: Callable) -> list[Level]:
    """Figures 10.3 to 10.5: the formula in float64 against the same formula with 30 digits; work computes the table."""
    with mp.workdps(DIGITS):
        truth = {"fig10_03": _true_sawtooth, "fig10_04": _true_manifold, "fig10_05": _true_limit}[figure](scene, system)
        series, x, y, f = truth
        curve = table[table["series"].isin(series)]
        if figure == "fig10_05":  # the shaded region is a polygon: without its two upper corners it is the limit
            curve = curve[curve[y] < scene["C_range"][1]]
        exact = [float(f(mp.mpf(float(value)))) for value in curve[x]]
    return [Level("closed_form", _share(curve[y], exact, _span(table[y])), work)]


def _true_sawtooth(scene, system):
    def Z(tau):
        return 2 / mp.pi * mp.mpf(scene["amplitude"]) * mp.asin(mp.cos(tau - mp.mpf(scene["theta"])))

    return ["Z"], "tau0", "Z", Z


def _true_manifold(scene, system):
    r = _true_rho(mp.mpf(str(system["kappa"])))
    return ["SIM unstable", "SIM stable"], "C", "B", lambda C: _true_B(C, r)


def _true_limit(scene, system):
    return ["stable"], "kappa", "C", lambda kappa: 4 / (4 + mp.pi * _true_rho(kappa))


def _true_rho(kappa):
    """Factor rho of (10.16)."""
    return 2 * (1 - kappa) / (mp.pi * (1 + kappa))


def _true_B(C, r):
    """B of the manifold (10.16)."""
    return mp.sqrt(1 - 2 * C + (1 + r**2) * C**2)


def true_fixed_point(system: System, point):
    """A fixed point of the slow flow solved anew with 30 digits: (10.23) as two complex equations, written out.

    A module that takes no part has C = psi = 0.
    """
    with mp.workdps(DIGITS):
        s = {name: mp.mpf(str(value)) for name, value in vars(system).items()}
        r = _true_rho(s["kappa"])
        coupling = s["alpha12_hat"] + 1j * s["gamma12_hat"]
        tuning = 2 * s["sigma_e_hat"] - s["alpha12_hat"], 2 * s["sigma_e_hat"] - s["alpha12_hat"] - s["sigma20_hat"]
        damping = s["gamma1_hat"] + s["gamma12_hat"], s["gamma2_hat"] + s["gamma12_hat"]
        force = s["f10_hat"], s["f20_hat"]

        def residual(C1, psi1, C2, psi2):
            C, B = (C1, C2), [_true_B(C1, r), _true_B(C2, r)]
            b = [B[0] * mp.exp(-1j * psi1), B[1] * mp.exp(-1j * psi2)]
            found = []
            for i in range(2):
                if i + 1 not in system.modules:
                    found += [C[i], (psi1, psi2)[i]]
                    continue
                impacts = 8 / mp.pi**2 * C[i] * ((1 - C[i]) + 1j * r * C[i]) / B[i] ** 2
                value = (tuning[i] - 1j * damping[i] - impacts) * b[i] + coupling * b[1 - i] + force[i]
                found += [value.real, value.imag]
            return found

        C1, psi1, C2, psi2 = mp.findroot(
            residual, np.nan_to_num(np.column_stack([point.C, point.psi])).ravel().tolist()
        )
        return SimpleNamespace(C=(C1, C2), B=[_true_B(C1, r), _true_B(C2, r)], psi=(psi1, psi2), rho=r)


def slow_flow_levels(scene: dict, system: System, points: list) -> list[Level]:
    """Figures of fixed points (10.6, 10.9) and of the response of one (10.7, 10.10): label, C, B and psi of each."""
    known = [point for point in points if point.label == scene.get("fixed_point", point.label)]
    truths = [true_fixed_point(system, point) for point in known]
    if "fixed_point" in scene:
        tau = np.linspace(0.0, system.period, 200)
        got = leading_order(system, known[0], tau)
        errors = [_share(getattr(got, name), _true_response(system, truths[0], tau, name), 2.0) for name in "UXWY"]
    else:
        errors = [
            _share(np.r_[p.C, p.B], [*t.C, *t.B], min(scene["C_max"])) for p, t in zip(known, truths, strict=True)
        ]
    return [
        Level("closed_form", np.inf, note="gives the manifold, not the points on it"),
        Level("slow_flow", max(errors, default=0.0), lambda: fixed_points(system)),
    ]


def _true_response(system, point, tau, name):
    """U, W, X or Y of (10.9), (10.10) with 30 digits, shape (n, 2)."""
    values = np.zeros((len(tau), 2))
    with mp.workdps(DIGITS):
        omega = 1 + mp.mpf(str(system.epsilon)) * mp.mpf(str(system.sigma_e_hat))
        e = mp.mpf(str(system.epsilon))
        for i in (module - 1 for module in system.modules):
            C, B, psi = point.C[i], point.B[i], point.psi[i]
            lag = mp.atan2(1 - C, point.rho * C)
            for n, t in enumerate(tau):
                phase = omega * mp.mpf(float(t)) - psi
                U = B * mp.sin(phase)
                W = U + 2 / mp.pi * C * mp.asin(mp.cos(phase - lag))
                X = (U + e * W) / (1 + e)
                values[n, i] = {"U": U, "W": W, "X": X, "Y": X - W}[name]
    return values


def motion_levels(system: System, settings: dict, summary: dict, points: list, stable, samples: pd.DataFrame):
    """Figures of a simulated motion (10.8, 10.11): settled on a 1:1 response, proved with many digits, or neither.

    Args:
        settings: of the simulation, as in the config. summary: what it says of itself (summary.json).
        points: fixed points of the case. stable: states (n, 8) at tau = 0 of its stable 1:1 orbits.
        samples: of the window, columns tau and those of the state.
    """
    if "digits" not in settings and summary["largest_change_after_cycles"]["1"] <= SETTLED:
        return _settled_levels(system, settings, points, stable, samples)
    return _unsettled_levels(system, settings, points, len(stable), samples, summary["trust"])


def _settled_levels(system, settings, points, stable, samples):
    """X_2 and W_2 over one forcing period against the periodic motion that the simulation has settled on."""
    per_cycle = settings["samples_per_cycle"]
    drawn = samples.iloc[-per_cycle - 1 : -1]
    phase = np.arange(per_cycle) / per_cycle * system.period
    truth = _settled_truth(system, drawn.iloc[0, 1:].to_numpy(float), phase)
    span = 2 * np.abs(truth[:, 0]).max()

    def error(X2, W2):
        return max(_share(X2, truth[:, 0], span), _share(W2, truth[:, 1], 2.0))

    theory = [error(r.X[:, 1], r.W[:, 1]) for r in (leading_order(system, point, phase) for point in points)]
    drawn_error = error(drawn["X2"], drawn["X2"] - drawn["Y2"])
    cycles = settings["transient_cycles"] + settings["window_cycles"]
    work = partial(simulate, system, settings["initial_state"], cycles)
    followed = [simulate(system, state, 1, sample_times=phase).samples for state in stable]
    orbit_error = min((error(s[:, 2], s[:, 2] - s[:, 3]) for s in followed), default=np.inf)
    return [
        *_theory(system, theory),
        Level("simulation", drawn_error, work),
        Level("orbit", orbit_error, lambda: orbits(system), "the stable one; an unstable one is never drawn"),
    ]


def _settled_truth(system, state, phase, digits=40):
    """X_2 and W_2 (n, 2) of the periodic motion next to a state, by one Newton step of the 40-digit period map."""
    jacobian = simulate(system, state, 1).jacobian
    moved = reference_run(system, [repr(float(x)) for x in state], 1, digits, exact_floats=False).final - state
    # The shortest step: where a ball is idle, motions with the ball elsewhere in its box repeat as well.
    start = state - np.linalg.lstsq(jacobian - np.eye(8), moved)[0]
    samples = reference_run(
        system, [repr(float(x)) for x in start], 1, digits, sample_times=phase, exact_floats=False
    ).samples
    return np.column_stack([samples[:, 2], samples[:, 2] - samples[:, 3]])


def _unsettled_levels(system, settings, points, stable, samples, trust):
    """X_2 and W_2 over the window of a motion that does not repeat, against what the figure shows.

    The error of a trajectory that is not proved is the one that its certificate expects, inf past the horizon.
    """
    tau, X2 = samples["tau"].to_numpy(), samples["X2"].to_numpy()
    W2 = X2 - samples["Y2"].to_numpy()

    def error(other_X2, other_W2):
        return max(_share(other_X2, X2, _span(X2)), _share(other_W2, W2, 2.0))

    theory = [error(r.X[:, 1], r.W[:, 1]) for r in (leading_order(system, point, tau) for point in points)]
    start, cycles, proven = settings["initial_state"], settings["transient_cycles"] + settings["window_cycles"], []
    if "digits" in settings:
        digits = settings["digits"]
        floating = simulate(system, start, cycles, sample_times=tau)
        away = error(floating.samples[:, 2], floating.samples[:, 2] - floating.samples[:, 3])
        horizon, note = floating.certificate.horizon, f"{digits} digits, proved by doubling them"
        work = partial(reference_run, system, start, cycles, digits)
        proven = [Level("proven simulation", trust["agreement"], work, note, compiles=False)]
    else:
        horizon = trust["certificate"].get("horizon", np.inf)
        away = trust["certificate"].get("error", np.inf) / min(_span(X2), 2.0)
    doubt = "float64" if np.isinf(horizon) else "float64: beyond its horizon"
    return [
        *_theory(system, theory),
        Level("simulation", away, partial(simulate, system, start, cycles), doubt),
        Level("orbit", np.inf, lambda: orbits(system), f"{stable} stable orbits"),
        *proven,
    ]


def _theory(system, errors):
    """The levels of the theory, from the error of every fixed point's response."""
    return [
        Level("closed_form", np.inf, note="gives no motion of this system"),
        Level(
            "slow_flow",
            min(errors, default=np.inf),
            lambda: fixed_points(system),
            "nearest fixed point, leading order" if errors else "there is no fixed point",
        ),
    ]
