"""The whole config: its smaller sections, and the conditions across sections."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field, ValidationError

from vibroimpact.system import System
from vibroimpact_pipeline.config import kinds
from vibroimpact_pipeline.config.figures import Figures
from vibroimpact_pipeline.config.messages import problems_of
from vibroimpact_pipeline.config.regimes import Regimes
from vibroimpact_pipeline.config.section import Section, hint, sections
from vibroimpact_pipeline.config.sweeps import Sweep
from vibroimpact_pipeline.specs import specs

SLOWEST = 1e-3
"""Least forcing frequency: the forcing period, and with it the work of a cycle, grows as one over it."""
PREFIXES = "companion_", "sweep_", "tile_", "table_", "fig10_", "own_"
"""Prefixes reserved for companions, sweeps, the chapter's figures and texts of own figures."""
RULES = {
    *("accuracy", "all", "archive", "claims", "coexistence", "companions", "field", "figure_check"),
    *("figure_check_strict", "figures", "fixed_points", "force_sweep", "gather", "hazards", "index", "orbits"),
    *("proofs", "report", "scene_models", "simulation", "stability", "sweeps", "verdict_grid", "verdicts"),
    "work_precision",
}
"""Rules whose names figures and animations, which become rules as well, cannot have."""
Coefficient = Annotated[float, Field(ge=0, le=10_000)]
Detuning = Annotated[float, Field(ge=-10_000, le=10_000)]


class SystemSection(Section):
    """Dimensionless parameters shared by all cases, hatted as in (10.4) and (10.6)."""

    epsilon: kinds.Epsilon
    kappa: float = Field(gt=0, lt=1, description="Restitution coefficient")
    alpha12_hat: Coefficient = Field(description="Stiffness of the coupling")
    gamma1_hat: Coefficient = Field(description="Damping of box 1 to ground")
    gamma2_hat: Coefficient = Field(description="Damping of box 2 to ground")
    gamma12_hat: Coefficient = Field(description="Damping of the coupling")
    sigma20_hat: Detuning = Field(description="Detuning of box 2; 1 + epsilon sigma20_hat, its stiffness, is above 0")
    sigma_e_hat: Detuning = Field(description="Detuning of the forcing; 1 + epsilon sigma_e_hat is at least 0.001")


class Parameters(SystemSection):
    """All parameters of one system: those shared by the cases, and two forcing amplitudes."""

    f10_hat: kinds.Force
    f20_hat: kinds.Force

    def conditions(self):
        try:
            system = System(**dict(self))
            if system.Omega < SLOWEST:
                raise ValueError(f"sigma_e_hat: 1 + epsilon sigma_e_hat = {system.Omega} is below {SLOWEST}")
            _refuse_resonance(system)
        except ValueError as error:
            name, _, what = str(error).partition(": ")
            yield (name,) if name in Parameters.model_fields else (), what


def _refuse_resonance(system):
    """Refuse an undamped system whose periodic responses are not isolated or not bounded."""
    if system.gamma1 > 0 and system.gamma2 > 0:
        return
    # Here, because SciPy takes longer to load than all else that a build with nothing to do needs.
    from vibroimpact.exact.orbits.impulse_response import ImpulseResponse
    from vibroimpact.theory.fixed_points.search import refuse_free_motion

    refuse_free_motion(system)
    for sign in () if system.has_undriven_module else (1, -1):
        ImpulseResponse(system, sign)


class Simulation(Section):
    """The direct integration of a case: a discarded transient, and a window of at most 200 000 samples."""

    initial_state: kinds.State
    transient_cycles: int = Field(ge=0, le=1_000_000, description="Cycles before the window [forcing periods]")
    window_cycles: int = Field(ge=1, le=10_000, description="Cycles that are kept [forcing periods]")
    samples_per_cycle: int = Field(ge=8, le=10_000, multiple_of=2, description="Samples in a cycle, an even number")
    digits: int | None = Field(None, ge=20, le=2000, description="Decimal digits of the motion; absent: doubles")

    # A picture shows no more samples, and its files grow with each; so many digits of so many cycles take hours.
    rules: ClassVar = [
        ("window_cycles", "window_cycles * samples_per_cycle <= 200_000"),
        ("digits", "(digits or 0) * (transient_cycles + window_cycles) <= 5_000_000"),
    ]


class Case(Section):
    """A pair of forcing amplitudes, and the direct integration with them."""

    title: kinds.Title | None = Field(None, description="What titles and captions call the case; absent: its name")
    f10_hat: kinds.Force = Field(description="Excitation amplitude of box 1, in anti-phase if negative")
    f20_hat: kinds.Force = Field(description="Excitation amplitude of box 2")
    simulation: Simulation


class Companion1005(Section):
    """Companion of figure 10.5."""

    C_range: kinds.around(0.6, kinds.HIGHEST) = Field(description="Ends of the axis, which holds the derived limits")


class VerdictGrid(kinds.ForceGrid):
    """The theory's verdicts against exact orbits, at the centres of points x points cells of forces."""

    epsilon: kinds.items(kinds.Epsilon, 1, 20, "Values at which the exact orbits are looked for")

    # Searches for all symmetric orbits, some ten milliseconds each.
    rules: ClassVar = [("points", "points**2 * len(epsilon) <= 1_000_000")]

    def moves(self):
        return [{"epsilon": value} for value in self.epsilon]


class Stability(Section):
    """The axis of the companion of figure 10.5, and the grid for judging the criteria."""

    companion_10_05: Companion1005
    verdict_grid: VerdictGrid


class Problem(Section):
    """A test problem of the work-precision chart; every method and the reference run it many times."""

    case: kinds.CaseName
    initial_state: kinds.State
    cycles: int = Field(ge=1, le=100, description="Length [forcing periods]")


