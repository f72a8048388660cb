"""The whole config: its smaller sections, and the conditions across sections."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field, ValidationError, create_model

from vibroimpact.system import System
from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.figures import Figures
from vibroimpact_pipeline.config.messages import described, problems_of
from vibroimpact_pipeline.config.regimes import Regimes
from vibroimpact_pipeline.config.section import Place, Section
from vibroimpact_pipeline.config.sweeps import Sweep

SLOWEST = 1e-3
"""Least forcing frequency: the forcing period, and with it the work of a cycle, grows as one over it."""
PREFIXES = "companion_", "sweep_", "tile_", "table_", "fig10_", "own_"
"""Prefixes reserved for companions, sweeps, the chapter's figures and texts of own figures."""
RULES = {
    *("accuracy", "all", "archive", "claims", "companions", "datapackage", "field", "figure_check", "figures"),
    *("figure_check_strict", "fixed_points", "force_sweep", "gather", "hazards", "index", "method_comparison"),
    *("modulation", "nudge", "orbits", "proofs", "report", "scene_models", "simulation", "stability", "sweeps"),
    *("verdict_grid", "verdicts", "verdicts_by_epsilon", "work_precision"),
}
"""Rules whose names figures and animations, which become rules as well, cannot have."""
Detuning = Annotated[float, Field(ge=-10_000, le=10_000)]


class SystemSection(Section):
    """Dimensionless parameters of all cases that say no other, hatted as in (10.4) and (10.6)."""

    epsilon: fields.Epsilon
    kappa: float = Field(gt=0, lt=1, description="Restitution coefficient")
    alpha12_hat: fields.real("Stiffness of the coupling")
    gamma1_hat: fields.real("Damping of box 1 to ground")
    gamma2_hat: fields.real("Damping of box 2 to ground")
    gamma12_hat: fields.real("Damping of the coupling")
    sigma20_hat: Detuning = Field(description="Detuning of box 2; 1 + epsilon sigma20_hat, its stiffness, is above 0")
    sigma_e_hat: Detuning = Field(description="Detuning of the forcing; 1 + epsilon sigma_e_hat is at least 0.001")


class Parameters(SystemSection):
    """All parameters of one system."""

    f10_hat: fields.Force
    f20_hat: fields.Force

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
    from vibroimpact.exact.orbits.impulse_response import impulse_response
    from vibroimpact.theory.fixed_points.symmetric_points import refuse_free_motion

    refuse_free_motion(system)
    for sign in (1, -1) if system.modules else ():
        impulse_response(system, sign)


class Simulation(Section):
    """The direct integration of a case: a discarded transient, and a window."""

    initial_state: fields.State
    transient_cycles: fields.count("Cycles before the window [forcing periods]", 0)
    window_cycles: fields.count("Cycles that are kept [forcing periods]", 1, 1000)
    samples_per_cycle: int = Field(ge=8, le=1000, multiple_of=2, description="Samples in a cycle, an even number")
    digits: fields.count("Decimal digits of the motion; absent: doubles", 20, 2000) | None = None


OWN = {name: (Annotated[field.annotation, field] | None, None) for name, field in SystemSection.model_fields.items()}


class Case(create_model("OwnParameters", __base__=Section, **OWN)):
    """A system, by its forcing amplitudes and whatever differs from `system`, and its direct integration."""

    title: fields.Title | None = None
    f10_hat: fields.Force = Field(description="Excitation amplitude of box 1, in anti-phase if negative")
    f20_hat: fields.Force = Field(description="Excitation amplitude of box 2")
    simulation: Simulation


class Companion1005(Section):
    """Companion of figure 10.5."""

    C_range: fields.around(0.6, fields.HIGHEST) = Field(description="Ends of the axis, which holds the derived limits")


class VerdictGrid(fields.ForceGrid):
    """The theory's verdicts against exact orbits, at the centres of points x points cells of forces."""

    epsilon: fields.items(fields.Epsilon, 1, 20, "Values at which the exact orbits are looked for")


class Stability(Section):
    """The axis of the companion of figure 10.5, and the grid for judging the criteria."""

    companion_10_05: Companion1005
    verdict_grid: VerdictGrid


class Problem(Section):
    """A test problem of the work-precision chart; every method and the reference run it many times."""

    case: fields.CaseName
    initial_state: fields.State
    cycles: fields.count("Length [forcing periods]", 1, 100)


class Benchmark(Problem):
    """The motion of `make benchmark`."""

    cycles: fields.count("Length [forcing periods]", 1, 1000)


class Accuracy(Section):
    """The motions for measuring methods, and the duration of each timing."""

    effort: Literal["quick", "full"] = Field("quick", description="full: longer timings, all stress tests [minutes]")
    short_seconds: fields.real("Repeat a timing for so long, in the default build [s]", 1e-3, 1)
    full_seconds: fields.real("The same in the full form [s]", 1e-3, 60)
    problems: fields.named(Problem, 1, 3, fields.TITLE) = Field(description="Test problems by free titles")
    benchmark: Benchmark


