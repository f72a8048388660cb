"""Pydantic model of config/config.yaml, with the checks that involve more than one section."""

import re
from collections.abc import Iterable, Iterator
from typing import Annotated, Literal

from pydantic import Field, ValidationError, create_model

from vibroimpact.system import System
from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.figures import Figures
from vibroimpact_pipeline.config.messages import described, problems_of
from vibroimpact_pipeline.config.section import Place, Section
from vibroimpact_pipeline.specs import specs

MIN_FREQUENCY = 1e-3
"""Lowest forcing frequency; the cost to simulate one cycle is inversely proportional to the frequency."""
PREFIXES = "companion_", "sweep_", "tile_", "table_", "fig10_", "pages_"
"""Reserved prefixes: those of the rules for companion figures, sweeps, pages and the figures of the chapter."""
RULES = {
    name
    for path in (ROOT / "workflow").rglob("*.smk")
    for name in re.findall(r"^ *(?:use rule \w+ as|rule) (\w+)", path.read_text("utf-8"), re.MULTILINE)
} | {"all", *(figure for figure, spec in specs().items() if not spec["own"])}
"""Names of existing rules. Figures and other entries that become rules cannot have these names."""
Detuning = Annotated[float, Field(ge=-10_000, le=10_000)]


class SystemSection(Section):
    """Dimensionless default parameters of all cases; the suffix _hat stands for the hat in (10.4) and (10.6)."""

    epsilon: fields.Epsilon
    kappa: float = Field(gt=0, lt=1, description="Restitution coefficient")
    alpha12_hat: fields.real("Stiffness of the coupling")
    gamma1_hat: fields.real("Damping of box 1 to ground")
    gamma2_hat: fields.real("Damping of box 2 to ground")
    gamma12_hat: fields.real("Damping of the coupling")
    sigma20_hat: Detuning = Field(
        description="Detuning of box 2; its stiffness 1 + epsilon sigma20_hat must be above 0"
    )
    sigma_e_hat: Detuning = Field(
        description="Detuning of the forcing; its frequency 1 + epsilon sigma_e_hat must be at least 0.001"
    )


class Parameters(SystemSection):
    """All parameters of one system."""

    f10_hat: fields.Force
    f20_hat: fields.Force

    def conditions(self):
        try:
            system = System(**dict(self))
            if system.Omega < MIN_FREQUENCY:
                raise ValueError(
                    f"sigma_e_hat: the frequency 1 + epsilon sigma_e_hat = {system.Omega} is below {MIN_FREQUENCY}"
                )
            _refuse_resonance(system)
        except ValueError as error:
            name, _, what = str(error).partition(": ")
            yield (name,) if name in Parameters.model_fields else (), what


def _refuse_resonance(system):
    """Raise ValueError for an undamped system whose periodic responses are not isolated or not bounded."""
    if system.gamma1 > 0 and system.gamma2 > 0:
        return
    # These modules load SciPy, which takes longer than a run of Snakemake without jobs. Therefore these modules are
    # imported only if a box is undamped.
    from vibroimpact.exact.orbits.impulse_response import impulse_response
    from vibroimpact.theory.fixed_points.symmetric_points import refuse_free_motion

    refuse_free_motion(system)
    for sign in (1, -1) if system.modules else ():
        impulse_response(system, sign)


class Simulation(Section):
    """Settings of the direct integration of a case, with a transient that is discarded and a window that is kept."""

    initial_state: fields.State
    transient_cycles: fields.count("Length of the transient before the window [forcing periods]", 0)
    window_cycles: fields.count("Length of the window [forcing periods]", 1, 1000)
    samples_per_cycle: int = Field(
        ge=8, le=1000, multiple_of=2, description="Samples per forcing period, an even number"
    )
    digits: fields.count("Initial number of decimal digits for the model reference; default: 40", 20, 2000) | None = (
        None
    )


OVERRIDES = {
    name: (Annotated[field.annotation, field] | None, None) for name, field in SystemSection.model_fields.items()
}