class Benchmark(Problem):
    """The motion of `make benchmark`."""

    cycles: int = Field(ge=1, le=1000, description="Length [forcing periods]")


class Accuracy(Section):
    """The motions for measuring methods, and the duration of each timing."""

    effort: Literal["quick", "full"] = Field("quick", description="full: longer timings, all stress tests [minutes]")
    short_seconds: float = Field(ge=1e-3, le=1, description="Repeat a timing for so long, in the default build [s]")
    full_seconds: float = Field(ge=1e-3, le=60, description="The same in the full form [s]")
    problems: kinds.named(Problem, 1, 3, kinds.TITLE) = Field(description="Test problems by free titles")
    benchmark: Benchmark


class Animation(Section):
    """The first cycles of a case's simulated window."""

    case: kinds.CaseName
    cycles: int = Field(ge=1, le=1000, description="Cycles shown, no more than the window has [forcing periods]")


class ForceSweep(Section):
    """The slider on the page of fixed points: f20_hat varies, all else is as in the case."""

    case: kinds.CaseName
    range: kinds.Forces
    values: int = Field(ge=2, le=1000, description="Values of f20_hat")
    C_max: kinds.Amplitude = Field(description="Right end of the planes")

    # They are written with six decimals.
    rules: ClassVar = [("values", "range[1] - range[0] >= 1e-6 * (values - 1)")]


class Report(Section):
    """The live parts of the report: animations, and the slider of the fixed points."""

    animations: kinds.named(Animation, 0, 10) = Field(description="Animations by free names")
    force_sweep: ForceSweep


class Config(Section):
    """All settings of a build: dimensionless except machines, times in forcing periods."""

    system: SystemSection
    # At most twelve: companions have a panel for each.
    cases: kinds.named(Case, 1, 12, kinds.CASE) = Field(
        description="Forcing amplitudes and direct integration by name: a small letter, then 1 to 39 of a-z 0-9 - _"
    )
    default_case: kinds.CaseName | None = Field(None, description="Case of entries that name none; absent: the first")
    figures: Figures
    stability: Stability
    regimes: Regimes
    accuracy: Accuracy
    tile_seconds: float = Field(20.0, gt=0, le=1e5, description="Cut sweeps into jobs of about so long [core seconds]")
    report: Report
    sweeps: kinds.named(Sweep, 0, 100) = Field({}, description="Questions of one's own, by name; companions draw some")

    def conditions(self):
        yield from self._taken_names()
        if self.default_case not in (None, *self.cases):
            yield ("default_case",), f"unknown case {self.default_case!r}{hint(self.default_case, self.cases)}"
        for place, section, case in sections(self):
            if hasattr(section, "case") and case not in self.cases:
                yield (*place, "case"), f"unknown case {case!r}{hint(case, self.cases)}"
        yield from self._unsound().items()
        for name, sweep in self.sweeps.items():
            for place, what in [*_not_drawn(name, sweep), *sweep.costs(self.regimes.observation)]:
                yield ("sweeps", name, *place), what
        for name, shown in self.report.animations.items():
            if shown.case in self.cases and shown.cycles > (kept := self.cases[shown.case].simulation.window_cycles):
                what = f"{shown.cycles} is above {kept}, window_cycles of the case {shown.case}"
                yield ("report", "animations", name, "cycles"), what

    def _taken_names(self):
        """Yield figures and animations whose names are taken already."""
        own = [("figures", name) for name in self.figures.model_extra]
        for *section, name in own + [("report", "animations", name) for name in self.report.animations]:
            twice = section[0] == "report" and ("figures", name) in own
            if twice or name in RULES or name.startswith(PREFIXES):
                what = f"the name is that of a rule or another figure, or begins with {', '.join(PREFIXES)}"
                yield (*section, name), what

    def _amiss(self, case, **changed):
        """Return why the parameters of a case, some of them changed, are not valid for a System; None if they are."""
        forces = {name: getattr(self.cases[case], name) for name in ("f10_hat", "f20_hat")}
        try:
            Parameters.model_validate({**dict(self.system), **forces, **changed})
        except ValidationError as error:
            return problems_of(error)
        return []

    def _unsound(self):
        """Return problems of the systems of the cases, or else of those reached by moving parameters."""
        found, shared = {}, SystemSection.model_fields.keys()
        for case in self.cases:
            for name, what in self._amiss(case):
                found[("system", *name) if shared & {*name} else ("cases", case, *name)] = what
        moves = [(place, case, move) for place, section, case in sections(self) for move in section.moves()]
        for place, case, move in () if found else moves:
            for one in {case} & self.cases.keys() if case else self.cases:
                at = ", ".join(f"{name} = {value:g}" for name, value in move.items())
                for name, what in self._amiss(one, **move):
                    found.setdefault(place, f"at {at}: {': '.join([*name, what])}")
        return found


def _not_drawn(name, sweep):
    """Yield what a sweep lacks for the companion figures that draw it ("sweeps" in their SPEC)."""
    for figure, spec in specs().items():
        if drawn := spec.get("sweeps", {}).get(name):
            uneven = drawn.get("evenly") and not all(axis.range and axis.scale != "logarithmic" for axis in sweep.axes)
            if uneven or [axis.along for axis in sweep.axes] != drawn["along"]:
                how = ", evenly" if uneven else ""
                yield ("axes",), f"are not {drawn['along']}{how}, as {figure} draws it; take another name"
            if missing := [wanted for wanted in drawn["observe"] if wanted not in sweep.observe]:
                yield ("observe",), f"{' and '.join(missing)} missing, which {figure} draws; take another name"
