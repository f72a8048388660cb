"""The design of a ball absorber for one machine in SI units: which clearance and restitution, and what they achieve.

The machine is a mass on a spring and a damper, driven by F sin(2 pi f t) over a band of frequencies f. Candidates are
compared by their peak: the largest displacement over the band, from rest and from other starts. A peak that is seen
from a few starts is at most the true one, and the lowest of many such peaks is lower still. So the design that is
chosen is measured again, from other and more starts at twice as many frequencies.
"""

import math
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from vibroimpact.absorbers.peaks import Peak, peak
from vibroimpact.absorbers.references import fixed_balls, tuned, without_balls
from vibroimpact.absorbers.tuning import best
from vibroimpact.exact.engine.ensemble import ensemble
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.regimes.classification import starts as spread_starts
from vibroimpact.system import PhysicalSystem
from vibroimpact.system.arguments import instance, pair, reals
from vibroimpact.system.state import IMPACT, RELEASE, STICK

RESTITUTIONS = (0.3, 0.5, 0.65, 0.8)
"""Restitution coefficients that are tried if none is asked for: a damped pair of steels has some 0.6."""
NARROWEST, COARSE, FINE = 1 / 32, 12, 5
"""The least clearance that is tried, as a share of the amplitude without ball; clearances first, then near the best."""
PER_WIDTH, LEAST, MOST = 6, 41, 801
"""Frequencies in a half-power width of the resonance without ball; in the band at least, at most."""
TRIED, AGAIN = 3, 8
"""Starts that candidates are compared by, and those that the chosen one is measured again from."""
WATCHED, SETTLED, LONGEST = 100, 5, 2000
"""Forcing periods that are watched; time constants of the machine before these; forcing periods of those at most."""
COUNTED = 2000
"""Forcing periods whose impacts are counted: where the motion is chaotic, 100 give their rate to 15 % only."""
OFF = (0.8, 1.2)
"""Clearances of the sensitivity, over that of the design."""


@dataclass(frozen=True, eq=False)
class Design:
    """A ball for one machine, and what it achieves over the band of frequencies. Displacements are amplitudes [m].

    machine: the chosen one, with its clearance `L` [m], half of the play, and restitution coefficient `kappa`.
    peak: largest displacement over the band [m], measured again; spread: its bootstrap spread [m], no bound.
    without: peak without ball [m]. fixed: with the ball fixed in the box [m]. absorber: of the best linear absorber of
        the mass of the ball [m]; absorber_stroke: how far that moves to each side [m].
    off: peaks at 0.8 and 1.2 times the clearance [m].
    candidates: a row per pair tried: clearance_m, restitution, peak_m.
    response: a row per frequency: frequency_Hz; displacement without ball, with it (the largest of all starts) and with
        the absorber [m]; then of that motion with the ball: impacts_per_s, the mean impact_speed_m_s of the ball
        against the wall, the mean impulse_Ns of an impact, impulse_Ns_per_s, and sticking, the share of time that the
        ball rests on a wall.
    """

    machine: PhysicalSystem
    peak: float
    spread: float
    without: float
    fixed: float
    absorber: float
    absorber_stroke: float
    off: tuple[float, float]
    candidates: list[dict]
    response: list[dict]

    def __str__(self):
        mm, machine = 1000.0, self.machine
        worst = max(self.response, key=lambda row: row["with_m"])
        hardest = max(self.response, key=lambda row: row["impact_speed_m_s"])
        narrow, wide = (f"{mm * value:.3g}" for value in self.off)
        verdict = f"{1 - self.peak / self.without:.0%} less" if self.peak < self.without else "no less"
        return "\n".join([
            f"clearance {mm * machine.L:.3g} mm to each side, restitution {machine.kappa:g}",
            f"largest displacement {mm * self.peak:.3g} mm: {verdict} than {mm * self.without:.3g} mm without ball",
            f"  ball fixed in its box {mm * self.fixed:.3g} mm",
            f"  best linear absorber of its mass {mm * self.absorber:.3g} mm, which needs "
            f"{mm * self.absorber_stroke:.3g} mm to each side",
            f"  with 20 % less clearance {narrow} mm, with 20 % more {wide} mm",
            f"at {worst['frequency_Hz']:.4g} Hz, where it is largest: {worst['impacts_per_s']:.3g} impacts/s of "
            f"{worst['impulse_Ns']:.3g} N s each, {worst['impulse_Ns_per_s']:.3g} N s per second, at rest on a wall "
            f"for {worst['sticking']:.0%} of the time",
            f"hardest impacts {hardest['impact_speed_m_s']:.3g} m/s (mean at {hardest['frequency_Hz']:.4g} Hz)",
            "The walls are rigid, so an impact has an impulse but no finite force.",
        ])  # fmt: skip