class Case(create_model("Overrides", __base__=Section, **OVERRIDES)):
    """A case: forcing amplitudes, parameters that override `system`, and settings of the direct integration."""

    title: fields.Title | None = None
    f10_hat: fields.Force = Field(description="Forcing amplitude of box 1; negative values reverse the phase")
    f20_hat: fields.Force = Field(description="Forcing amplitude of box 2")
    simulation: Simulation


class Problem(Section):
    """A test problem for the work-precision chart; every integration method solves the problem many times."""

    case: fields.CaseName
    initial_state: fields.State
    cycles: fields.count("Length [forcing periods]", 1, 100)


class Accuracy(Section):
    """Settings of the accuracy charts: test problems for the integration methods, and how long to measure run times."""

    effort: Literal["quick", "full"] = Field(
        "quick", description="quick, or full: longer timings and all stress tests (some minutes)"
    )
    short_seconds: fields.real("Duration of the repetitions of each timing with effort quick [s]", 1e-3, 1)
    full_seconds: fields.real("Duration of the repetitions of each timing with effort full [s]", 1e-3, 60)
    problems: fields.named(Problem, 1, 3, fields.TITLE) = Field(description="Test problems by title")


class Config(Section):
    """Config of the chapter. Parameters are dimensionless. Times are in forcing periods unless a key says otherwise."""

    system: SystemSection
    # At most twelve cases, since companion figures have a panel for each case.
    cases: fields.named(Case, 1, 12, fields.CASE) = Field(
        description="Cases by name: a lower-case letter, then 1 to 39 characters out of a-z 0-9 - _"
    )
    default_case: fields.CaseName | None = Field(
        None, description="Case of all entries that name no case; default: the first case"
    )
    figures: Figures
    accuracy: Accuracy

    def conditions(self):
        yield from self.taken_names()
        yield from self.parameter_errors()

    def named_rules(self) -> Iterator[Place]:
        """Yield the key path of each config entry whose name becomes the name of a Snakemake rule."""
        yield from (("figures", name) for name in self.figures.model_extra)

    def taken_names(self):
        """Yield an error for each entry whose name is already in use or begins with a reserved prefix."""
        places = [*self.named_rules()]
        for place in places:
            name = place[-1]
            twice = [other[-1] for other in places].count(name) > 1 and place[0] != "figures"
            if twice or name in RULES or name.startswith(PREFIXES):
                what = f"name already used by a rule or another figure, or begins with one of {', '.join(PREFIXES)}"
                yield place, what

    def parameter_errors(self):
        """Yield an error for each invalid parameter of a case.

        If all cases are valid, yield an error for each invalid value in `varied_parameters`.
        """
        systems, found = {}, False
        for name, case in self.cases.items():
            overrides = case.model_dump(exclude={"title", "simulation"}, exclude_none=True)
            systems[name] = dict(self.system) | overrides
            for place, what in rejected(systems[name]):
                found = True
                yield ("system", *place) if {*place} - overrides.keys() else ("cases", name, *place), what
        for place, case, moved in () if found else self.varied_parameters():
            at = ", ".join(f"{name} = {value:g}" for name, value in moved.items())
            for one in [case] if case else systems:
                for key, what in rejected(systems[one] | moved):
                    yield place, f"at {at}: {': '.join([*key, what])}"

    def varied_parameters(self) -> Iterable[tuple[Place, str | None, dict[str, float]]]:
        """Return parameter values that entries of the config use in place of the values of a case.

        Each item contains the key path of the entry, the name of a case, and a mapping from parameters to values. If
        the values apply to all cases, the name is None.
        """
        return ()


def rejected(parameters):
    """Return the errors in the parameters of a system, as a list of pairs of key path and message.

    If the parameters are valid, the list is empty.
    """
    try:
        Parameters.model_validate(parameters)
    except ValidationError as error:
        return [(place, described(details)) for place, details in problems_of(error).items()]
    return []
