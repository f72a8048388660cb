"""The config of the chapter, config/config.yaml: its smaller sections, and the conditions across sections."""

from collections.abc import Iterable, Iterator
from typing import Annotated, Literal

from pydantic import Field, ValidationError, create_model

from vibroimpact.system import System
from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.figures import Figures
from vibroimpact_pipeline.config.messages import described, problems_of
from vibroimpact_pipeline.config.section import Place, Section

SLOWEST = 1e-3
"""Least forcing frequency: the forcing period, and with it the work of a cycle, grows as one over it."""
PREFIXES = "companion_", "sweep_", "tile_", "table_", "fig10_", "own_", "pages_"
"""Prefixes reserved for companions, sweeps, the chapter's figures, texts of own figures and pages."""
RULES = {
    *("accuracy", "all", "archive", "claims", "companions", "datapackage", "field", "figure_check", "figures"),
    *("figure_check_strict", "fixed_points", "force_sweep", "gather", "grazing", "index", "method_comparison"),
    *("models", "modulation", "nudge", "proofs", "report", "simulation", "stability", "studies"),
    *("study_check", "study_check_strict", "sweeps", "verdict_grid", "verdicts_by_epsilon"),
    *("stress_tests", "work_precision"),
}
"""Rules whose names figures and other entries, which become rules as well, cannot have."""
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
    digits: fields.count("Decimal digits that model: reference begins with; absent: 40", 20, 2000) | None = None


OWN = {name: (Annotated[field.annotation, field] | None, None) for name, field in SystemSection.model_fields.items()}


class Case(create_model("OwnParameters", __base__=Section, **OWN)):
    """A system, by its forcing amplitudes and whatever differs from `system`, and its direct integration."""

    title: fields.Title | None = None
    f10_hat: fields.Force = Field(description="Excitation amplitude of box 1, in anti-phase if negative")
    f20_hat: fields.Force = Field(description="Excitation amplitude of box 2")
    simulation: Simulation


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
    full_seconds: fields.real("The same with effort: full [s]", 1e-3, 60)
    problems: fields.named(Problem, 1, 3, fields.TITLE) = Field(description="Test problems by free titles")
    benchmark: Benchmark


class Config(Section):
    """The chapter: system, cases, figures, accuracy. Dimensionless; times in forcing periods."""

    system: SystemSection
    # At most twelve: companions have a panel for each.
    cases: fields.named(Case, 1, 12, fields.CASE) = Field(
        description="Systems and their direct integration by name: a small letter, then 1 to 39 of a-z 0-9 - _"
    )
    default_case: fields.CaseName | None = Field(None, description="Case of entries that name none; absent: the first")
    figures: Figures
    accuracy: Accuracy

    def conditions(self):
        yield from self.taken_names()
        yield from self.unsound()

    def named_rules(self) -> Iterator[Place]:
        """Yield the places of entries whose names become names of rules."""
        yield from (("figures", name) for name in self.figures.model_extra)

    def taken_names(self):
        """Yield entries whose names are taken already."""
        places = [*self.named_rules()]
        for place in places:
            name = place[-1]
            twice = [other[-1] for other in places].count(name) > 1 and place[0] != "figures"
            if twice or name in RULES or name.startswith(PREFIXES):
                what = f"the name is that of a rule or another figure, or begins with {', '.join(PREFIXES)}"
                yield place, what

    def unsound(self):
        """Yield errors of parameters that no System takes: those of the cases, or else where parameters move."""
        systems, found = {}, False
        for name, case in self.cases.items():
            own = case.model_dump(exclude={"title", "simulation"}, exclude_none=True)
            systems[name] = dict(self.system) | own
            for place, what in _amiss(systems[name]):
                found = True
                yield ("system", *place) if {*place} - own.keys() else ("cases", name, *place), what
        for place, case, moved in () if found else self.moves():
            at = ", ".join(f"{name} = {value:g}" for name, value in moved.items())
            for one in [case] if case else systems:
                for key, what in _amiss(systems[one] | moved):
                    yield place, f"at {at}: {': '.join([*key, what])}"

    def moves(self) -> Iterable[tuple[Place, str | None, dict[str, float]]]:
        """Return changed parameters: the place of the change, its case (None: all), and the parameters by name."""
        return ()


def _amiss(parameters):
    """Return why parameters are not valid for a System, each problem with its place; none if they are."""
    try:
        Parameters.model_validate(parameters)
    except ValidationError as error:
        return [(place, described(details)) for place, details in problems_of(error).items()]
    return []