class Animation(Section):
    """The first cycles of a case's simulated window."""

    case: fields.CaseName
    cycles: fields.count("Cycles shown, no more than the window has [forcing periods]", 1, 1000)


class ForceSweep(Section):
    """The slider on the page of fixed points: f20_hat varies, all else is as in the case."""

    case: fields.CaseName
    range: fields.Forces
    values: fields.count("Values of f20_hat", 2, fields.MOST)
    C_max: fields.Amplitude = Field(description="Right end of the planes")

    def conditions(self):
        if self.range[1] - self.range[0] < 1e-6 * (self.values - 1):
            yield ("values",), f"{self.values} in {self.range} are not all different in six decimals"


class Report(Section):
    """The live parts of the report: animations, and the slider of the fixed points."""

    animations: fields.named(Animation, 0, 10) = Field(description="Animations by free names")
    force_sweep: ForceSweep


class Config(Section):
    """All settings of a build: dimensionless except machines, times in forcing periods."""

    system: SystemSection
    # At most twelve: companions have a panel for each.
    cases: fields.named(Case, 1, 12, fields.CASE) = Field(
        description="Systems and their direct integration by name: a small letter, then 1 to 39 of a-z 0-9 - _"
    )
    default_case: fields.CaseName | None = Field(None, description="Case of entries that name none; absent: the first")
    figures: Figures
    stability: Stability
    regimes: Regimes
    accuracy: Accuracy
    tile_seconds: float = Field(20.0, gt=0, le=1e5, description="Cut sweeps into jobs of about so long [core seconds]")
    report: Report
    sweeps: fields.named(Sweep, 0, 100) = Field({}, description="Questions of one's own, by name; companions draw some")

    def conditions(self):
        yield from self._taken_names()
        yield from self._unsound()
        for name, sweep in self.sweeps.items():
            for place, what in sweep.not_drawn(name):
                yield ("sweeps", name, *place), what
        for name, shown in self.report.animations.items():
            if shown.cycles > (kept := self.cases[shown.case].simulation.window_cycles):
                what = f"{shown.cycles} is above {kept}, window_cycles of the case {shown.case}"
                yield ("report", "animations", name, "cycles"), what

    def _taken_names(self):
        """Yield figures, animations and sweeps whose names are taken already."""
        own = [("figures", name) for name in self.figures.model_extra]
        for *section, name in own + [("report", "animations", name) for name in self.report.animations]:
            twice = section[0] == "report" and ("figures", name) in own
            if twice or name in RULES or name.startswith(PREFIXES):
                what = f"the name is that of a rule or another figure, or begins with {', '.join(PREFIXES)}"
                yield (*section, name), what
        if "self" in self.sweeps:
            yield ("sweeps", "self"), "a sweep cannot have this name, which Snakemake gives to an argument"

    def _unsound(self):
        """Yield errors of parameters that no System takes: those of the cases, or else where parameters move."""
        systems, found = {}, False
        for name, case in self.cases.items():
            own = case.model_dump(exclude={"title", "simulation"}, exclude_none=True)
            systems[name] = dict(self.system) | own
            for place, what in _amiss(systems[name]):
                found = True
                yield ("system", *place) if {*place} - own.keys() else ("cases", name, *place), what
        for place, case, moved in () if found else self._moves():
            at = ", ".join(f"{name} = {value:g}" for name, value in moved.items())
            for one in [case] if case else systems:
                for key, what in _amiss(systems[one] | moved):
                    yield place, f"at {at}: {': '.join([*key, what])}"

    def _moves(self) -> Iterator[tuple[Place, str | None, dict[str, float]]]:
        """Yield changed parameters: the place of the change, its case (None: all), and the parameters by name."""
        branches, grid, regimes = self.regimes.branches, self.stability.verdict_grid, self.regimes
        for number, path in enumerate(branches.paths):
            for end in path.range:
                yield ("regimes", "branches", "paths", number), branches.case, dict.fromkeys(path.along, end)
        lists = {("stability", "verdict_grid"): grid.epsilon, ("regimes", "epsilon"): regimes.epsilon.epsilon}
        for place, values in (lists | {("regimes", "asymmetric"): regimes.asymmetric.epsilon}).items():
            for value in values:
                yield place, None, {"epsilon": value}
        for name, sweep in self.sweeps.items():
            for moved in sweep.corners():
                yield ("sweeps", name), sweep.case, moved


def _amiss(parameters):
    """Return why parameters are not valid for a System, each problem with its place; none if they are."""
    try:
        Parameters.model_validate(parameters)
    except ValidationError as error:
        return [(place, described(details)) for place, details in problems_of(error).items()]
    return []
