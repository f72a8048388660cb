"""Section `figures`: which figures are built, each by its notebook.

The chapter's figures keep their notebooks, as their captions do; any other name may be given to a figure of one's own.
"""

from typing import Annotated, ClassVar, Literal

from pydantic import ConfigDict, Field

from vibroimpact_pipeline.config import kinds
from vibroimpact_pipeline.config.section import Section

MOST = 100
"""Figures of a build, a job each."""
NOTEBOOK = Field(description="Its notebook explains and draws it")
MODEL = Field(description="What it is computed with, and nothing dearer")


class Drawing(Section):
    """A drawing to scale."""

    notebook: Literal["drawings"] = NOTEBOOK


class ClosedForm(Section):
    """A figure that is algebra."""

    notebook: Literal["closed_form"] = NOTEBOOK
    model: Literal["closed_form"] = MODEL


class Sawtooth(ClosedForm):
    """Figure 10.3."""

    amplitude: float = Field(ge=1e-3, le=1000, description="C of the saw-tooth")
    theta: float = Field(ge=-100, le=100, description="Phase of the impacts [rad]")
    tau0_max: float = Field(ge=3.15, le=100, description="Right end of the axis; there is an impact within pi [rad]")


class Manifold(ClosedForm):
    """Figure 10.4."""

    C_max: kinds.Amplitude = Field(description="Right end of the axis; the fold of the manifold lies below 1")


class Regions(ClosedForm):
    """Figure 10.5."""

    C_range: kinds.around(0.6, 1.01) = Field(description="Ends of the axis, which holds the limit of (10.26)")


class FixedPoints(Section):
    """Fixed points and singular points of a case on the slow invariant manifold, as in figures 10.6 and 10.9."""

    notebook: Literal["fixed_points"] = NOTEBOOK
    model: Literal["slow_flow"] = MODEL
    case: kinds.CaseName
    C_max: kinds.Planes


class Response(Section):
    """The theoretical response at a fixed point, as in figure 10.7 and, with planes, figure 10.10."""

    notebook: Literal["theoretical_response"] = NOTEBOOK
    model: Literal["slow_flow"] = MODEL
    case: kinds.CaseName
    fixed_point: kinds.Label
    periods: float = Field(ge=0.5, le=100, description="Length of the response [forcing periods]")
    C_max: kinds.Planes | None = Field(None, description="Right ends of the planes; absent: the response alone")


class SimulatedMotion(Section):
    """The second module's motion by direct integration of a case, as in figures 10.8 and 10.11."""

    notebook: Literal["simulation"] = NOTEBOOK
    model: Literal["simulation"] = MODEL
    case: kinds.CaseName


Clearance = Annotated[float, Field(ge=1e-6, le=1e3, description="Half of the play [m]")]
Hertz = Annotated[float, Field(ge=1e-3, le=1e6, description="Frequency of the forces [Hz]")]


def quantity(about: str, least: float = 0.0):
    """Return a field of a plant, from `least` on."""
    return Field(ge=least, le=1e9, description=about)


class Plant(Section):
    """Machines on their springs, as in (10.1), in SI units; without dampers they could not be driven at resonance."""

    M: float = quantity("Mass of a box [kg]", 1e-6)
    m: float = quantity("Mass of a ball [kg], 1e-6 to 10 times that of a box", 1e-6)
    k1: float = quantity("Stiffness of machine 1 to ground [N/m]", 1e-6)
    k2: float = quantity("Stiffness of machine 2 to ground [N/m]", 1e-6)
    k12: float = quantity("Stiffness between them [N/m]")
    c1: float = quantity("Damping of machine 1 to ground [N s/m]", 1e-6)
    c2: float = quantity("Damping of machine 2 to ground [N s/m]", 1e-6)
    c12: float = quantity("Damping between them [N s/m]")
    F10: float = quantity("Amplitude of the force on machine 1 [N]", 1e-6)
    F20: float = quantity("Amplitude of the force on machine 2 [N]")
    kappa: float = Field(ge=0.01, le=0.99, description="Restitution coefficient")

    rules: ClassVar = [("m", "1e-6 <= m / M <= 10")]


class Band(Section):
    """Frequencies, evenly spaced."""

    range: kinds.span(Hertz, "Its ends [Hz]")
    values: int = Field(ge=2, le=1000, description="So many, both ends included")


class Shown(Section):
    """A motion from rest, drawn over time."""

    L: Clearance
    frequency: Hertz
    cycles: int = Field(ge=1, le=1000, description="Its length [forcing periods]")


class PhysicalUnits(Section):
    """Machines in SI units: amplitude over frequency, without and with balls."""

    notebook: Literal["physical_units"] = NOTEBOOK
    plant: Plant
    clearances: kinds.items(Clearance, 1, 6, "Clearances, half of the play [m]")
    frequencies: Band
    cycles: int = Field(ge=1, le=100_000, description="Length of a run [forcing periods]")
    settle: int = Field(ge=0, le=100_000, description="Cycles of it that are left out [forcing periods]")
    shown: Shown

    rules: ClassVar = [("settle", "settle < cycles")]


OWN = ("fixed_points", "theoretical_response", "simulation", "physical_units")
"""Notebooks of figures of one's own."""
OwnFigure = Annotated[FixedPoints | Response | SimulatedMotion | PhysicalUnits, Field(discriminator="notebook")]


class Figures(Section):
    """The figures to build: those of the chapter, each optional, and your own under other names."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[Annotated[str, Field(pattern=kinds.NAME)], OwnFigure | None]

    fig10_01: Drawing | None = None
    fig10_02: Drawing | None = None
    fig10_03: Sawtooth | None = None
    fig10_04: Manifold | None = None
    fig10_05: Regions | None = None
    fig10_06: FixedPoints | None = None
    fig10_07: Response | None = None
    fig10_08: SimulatedMotion | None = None
    fig10_09: FixedPoints | None = None
    fig10_10: Response | None = None
    fig10_11: SimulatedMotion | None = None

    def conditions(self):
        number = sum(scene is not None for _, scene in self)
        return [] if 1 <= number <= MOST else [((), f"has {number} entries, not 1 to {MOST}")]