def design(
    machine: PhysicalSystem,
    band: tuple[float, float],
    clearances: Sequence[float] | None = None,
    restitutions: Sequence[float] = RESTITUTIONS,
    progress: bool = False,
) -> Design:
    """Return the clearance and restitution with the lowest peak over a band, with what they achieve.

    Args:
        machine: one machine, see `PhysicalSystem.single`; its own L, kappa and forcing frequency do not count.
        band: first and last frequency of the force [Hz].
        clearances: those to choose from [m]; by default 12 from 1/32 of the amplitude without ball up to it (a box that
            swings less than its clearance never meets a ball at rest), then 4 about the best.
        restitutions: those to choose from, each between 0 and 1.
        progress: count the candidates on standard error.

    Raises:
        ValueError: an argument is malformed; the machine is not alone, or has no damper or no force.
        ArithmeticError: a run could not be finished.
    """
    study = _Study(machine, band)
    restitutions = np.unique(reals("restitutions", restitutions)).tolist()
    if not restitutions or not 0 < restitutions[0] <= restitutions[-1] < 1:
        raise ValueError(f"restitutions: {restitutions}; needs one or more numbers above 0 and below 1")
    widest = study.linear(without_balls)
    if clearances is None:
        rows = study.tried(np.geomspace(NARROWEST, 1.0, COARSE) * widest, restitutions, progress)
        step = NARROWEST ** (-1 / (COARSE - 1))
        middle = min(rows, key=lambda row: row["peak_m"])["clearance_m"]
        near = middle * np.geomspace(1 / step, step, FINE + 2)[1:-1]
        rows += study.tried([L for L in near if middle != L], restitutions, progress)
    else:
        given = np.unique(reals("clearances", clearances)).tolist()
        if not given or not 0 < given[0] <= given[-1] < math.inf:
            raise ValueError(f"clearances: {given}; needs one or more numbers above 0 [m]")
        rows = study.tried(given, restitutions, progress)
    chosen = min(rows, key=lambda row: row["peak_m"])
    machine = replace(study.machine, L=chosen["clearance_m"], kappa=chosen["restitution"])
    again = study.peak(machine, AGAIN, seed=2, finer=2)
    absorber = tuned(study.system, best(study.system, study.band))
    return Design(
        machine,
        machine.L * again.value,
        machine.L * again.spread,
        widest,
        study.linear(fixed_balls),
        study.machine.L * absorber.peak(study.band),
        study.machine.L * absorber.stroke(study.band),
        tuple(machine.L * f * study.peak(replace(machine, L=f * machine.L), AGAIN, seed=3).value for f in OFF),
        rows,
        study.response(machine, absorber),
    )


