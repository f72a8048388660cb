"""Design a ball absorber for one machine in SI units: clearance, restitution and response.

The machine is a mass on a spring and a damper, driven over a band of frequencies by a constant force, a moving base or
an unbalance. Candidates are compared by their peak: the largest displacement over the band, from rest and from other
initial states. A peak from a few initial states is a lower bound, and selecting the lowest of many such peaks adds a
bias. So the best few candidates are measured again: from more initial states, after a longer transient, and with
slightly more and less clearance. The design is the candidate with the lowest worst peak in this neighbourhood. The
text, the table and the plot of the design use the same grid of frequencies and the same window of time.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.lanes.ensemble import ensemble
from vibroimpact.studies.absorbers.linear import checked_band
from vibroimpact.studies.absorbers.peaks import finished
from vibroimpact.studies.absorbers.references import fixed_balls, tuned, without_balls
from vibroimpact.studies.absorbers.tuning import best_tuning
from vibroimpact.studies.regimes.classification import starts as spread_starts
from vibroimpact.system import PhysicalSystem
from vibroimpact.system.arguments import instance, reals
from vibroimpact.system.extras import need
from vibroimpact.system.progress import track
from vibroimpact.system.state import IMPACT, RELEASE, STICK, inactive_at_rest

RESTITUTIONS = (0.05, 0.15, 0.3, 0.5, 0.8)
"""Default candidates for the restitution coefficient; for steel on steel with damping it is about 0.6."""
CLEARANCE_FACTOR, WIDEST_FACTOR, COARSE_CLEARANCES = 4, 8, 8
"""Default clearances: COARSE_CLEARANCES values from (F / k) (M / m) / CLEARANCE_FACTOR to (F / k) (M / m) times
CLEARANCE_FACTOR. The lower end is at most the peak without ball / WIDEST_FACTOR, the upper end at most this peak."""
DIGITS = 3
"""Significant digits of candidate clearances, so that the printed value is the simulated one."""
FEW = 3
"""Number of best candidates that are measured again."""
PER_WIDTH, LEAST, MOST = 6, 41, 801
"""Frequencies per half-power width of the resonance without ball; least and largest number of frequencies in a band."""
FEW_STARTS, MORE_STARTS = 3, 6
"""Number of initial states for each candidate, which is run at every other frequency, and for each of the best few."""
SETTLED, LONGEST = 5, 2000
"""Length of the transient in time constants of the machine, and its upper limit in forcing periods."""
SHORT, LONG = 100, 600
"""Forcing periods of the window for each candidate; shortest transient for the best few (transients may be chaotic)."""
WINDOW = 300
"""Forcing periods of the window for each of the best few."""
NEAR, FRAGILE = 0.02, 1.1
"""NEAR is the relative difference in clearance between a design and its two neighbours. A design is fragile if the peak
of a neighbour exceeds FRAGILE times that of the design. The largest motion of a design is settled if its displacement
in the LATER periods after the window is at least the peak of the design divided by FRAGILE."""
LATER = 1000
"""Forcing periods for which the largest motion at each frequency is continued, to show whether it is a transient."""
CURVES = {
    "without_m": ("without ball", {"color": "0.55", "linewidth": 1.6}),
    "with_m": ("with the ball, settled", {"color": "black", "linewidth": 1.2}),
    "settling_m": ("while it settles from rest", {"color": "black", "linestyle": (0, (1, 1.5)), "linewidth": 0.9}),
    "absorber_m": ("best linear absorber", {"color": "black", "linestyle": (0, (4.5, 2.5)), "linewidth": 0.9}),
}
"""Lines of the plot of a design: columns of its response, with labels and styles."""
SENSITIVITY_FACTORS = (0.8, 1.2)
"""Clearances of the sensitivity analysis, relative to the clearance of the design."""


@dataclass(frozen=True, eq=False)
class Design:
    """A ball for one machine, and its effect over the band of frequencies. Displacements are amplitudes [m].

    Attributes
    ----------
    machine : PhysicalSystem
        The chosen machine, with the mass of the ball `m` [kg], the clearance `L` [m], half of the play, and the
        restitution coefficient `kappa`.
    peak : float
        Largest displacement over the band [m] once settled: in `window[1]` forcing periods after the transient of
        `window[0]`. The peak is the largest `with_m` of `response`.
    near : tuple of float
        Smallest and largest of three peaks [m]: with 2 % less clearance, with the same and with 2 % more.
    settling : float
        Largest displacement from rest [m] during the transient, before the window.
    without, fixed : float
        Peak without ball [m], and with the ball fixed in the box [m].
    absorber, absorber_stroke : float
        Peak with the best linear absorber of the same mass as the ball [m], and its stroke to each side [m].
    off : tuple of float
        Peaks at 0.8 and 1.2 times the clearance [m].
    natural, static : float
        Natural frequency of the machine without ball [Hz], and its static deflection [m] under the force at that
        frequency.
    window : tuple of int
        Forcing periods of the transient and of the window.
    candidates : list of dict
        One row per pair of clearance and restitution: clearance_m, restitution, peak_m from a few initial states. The
        best few pairs have again_m, measured as `peak`, and near_m, the larger value of `near`; for all other pairs
        both are nan. The chosen pair has the smallest near_m.
    response : list of dict
        One row per frequency: frequency_Hz; the displacements without_m, with_m (in the window, the largest of all
        initial states), settling_m (before the window, from rest) and absorber_m. All other entries describe the motion
        behind with_m: impacts_per_s; the mean impact_speed_m_s of the ball against the wall; the mean
        impulse_Ns of an impact; impulse_Ns_per_s; sticking, the share of time that the ball rests on a wall; later_m,
        the displacement in the 1000 periods after the window, which is smaller than with_m if this motion is a
        transient.
    masses : list of dict
        One row per mass of the ball, if several were tried: mass_kg, clearance_m, restitution, peak_m, near_m,
        absorber_m.

    Examples
    --------
    >>> print(vi.design(machine, band=(2.5, 4.0)))  # doctest: +SKIP
    """

    machine: PhysicalSystem
    peak: float
    near: tuple[float, float]
    settling: float
    without: float
    fixed: float
    absorber: float
    absorber_stroke: float
    off: tuple[float, float]
    natural: float
    static: float
    window: tuple[int, int]
    candidates: list[dict]
    response: list[dict]
    masses: list[dict] = field(default_factory=list)

    def __str__(self):
        machine, worst = self.machine, max(self.response, key=lambda row: row["with_m"])
        hardest = max(self.response, key=lambda row: row["impact_speed_m_s"])
        narrow, wide = map(_mm, self.off)
        verdict = f"{1 - self.peak / self.without:.0%} less" if self.peak < self.without else "no less"
        settled = "" if self._settled(worst) else " (not settled where it is largest, see below)"
        waited, watched = self.window
        return "\n".join([
            f"natural frequency {self.natural:.4g} Hz, static deflection {_mm(self.static)}",
            *self._of_masses(),
            f"clearance {1000 * machine.L:.10g} mm to each side, restitution {machine.kappa:g}",
            f"largest displacement {_mm(self.peak)} once settled{settled}: {verdict} than {_mm(self.without)} without "
            "ball",
            f"  {_mm(self.near[0])} to {_mm(self.near[1])} with clearances within {NEAR:.0%} of it",
            f"  {_mm(self.settling)} while it settles from rest",
            f"  ball fixed in its box {_mm(self.fixed)}",
            f"  best linear absorber of its mass {_mm(self.absorber)}, which needs {_mm(self.absorber_stroke)} to each "
            "side",
            f"  with 20 % less clearance {narrow}, with 20 % more {wide}",
            f"at {worst['frequency_Hz']:.4g} Hz, where it is largest: {worst['impacts_per_s']:.3g} impacts/s of "
            f"{worst['impulse_Ns']:.3g} N s each, {worst['impulse_Ns_per_s']:.3g} N s per second, at rest on a wall "
            f"for {worst['sticking']:.0%} of the time",
            f"hardest impacts {hardest['impact_speed_m_s']:.3g} m/s (mean at {hardest['frequency_Hz']:.4g} Hz)",
            f"Settled: in {watched} periods of the force after {waited}, the largest of {MORE_STARTS} starts.",
            *self._warnings(),
            "The walls are rigid, so an impact has an impulse but no finite force.",
        ])  # fmt: skip

    def plot(self):
        """Return a Matplotlib Figure of the displacements in `response` against the frequency.

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

    def _of_masses(self):
        for row in self.masses:
            ball = f"clearance {1000 * row['clearance_m']:.10g} mm, restitution {row['restitution']:g}"
            yield (
                f"with {row['mass_kg']:.4g} kg {_mm(row['peak_m'])} ({ball}), "
                f"best linear absorber {_mm(row['absorber_m'])}"
            )
        if self.masses:
            yield f"the lowest, with {self.machine.m:.4g} kg:"

    def _settled(self, row):
        return self.peak <= FRAGILE * row["later_m"]

    def _warnings(self):
        """Yield a line for each warning about the design."""
        machine, first, last = self.machine, self.response[0]["frequency_Hz"], self.response[-1]["frequency_Hz"]
        for name, value in (("restitution", machine.kappa), ("clearance_m", machine.L)):
            tried = sorted({row[name] for row in self.candidates})
            if len(tried) > 1 and value in (tried[0], tried[-1]):
                end, better = ("smallest", "smaller") if value == tried[0] else ("largest", "larger")
                yield f"The {name.removesuffix('_m')} is the {end} of those tried; a {better} one may be better."
        worst = max(self.response, key=lambda row: row["with_m"])
        if not self._settled(worst):
            later = f"{_mm(worst['later_m'])} in the {LATER} periods that follow"
            yield f"At {worst['frequency_Hz']:.4g} Hz the largest motion had not settled: it is at most {later}."
        if self.near[1] > FRAGILE * self.peak:
            more = self.near[1] / self.peak - 1
            yield f"Fragile: with clearances within {NEAR:.0%} of it the peak is up to {more:.0%} higher."
        if not first <= self.natural <= last:
            yield f"No resonance without ball lies in the band from {first:.4g} to {last:.4g} Hz."
        if machine.m > machine.M:
            yield f"The ball of {machine.m:.4g} kg is heavier than its machine of {machine.M:.4g} kg."


