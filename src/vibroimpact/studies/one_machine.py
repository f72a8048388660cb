"""Design a ball absorber for one machine in SI units: clearance, restitution and response.

Candidates are compared by their peak, the largest displacement over a band of frequencies from several initial states.
A peak from few initial states is a lower bound. Selecting the lowest of many peaks adds a bias. So the best candidates
are measured again: from more initial states, after a longer transient, and with three clearances close together. The
design is the candidate for which the largest of these three peaks is lowest.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.lanes.ensemble import ensemble
from vibroimpact.studies.absorbers.peaks import finished
from vibroimpact.studies.absorbers.references import best_tuning, tuned, without_balls
from vibroimpact.studies.regimes.classification import starts as spread_starts
from vibroimpact.system import PhysicalSystem
from vibroimpact.system.arguments import instance, pair, reals
from vibroimpact.system.extras import need
from vibroimpact.system.progress import track
from vibroimpact.system.state import IMPACT, inactive_at_rest

RESTITUTIONS = (0.05, 0.15, 0.3, 0.5, 0.8)
"""Default candidates for the restitution coefficient. For a damped contact of steel with steel it is about 0.6."""
CLEARANCE_FACTOR, WIDEST_FACTOR, COARSE_CLEARANCES = 4, 8, 8
"""Default clearances: COARSE_CLEARANCES values from (F / k) (M / m) / CLEARANCE_FACTOR to (F / k) (M / m) times
CLEARANCE_FACTOR. The lower end is at most the peak without ball / WIDEST_FACTOR, the upper end at most this peak."""
FINALISTS = 3
"""Number of best candidates that are measured again."""
PER_WIDTH, LEAST, MOST = 6, 41, 801
"""Frequencies per half-power width of the resonance without ball; least and largest number of frequencies in a band."""
FEW_STARTS, MORE_STARTS = 3, 6
"""Number of initial states for each candidate, and for each of the FINALISTS. A candidate is run at every other
frequency, a finalist at all frequencies."""
SETTLED, LONGEST = 5, 2000
"""Length of the transient in time constants of the machine, and its upper limit in forcing periods."""
SHORT, LONG = 100, 600
"""Window for each candidate, and shortest transient for each of the FINALISTS, in forcing periods. A shortest transient
is needed, since transients may be chaotic."""
WINDOW, LATER = 300, 1000
"""Window for each of the FINALISTS, and time for which the largest motion at each frequency is continued after this
window, to show whether the motion is a transient; both in forcing periods."""
NEAR = 0.02
"""Relative difference in clearance between a design and its two neighbours."""
FRAGILE_FACTOR = 1.1
"""A design is fragile if the peak of a neighbour exceeds FRAGILE_FACTOR times that of the design."""
TRANSIENT_FACTOR = 1.1
"""The largest motion of a design is a transient if its displacement falls by more than this factor after the window."""
CURVES = {
    "without_m": ("without ball", {"color": "0.55", "linewidth": 1.6}),
    "with_m": ("with the ball, settled", {"color": "black", "linewidth": 1.2}),
    "settling_m": ("while it settles from rest", {"color": "black", "linestyle": (0, (1, 1.5)), "linewidth": 0.9}),
    "absorber_m": ("best linear absorber", {"color": "black", "linestyle": (0, (4.5, 2.5)), "linewidth": 0.9}),
}
"""Lines of the plot of a design: columns of its response, with labels and styles."""


@dataclass(frozen=True, eq=False)
class Design:
    """A ball for one machine, and its effect over the band of frequencies.

    Displacements are measured from the rest position.

    Attributes
    ----------
    machine : PhysicalSystem
        The machine with the chosen ball: mass `m` [kg] and restitution `kappa` of the ball, clearance `L` [m] to each
        wall.
    peak : float
        Largest displacement over the band [m], after the transient.
    near : tuple of float
        Smallest and largest of three peaks [m]. The three peaks are measured with three clearances: `L`, 0.98 `L` and
        1.02 `L`.
    without : float
        Peak without ball [m].
    absorber : float
        Peak [m] with the best linear absorber of the same mass.
    absorber_stroke : float
        Largest displacement [m] of this absorber relative to the machine.
    window : tuple of int
        Length of the transient, and length of the window after the transient, both in forcing periods. `peak` is
        measured in this window.
    candidates : list of dict
        One row per candidate, with the entries:

        - clearance_m, restitution: clearance and restitution coefficient of the candidate.
        - peak_m: peak from few initial states.
        - near_m: for the best candidates, the largest of the three peaks (see `near`). For all other candidates, near_m
          is nan.
    response : list of dict
        One row per frequency, with the entries:

        - frequency_Hz: frequency of the force.
        - without_m: displacement without ball.
        - absorber_m: displacement with the best linear absorber.
        - settling_m: displacement with the ball, in the transient from rest.
        - with_m: largest displacement with the ball, in the window, over all initial states.
        - impacts_per_s: number of impacts per second in the motion that reaches with_m.
        - impact_speed_m_s, impulse_Ns: mean speed and mean impulse of these impacts.
        - later_m: displacement of the same motion in the 1000 periods after the window. If the motion is a transient,
          later_m is smaller than with_m.

    Examples
    --------
    >>> print(vi.design(machine, band=(2.5, 4.0)))  # doctest: +SKIP
    """

    machine: PhysicalSystem
    peak: float
    near: tuple[float, float]
    without: float
    absorber: float
    absorber_stroke: float
    window: tuple[int, int]
    candidates: list[dict]
    response: list[dict]

    def __str__(self):
        machine, (waited, watched) = self.machine, self.window
        static = abs(machine.force(machine.omega10)) / machine.k1
        settling = max(row["settling_m"] for row in self.response)
        hardest = max(self.response, key=lambda row: row["impact_speed_m_s"])
        verdict = f"{1 - self.peak / self.without:.0%} less" if self.peak < self.without else "no less"
        settled = " (not settled where it is largest, see below)" if self._unsettled() else ""
        return "\n".join([
            f"natural frequency {machine.omega10 / (2 * math.pi):.4g} Hz, static deflection {_mm(static)}",
            f"clearance {1000 * machine.L:.10g} mm to each side, restitution {machine.kappa:g}",
            f"largest displacement {_mm(self.peak)} once settled{settled}: {verdict} than {_mm(self.without)} without "
            "ball",
            f"  {_mm(self.near[0])} to {_mm(self.near[1])} if the clearance differs by up to {NEAR:.0%}",
            f"  {_mm(settling)} while it settles from rest",
            f"  {_mm(self.absorber)} with the best linear absorber of the ball's mass, which needs "
            f"{_mm(self.absorber_stroke)} to each side",
            f"hardest impacts at {hardest['frequency_Hz']:.4g} Hz: {hardest['impacts_per_s']:.3g} per second of "
            f"{hardest['impulse_Ns']:.3g} N s each, at {hardest['impact_speed_m_s']:.3g} m/s",
            f"Settled: the largest of {MORE_STARTS} initial states in {watched} forcing periods, after the first "
            f"{waited}.",
            *self._warnings(),
            "The walls are rigid, so an impact has an impulse but no finite force.",
        ])  # fmt: skip

    def plot(self):
        """Plot the displacements in `response` against the frequency.

        Returns
        -------
        matplotlib.figure.Figure
            The plot.

        Raises
        ------
        ModuleNotFoundError
            If Matplotlib is missing; the extra `figures` installs it.
        """
        need("figures", "matplotlib")
        from matplotlib.figure import Figure

        figure = Figure(figsize=(4.8, 3.2), layout="constrained")
        axes = figure.add_subplot(xlabel="frequency of the force, Hz", ylabel="largest displacement, mm")
        hertz = [row["frequency_Hz"] for row in self.response]
        for name, (label, look) in CURVES.items():
            axes.plot(hertz, [1000 * row[name] for row in self.response], label=label, **look)
        axes.set_ylim(bottom=0)
        axes.margins(x=0)
        axes.legend(frameon=False)
        return figure

    def _unsettled(self):
        """Return the row of `response` with the largest displacement if its motion has not settled, else None."""
        worst = max(self.response, key=lambda row: row["with_m"])
        return worst if self.peak > TRANSIENT_FACTOR * worst["later_m"] else None

    def _warnings(self):
        """Yield a line for each warning about the design."""
        for name, value in (("restitution", self.machine.kappa), ("clearance_m", self.machine.L)):
            tried = sorted({row[name] for row in self.candidates})
            if len(tried) > 1 and value in (tried[0], tried[-1]):
                end, better = ("smallest", "smaller") if value == tried[0] else ("largest", "larger")
                yield f"The {name.removesuffix('_m')} is the {end} of those tried; a {better} one may be better."
        if worst := self._unsettled():
            later = f"{_mm(worst['later_m'])} in the {LATER} periods that follow"
            yield f"At {worst['frequency_Hz']:.4g} Hz the largest motion had not settled: it is at most {later}."
        if self.near[1] > FRAGILE_FACTOR * self.peak:
            more = self.near[1] / self.peak - 1
            yield f"Fragile: with clearances within {NEAR:.0%} of it the peak is up to {more:.0%} higher."
        first, last = (self.response[end]["frequency_Hz"] for end in (0, -1))
        if not first <= self.machine.omega10 / (2 * math.pi) <= last:
            yield f"No resonance without ball lies in the band from {first:.4g} to {last:.4g} Hz."
        if self.machine.m > self.machine.M:
            yield f"The ball of {self.machine.m:.4g} kg is heavier than its machine of {self.machine.M:.4g} kg."


def design(
    machine: PhysicalSystem,
    band: tuple[float, float],
    clearances: Sequence[float] | None = None,
    restitutions: Sequence[float] = RESTITUTIONS,
    progress: bool = True,
) -> Design:
    """Find the clearance and the restitution coefficient with which a ball gives the lowest peak.

    The peak is the largest displacement over a band of frequencies. The sign of the force has no effect.

    Parameters
    ----------
    machine : PhysicalSystem
        One machine (`PhysicalSystem.single`). Its own L, kappa and forcing frequency are ignored.
    band : tuple of float
        First and last frequency of the force [Hz].
    clearances : sequence of float, optional
        Clearances to try [m]. By default, 8 values from 1/4 to 4 times (F / k) (M / m) are tried, and then more values
        near the best ones. If necessary, the 8 values are reduced: the smallest is at most 1/8 of the peak without
        ball, and the largest is at most this peak.
    restitutions : sequence of float, default RESTITUTIONS
        Restitution coefficients to try, each between 0 and 1.
    progress : bool, default True
        Count the candidates on standard error, if it is a terminal.

    Returns
    -------
    Design
        The best design, with the response and all candidates.

    Raises
    ------
    ValueError
        If an argument is malformed, if the machine is coupled, or if it has no damper or no force.
    ArithmeticError
        If a run could not be finished, or if the tuning of the linear absorber failed.

    Examples
    --------
    >>> machine = vi.PhysicalSystem.single(M=100.0, m=5.0, k=4e4, c=40.0, F=20.0)
    >>> found = vi.design(machine, band=(2.5, 4.0))  # doctest: +SKIP
    """
    instance("machine", machine, PhysicalSystem)
    restitutions = _choices("restitutions", restitutions, 1.0)
    clearances = clearances if clearances is None else _choices("clearances", clearances, math.inf)
    study = _Study(machine, band)
    without = study.without.peak(study.band)
    if clearances is None:
        scale = study.static * machine.M / machine.m
        coarse = np.geomspace(
            min(scale / CLEARANCE_FACTOR, without / WIDEST_FACTOR),
            min(CLEARANCE_FACTOR * scale, without),
            COARSE_CLEARANCES,
        )
        rows = study.tried([(_rounded(L), kappa) for kappa in restitutions for L in coarse], progress)
        third = np.cbrt(coarse[1] / coarse[0])
        beside = [(row["clearance_m"] * f, row["restitution"]) for row in _best(rows) for f in (1 / third, third)]
        rows += study.tried([(_rounded(L), kappa) for L, kappa in beside], progress)
    else:
        rows = study.tried([(L, kappa) for kappa in restitutions for L in clearances], progress)
    finalists = []
    for row in track(_best(rows), "design: best candidates, measured again", progress):
        candidate = replace(study.machine, L=row["clearance_m"], kappa=row["restitution"])
        measured, *beside = (study.measured(candidate, factor) for factor in (1.0, 1 - NEAR, 1 + NEAR))
        peaks = [one.peak for one in (measured, *beside)]
        row["near_m"] = max(peaks)
        finalists.append((max(peaks), measured.peak, min(peaks), measured))
    highest, _, lowest, measured = min(finalists, key=lambda one: one[:2])
    absorber = tuned(study.system, best_tuning(study.system, study.band, study.scale), study.scale)
    return Design(
        machine=replace(machine, L=measured.machine.L, kappa=measured.machine.kappa),
        peak=measured.peak,
        near=(lowest, highest),
        without=without,
        absorber=absorber.peak(study.band),
        absorber_stroke=absorber.stroke(study.band),
        window=(study.wait, WINDOW),
        candidates=rows,
        response=study.response(measured, absorber),
    )


def _choices(name, values, end) -> list[float]:
    """Return `values` in ascending order; raise ValueError unless all are above 0 and below `end`."""
    given = np.unique(reals(name, values)).tolist()
    if not given or not 0 < given[0] <= given[-1] < end:
        upper = f" and below {end:g}" if end < math.inf else ""
        raise ValueError(f"{name}: got {given}, expected one or more numbers above 0{upper}")
    return given


def _best(rows) -> list[dict]:
    """Return the rows with the lowest peaks, at most FINALISTS of them."""
    return sorted(rows, key=lambda row: row["peak_m"])[:FINALISTS]


def _rounded(clearance) -> float:
    """Return a clearance rounded to three digits, so that the printed value is the simulated one."""
    return float(f"{clearance:.3g}")


def _mm(metres) -> str:
    return f"{1000 * metres:.3g} mm"


@dataclass(frozen=True, eq=False)
class _Measured:
    """Response of a machine with its ball at n frequencies, from m initial states.

    largest: largest displacement [m] in the window after the transient, shape (n, m).
    settling: largest displacement [m] in the transient from rest, shape (n,).
    states, finals: states at the start and at the end of the window, each of shape (n, m, 8).
    """

    machine: PhysicalSystem
    systems: list
    largest: np.ndarray
    settling: np.ndarray
    states: np.ndarray
    finals: np.ndarray

    @property
    def peak(self) -> float:
        return float(self.largest.max())


class _Study:
    """Simulations of one machine over a band of frequencies.

    machine: the machine with the force |F| and a clearance of 1 m.
    system: the dimensionless form of `machine`. Its unit of length is the clearance, so that its displacements are in
        metres.
    """

    def __init__(self, machine, band):
        low, high = pair("band", band)
        if not 0 < low < high:
            raise ValueError(f"band: got ({low}, {high}), expected (low, high) with 0 < low < high")
        if not machine.c1 or not machine.F10:
            raise ValueError(
                f"machine: got c = {machine.c1} and the force {machine.F10}, expected c above 0 and a nonzero "
                "F, base or unbalance"
            )
        natural = {"omega1": machine.omega10, "omega2": machine.omega10}
        # The sign of F is dropped, since F and -F would give slightly different results from the same initial states.
        self.machine = replace(machine, F10=abs(machine.F10), L=1.0, **natural)
        self.hertz, self.static = machine.omega10 / (2 * math.pi), self.machine.F10 / machine.k1
        self.system, self.band = self.machine.dimensionless(), (low / self.hertz, high / self.hertz)
        if self.system.modules != (1,):
            raise ValueError(
                "machine: got two machines (coupled, or both with a force), expected one; see PhysicalSystem.single"
            )
        ratio = machine.c1 / (2 * machine.M * machine.omega10)
        width = 2 * ratio * self.hertz
        self.frequencies = np.linspace(low, high, min(max(LEAST, math.ceil(PER_WIDTH * (high - low) / width)), MOST))
        self.settle = min(math.ceil(SETTLED / (2 * math.pi * ratio)), LONGEST)
        self.wait = max(self.settle, LONG)
        self.without = without_balls(self.system, self.scale)

    def scale(self, Omega):
        """Return the force at the dimensionless frequencies `Omega`, divided by the force at Omega = 1."""
        return self.machine.force(Omega * self.machine.omega10) / self.machine.F10 * np.ones_like(Omega)

    def tried(self, pairs: Sequence[tuple[float, float]], progress: bool) -> list[dict]:
        """Return a row of `Design.candidates` for each pair of clearance and restitution."""
        rows, states = [], self._starts(FEW_STARTS, 1)
        for L, kappa in track(pairs, "design: candidates tried", progress):
            systems = self._systems(replace(self.machine, L=L, kappa=kappa))[::2]
            runs = finished(ensemble(np.array(systems)[:, None], states, self.settle + SHORT, settle=self.settle))
            height = L * float(runs["largest"][..., 0].max())
            rows.append({"clearance_m": L, "restitution": kappa, "peak_m": height, "near_m": math.nan})
        return rows

    def measured(self, machine, factor: float) -> _Measured:
        """Return the response of a machine with `factor` times its clearance, from MORE_STARTS initial states."""
        machine = replace(machine, L=factor * machine.L)
        systems = self._systems(machine)
        each = np.array(systems)[:, None]
        before = finished(ensemble(each, self._starts(MORE_STARTS, 2), self.wait))
        settled = finished(ensemble(each, before["final"], WINDOW))
        largest, settling = (machine.L * runs["largest"][..., 0] for runs in (settled, before))
        return _Measured(machine, systems, largest, settling[:, 0], before["final"], settled["final"])

    def response(self, measured, absorber) -> list[dict]:
        """Return the rows of `Design.response`."""
        without, with_absorber = (
            linear.amplitudes(self.frequencies / self.hertz)[:, 0] for linear in (self.without, absorber)
        )
        rows, worst = [], measured.largest.argmax(axis=1)
        later = finished(ensemble(measured.systems, measured.finals[range(len(worst)), worst], LATER))
        for k, start in enumerate(worst):
            row = {"frequency_Hz": self.frequencies[k], "without_m": without[k], "with_m": measured.largest[k, start]}
            row |= {"settling_m": measured.settling[k], "absorber_m": with_absorber[k]}
            run = simulate(measured.systems[k], measured.states[k, start], WINDOW)
            row |= _impacts(measured.machine, run) | {"later_m": measured.machine.L * later["largest"][k, 0]}
            rows.append({name: float(value) for name, value in row.items()})
        return rows

    def _starts(self, count, seed):
        return inactive_at_rest(self.system, spread_starts(count, seed))

    def _systems(self, machine):
        omegas = (2 * math.pi * self.frequencies).tolist()
        return [replace(machine, omega1=omega, omega2=omega).dimensionless() for omega in omegas]


def _impacts(machine, run) -> dict:
    """Return the number of impacts of ball 1 per second, and their mean speed and impulse, in SI units."""
    states = run.events["state"][(run.events["module"] == 1) & (run.events["kind"] == IMPACT)]
    seconds = run.cycles * run.system.period / machine.omega10
    # The states are those after the impacts. Division by kappa gives the speeds before the impacts.
    speeds = machine.L * machine.omega10 * np.abs(states[:, 4] - states[:, 5]) / machine.kappa
    impulses = machine.m / (1 + run.system.epsilon) * (1 + machine.kappa) * speeds
    speed, impulse = (values.mean() if len(values) else 0.0 for values in (speeds, impulses))
    return {"impacts_per_s": len(states) / seconds, "impact_speed_m_s": speed, "impulse_Ns": impulse}