class _Study:
    """A machine over a band: the frequencies that are looked at, how long, and from which starts."""

    def __init__(self, machine, band):
        machine = instance("machine", machine, PhysicalSystem)
        low, high = pair("band", band)
        if not 0 < low < high:
            raise ValueError(f"band: ({low}, {high}) Hz; needs 0 < low < high")
        if machine.k12 or machine.c12 or machine.F20:
            raise ValueError("machine: it is coupled to another one, or that is driven; see PhysicalSystem.single")
        if not machine.c1 or not machine.F10:
            raise ValueError("machine: needs a damper c above 0 and a force F other than 0")
        self.machine, self.hertz = machine, machine.omega10 / (2 * math.pi)
        self.system, self.band = machine.dimensionless(), (low / self.hertz, high / self.hertz)
        ratio = machine.c1 / (2 * machine.M * machine.omega10)
        width = 2 * ratio * self.hertz
        self.frequencies = np.linspace(low, high, min(max(LEAST, math.ceil(PER_WIDTH * (high - low) / width)), MOST))
        self.settle = min(math.ceil(SETTLED / (2 * math.pi * ratio)), LONGEST)

    def linear(self, reference) -> float:
        """The peak of a linear system in place of the machine [m]."""
        return self.machine.L * reference(self.system).peak(self.band)

    def tried(self, clearances: Iterable[float], restitutions, progress: bool) -> list[dict]:
        """A row per pair, with the peak as few starts see it."""
        pairs = [(float(L), kappa) for kappa in restitutions for L in clearances]
        rows = []
        for L, kappa in _counted(pairs, progress):
            height = L * self.peak(replace(self.machine, L=L, kappa=kappa), TRIED, seed=1).value
            rows.append({"clearance_m": L, "restitution": kappa, "peak_m": height})
        return rows

    def peak(self, machine, starts: int, seed: int, finer: int = 1) -> Peak:
        """The dimensionless peak of a machine with its ball over the band."""
        count = finer * (len(self.frequencies) - 1) + 1
        frequencies = np.linspace(self.frequencies[0], self.frequencies[-1], count)
        return peak(self._systems(machine, frequencies), _starts(starts, seed), self.settle + WATCHED, self.settle)

    def response(self, machine, absorber) -> list[dict]:
        """The rows of `Design.response`."""
        L, unit, systems = machine.L, self.machine.L, self._systems(machine, self.frequencies)
        runs = ensemble(np.array(systems)[:, None], _starts(AGAIN, 2), self.settle + WATCHED, settle=self.settle)
        largest = runs["largest"][:, :, 0]
        worst = largest.argmax(axis=1)
        linear = [
            system.amplitudes(self.frequencies / self.hertz)[:, 0] for system in (without_balls(self.system), absorber)
        ]
        rows = []
        for k, (system, start) in enumerate(zip(systems, worst, strict=True)):
            heights = {"without_m": linear[0][k], "with_m": largest[k, start] * L / unit, "absorber_m": linear[1][k]}
            row = {"frequency_Hz": self.frequencies[k]} | {name: unit * value for name, value in heights.items()}
            run = simulate(system, runs["final"][k, start], COUNTED)
            rows.append({name: float(value) for name, value in row.items()} | _impacts(machine, run))
        return rows

    def _systems(self, machine, frequencies):
        omegas = (2 * math.pi * frequencies).tolist()
        return [replace(machine, omega1=omega, omega2=omega).dimensionless() for omega in omegas]


def _starts(count, seed):
    """Rest, and other starts of machine 1, evenly spread; machine 2 rests, which nothing drives."""
    states = spread_starts(count, seed)
    states[:, [2, 3, 6, 7]] = 0.0
    return states


def _impacts(machine, run) -> dict:
    """Speeds and impulses of the impacts of ball 1 in a run, in SI units, and its share of time on a wall."""
    events = run.events[run.events["module"] == 1]
    states = events["state"][events["kind"] == IMPACT]
    seconds = run.cycles * run.system.period / machine.omega10
    speeds = machine.L * machine.omega10 * np.abs(states[:, 4] - states[:, 5]) / machine.kappa  # before the impact
    impulses = machine.m / (1 + run.system.epsilon) * (1 + machine.kappa) * speeds
    rests, spans = _at_rest(events, run), run.cycles * run.system.period
    return {
        "impacts_per_s": len(states) / seconds,
        "impact_speed_m_s": float(speeds.mean()) if len(speeds) else 0.0,
        "impulse_Ns": float(impulses.mean()) if len(impulses) else 0.0,
        "impulse_Ns_per_s": float(impulses.sum()) / seconds,
        "sticking": rests / spans,
    }


def _at_rest(events, run):
    """Time tau between each stick and its release, or the ends of the run."""
    changes = events[np.isin(events["kind"], (STICK, RELEASE))]
    times, sticks = changes["tau"], changes["kind"] == STICK
    ends = np.append(times[1:], run.tau0 + run.cycles * run.system.period)
    first = times[0] - run.tau0 if len(changes) and not sticks[0] else 0.0
    return float((ends - times)[sticks].sum() + first)


def _counted(pairs, progress):
    """Yield the pairs; count them on standard error if asked for."""
    for number, one in enumerate(pairs, start=1):
        if progress:
            print(
                f"\rdesign {number}/{len(pairs)}", end="\n" if number == len(pairs) else "", file=sys.stderr, flush=True
            )
        yield one