def design(
    machine: PhysicalSystem,
    band: tuple[float, float],
    clearances: Sequence[float] | None = None,
    restitutions: Sequence[float] = RESTITUTIONS,
    progress: bool = True,
    masses: Sequence[float] | None = None,
) -> Design:
    """Design a ball absorber: find clearance and restitution coefficient with the lowest peak over a band.

    A machine and its mirror image (the force -F) have the same design, to the last digit.

    Parameters
    ----------
    machine : PhysicalSystem
        One machine, see `PhysicalSystem.single`; its own L, kappa and forcing frequency are ignored.
    band : tuple of float
        First and last frequency of the force [Hz].
    clearances : sequence of float, optional
        Candidates [m]. By default 8 values from 1/4 to 4 times (F / k) (M / m), none above the amplitude without ball
        (a box that moves less than its clearance never hits a ball at rest); then further values near the best ones.
    restitutions : sequence of float, default RESTITUTIONS
        Candidates, each between 0 and 1.
    progress : bool, default True
        Count the candidates on standard error, if it is a terminal.
    masses : sequence of float, optional
        Candidate masses of the ball [kg], each with its own design; by default only the mass in `machine`.

    Returns
    -------
    Design
        The best design, with the response and all candidates.

    Raises
    ------
    ValueError
        If an argument is malformed, if the machine is coupled, or if it has no damper or no force.
    ArithmeticError
        If a run could not be finished.

    Examples
    --------
    >>> machine = vi.PhysicalSystem.single(M=100.0, m=5.0, k=4e4, c=40.0, F=20.0)
    >>> found = vi.design(machine, band=(2.5, 4.0))  # doctest: +SKIP
    """
    instance("machine", machine, PhysicalSystem)
    restitutions = _choices("restitutions", restitutions, 1.0)
    clearances = clearances if clearances is None else _choices("clearances", clearances, math.inf)
    masses = [machine.m] if masses is None else _choices("masses", masses, math.inf)
    found = [_designed(_Study(replace(machine, m=m), band), clearances, restitutions, progress) for m in masses]
    chosen = min(found, key=lambda one: (one.near[1], one.peak))
    rows = [
        {
            "mass_kg": one.machine.m, "clearance_m": one.machine.L, "restitution": one.machine.kappa,
            "peak_m": one.peak, "near_m": one.near[1], "absorber_m": one.absorber,
        }
        for one in found
    ]  # fmt: skip
    return replace(chosen, masses=rows) if len(found) > 1 else chosen


def _choices(name, values, end) -> list[float]:
    """Return `values` in ascending order, after a check that each is above 0 and below `end`.

    Raises
    ------
    ValueError
        If a value is outside this range, or if there are no values; the message begins with `name`.
    """
    given = np.unique(reals(name, values)).tolist()
    if not given or not 0 < given[0] <= given[-1] < end:
        upper = f" and below {end:g}" if end < math.inf else ""
        raise ValueError(f"{name}: got {given}, expected one or more numbers above 0{upper}")
    return given


def _designed(study, clearances, restitutions, progress) -> Design:
    """Return the design for one mass of the ball."""
    widest = study.linear(without_balls)
    if clearances is None:
        scale = study.static * study.machine.M / study.machine.m
        coarse = np.geomspace(
            min(scale / CLEARANCE_FACTOR, widest / WIDEST_FACTOR),
            min(CLEARANCE_FACTOR * scale, widest),
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
        machine = replace(study.machine, L=row["clearance_m"], kappa=row["restitution"])
        measured, *beside = (study.measured(machine, factor) for factor in (1.0, 1 - NEAR, 1 + NEAR))
        peaks = [measured.peak, *(one.peak for one in beside)]
        row |= {"again_m": measured.peak, "near_m": max(peaks)}
        finalists.append((max(peaks), measured.peak, min(peaks), measured))
    highest, _, lowest, measured = min(finalists, key=lambda one: one[:2])
    absorber = tuned(study.system, best_tuning(study.system, study.band, study.scale), study.scale)
    return Design(
        machine=replace(study.given, L=measured.machine.L, kappa=measured.machine.kappa),
        peak=measured.peak,
        near=(lowest, highest),
        settling=float(measured.settling.max()),
        without=widest,
        fixed=study.linear(fixed_balls),
        absorber=study.machine.L * absorber.peak(study.band),
        absorber_stroke=study.machine.L * absorber.stroke(study.band),
        off=tuple(study.measured(measured.machine, factor).peak for factor in SENSITIVITY_FACTORS),
        natural=study.hertz,
        static=study.static,
        window=(study.wait, WINDOW),
        candidates=rows,
        response=study.response(measured, absorber),
    )


def _best(rows) -> list[dict]:
    """Return the FEW rows with the lowest peaks."""
    return sorted(rows, key=lambda row: row["peak_m"])[:FEW]


def _rounded(clearance) -> float:
    return float(f"{clearance:.{DIGITS}g}")


def _mm(metres) -> str:
    return f"{1000 * metres:.3g} mm"


@dataclass(frozen=True, eq=False)
class _Measured:
    """Response of a machine with its ball at n frequencies, from m initial states.

    largest: (n, m), largest displacement [m] in the window. settling: (n,), largest displacement [m] before the window,
    from rest. states, finals: (n, m, 8), at the start and end of the window.
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
    """Simulations of one machine over a band, with their frequencies, numbers of cycles and initial states."""

    def __init__(self, machine, band):
        low, high = checked_band(band)
        if not machine.c1 or not machine.F10:
            raise ValueError(
                f"machine: got c = {machine.c1} and the force {machine.F10}; expected a damping c above 0, and "
                "one of F, base and unbalance other than 0"
            )
        natural = {"omega1": machine.omega10, "omega2": machine.omega10}
        # Only |F| is used: with -F, the same results would need mirrored initial states.
        self.given, self.machine = machine, replace(machine, F10=abs(machine.F10), L=1.0, **natural)
        self.hertz, self.static = machine.omega10 / (2 * math.pi), self.machine.F10 / machine.k1
        self.system, self.band = self.machine.dimensionless(), (low / self.hertz, high / self.hertz)
        if self.system.modules != (1,):
            raise ValueError(
                "machine: got two machines, coupled or both with a force; expected one, see PhysicalSystem.single"
            )
        ratio = machine.c1 / (2 * machine.M * machine.omega10)
        width = 2 * ratio * self.hertz
        self.frequencies = np.linspace(low, high, min(max(LEAST, math.ceil(PER_WIDTH * (high - low) / width)), MOST))
        self.settle = min(math.ceil(SETTLED / (2 * math.pi * ratio)), LONGEST)
        self.wait = max(self.settle, LONG)

    def linear(self, reference) -> float:
        """Return the peak [m] over the band of the linear system that `reference` builds."""
        return self.machine.L * reference(self.system, self.scale).peak(self.band)

    def scale(self, Omega):
        """Return the force at the dimensionless frequencies `Omega`, divided by the force at Omega = 1."""
        return self.machine.force(Omega * self.machine.omega10) / self.machine.F10 * np.ones_like(Omega)

    def tried(self, pairs: Sequence[tuple[float, float]], progress: bool) -> list[dict]:
        """Return a row per pair of clearance and restitution, with the peak from a few initial states."""
        rows, states = [], self._starts(FEW_STARTS, 1)
        for L, kappa in track(pairs, "design: candidates tried", progress):
            systems = self._systems(replace(self.machine, L=L, kappa=kappa))[::2]
            runs = finished(ensemble(np.array(systems)[:, None], states, self.settle + SHORT, settle=self.settle))
            height = L * float(runs["largest"][..., 0].max())
            rows.append(
                {"clearance_m": L, "restitution": kappa, "peak_m": height, "again_m": math.nan, "near_m": math.nan}
            )
        return rows

    def measured(self, machine, factor: float) -> _Measured:
        """Return the response of a machine with `factor` times its clearance, from more initial states."""
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
            self.machine.L * linear.amplitudes(self.frequencies / self.hertz)[:, 0]
            for linear in (without_balls(self.system, self.scale), absorber)
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
    """Return the impact statistics of ball 1 and the share of time that it rests on a wall, in SI units."""
    events = run.events[run.events["module"] == 1]
    states = events["state"][events["kind"] == IMPACT]
    seconds = run.cycles * run.system.period / machine.omega10
    speeds = machine.L * machine.omega10 * np.abs(states[:, 4] - states[:, 5]) / machine.kappa  # before impacts
    impulses = machine.m / (1 + run.system.epsilon) * (1 + machine.kappa) * speeds
    return {
        "impacts_per_s": len(states) / seconds,
        "impact_speed_m_s": float(speeds.mean()) if len(speeds) else 0.0,
        "impulse_Ns": float(impulses.mean()) if len(impulses) else 0.0,
        "impulse_Ns_per_s": float(impulses.sum()) / seconds,
        "sticking": _at_rest(events, run) / (run.cycles * run.system.period),
    }


def _at_rest(events, run):
    """Return the total time tau during which the ball rests on a wall.

    The ball rests from a stick (or the start of the run) to the next release (or the end of the run).
    """
    changes = events[np.isin(events["kind"], (STICK, RELEASE))]
    times, sticks = changes["tau"], changes["kind"] == STICK
    ends = np.append(times[1:], run.tau0 + run.cycles * run.system.period)
    first = times[0] - run.tau0 if len(changes) and not sticks[0] else 0.0
    return float((ends - times)[sticks].sum() + first)
