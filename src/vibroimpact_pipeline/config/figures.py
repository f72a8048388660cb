"""Section `figures`: which figures are built, each by its notebook.

The chapter's figures keep their notebooks, as their captions do; any other name may be given to a figure of one's own.
"""

from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from vibroimpact_pipeline.config.fields import (
    Amplitude,
    CaseName,
    CRange,
    Label,
    Name,
    Planes,
    not_ascending,
    repeated,
    unit,
)
from vibroimpact_pipeline.config.section import Problem, Section

MOST = 100
"""Figures of a build, a job each."""
NOTEBOOK = Field(description="Its notebook explains and draws it")
MODEL = Field(description="What it is computed with, and nothing dearer")


class Drawing(Section):
    """A drawing to scale."""

    notebook: Literal["drawings"] = NOTEBOOK


class Sawtooth(Section):
    """Figure 10.3."""

    notebook: Literal["closed_form"] = NOTEBOOK
    model: Literal["closed_form"] = MODEL
    amplitude: Annotated[float, Field(ge=1e-3, le=1000)] = Field(description="C of the saw-tooth")
    theta: Annotated[float, Field(ge=-100, le=100)] = Field(
        description="Phase of the impacts", json_schema_extra=unit("rad")
    )
    tau0_max: Annotated[float, Field(ge=3.15, le=100)] = Field(
        description="Right end of the axis; within pi, 3.15, there is an impact", json_schema_extra=unit("rad")
    )


class Manifold(Section):
    """Figure 10.4."""

    notebook: Literal["closed_form"] = NOTEBOOK
    model: Literal["closed_form"] = MODEL
    parameters: Annotated[list[Literal["kappa"]], Field(min_length=1, max_length=1)] = Field(
        description="System parameters that the figure depends on"
    )
    C_max: Amplitude = Field(description="Right end of the axis; the fold of the manifold lies below 1")


class Regions(Section):
    """Figure 10.5."""

    notebook: Literal["closed_form"] = NOTEBOOK
    model: Literal["closed_form"] = MODEL
    C_range: CRange


class FixedPoints(Section):
    """Fixed points and singular points of a case on the slow invariant manifold, as in figures 10.6 and 10.9."""

    notebook: Literal["fixed_points"] = NOTEBOOK
    model: Literal["slow_flow"] = MODEL
    case: CaseName
    C_max: Planes


class Response(Section):
    """The theoretical response of a fixed point, as in figures 10.7 and, with the planes, 10.10."""

    notebook: Literal["theoretical_response"] = NOTEBOOK
    model: Literal["slow_flow"] = MODEL
    case: CaseName
    fixed_point: Label
    periods: Annotated[float, Field(ge=0.5, le=100)] = Field(
        description="Length of the response", json_schema_extra=unit("forcing periods")
    )
    C_max: Planes = Field(default=None, description="Right ends of the planes; without them the response stands alone")


class SimulatedMotion(Section):
    """The second module's motion as the direct integration of a case has it, as in figures 10.8 and 10.11."""

    notebook: Literal["simulation"] = NOTEBOOK
    model: Literal["simulation"] = MODEL
    case: CaseName


Clearance = Annotated[float, Field(ge=1e-6, le=1e3, json_schema_extra=unit("m"))]
Hertz = Annotated[float, Field(ge=1e-3, le=1e6, json_schema_extra=unit("Hz"))]


def quantity(of: str, name: str, least: float = 0.0):
    """A field of a plant, from `least` on, in a unit."""
    return Field(ge=least, le=1e9, description=of, json_schema_extra=unit(name))


class Plant(Section):
    """Machines on their springs, as in (10.1), in SI units; without dampers they could not be driven at resonance."""

    M: float = quantity("Mass of a box", "kg", 1e-6)
    m: float = quantity("Mass of a ball", "kg", 1e-6)
    k1: float = quantity("Stiffness of machine 1 to ground", "N/m", 1e-6)
    k2: float = quantity("Stiffness of machine 2 to ground", "N/m", 1e-6)
    k12: float = quantity("Stiffness between them", "N/m")
    c1: float = quantity("Damping of machine 1 to ground", "N s/m", 1e-6)
    c2: float = quantity("Damping of machine 2 to ground", "N s/m", 1e-6)
    c12: float = quantity("Damping between them", "N s/m")
    F10: float = quantity("Amplitude of the force on machine 1", "N", 1e-6)
    F20: float = quantity("Amplitude of the force on machine 2", "N")
    kappa: Annotated[float, Field(ge=0.01, le=0.99)] = Field(description="Restitution coefficient")

    def conditions(self):
        if not 1e-6 <= self.m / self.M <= 10:
            yield Problem(("m",), f"{self.m} is not between 1e-6 and 10 times M = {self.M}")


class Band(Section):
    """Frequencies, evenly spaced."""

    range: Annotated[list[Hertz], Field(min_length=2, max_length=2)] = Field(description="Its ends")
    values: Annotated[int, Field(ge=2, le=1000)] = Field(description="So many, both ends included")

    def conditions(self):
        yield from not_ascending("range", self.range)


class Shown(Section):
    """A motion from rest that is drawn over the time."""

    L: Clearance = Field(description="Its clearance")
    frequency: Hertz = Field(description="Of the forces")
    cycles: Annotated[int, Field(ge=1, le=1000)] = Field(
        description="Its length", json_schema_extra=unit("forcing periods")
    )


class PhysicalUnits(Section):
    """Machines in kilograms, newtons and metres: how far they swing over the frequency, without and with balls."""

    notebook: Literal["physical_units"] = NOTEBOOK
    plant: Plant
    clearances: Annotated[list[Clearance], Field(min_length=1, max_length=6)] = Field(description="Half of the play")
    frequencies: Band
    cycles: Annotated[int, Field(ge=1, le=100_000)] = Field(
        description="Length of a run", json_schema_extra=unit("forcing periods")
    )
    settle: Annotated[int, Field(ge=0, le=100_000)] = Field(
        description="Cycles of it that are left out", json_schema_extra=unit("forcing periods")
    )
    shown: Shown

    def conditions(self):
        yield from repeated("clearances", self.clearances)
        if self.settle >= self.cycles:
            yield Problem(("settle",), f"{self.settle} leaves nothing of {self.cycles} cycles to observe")


OwnFigure = Annotated[FixedPoints | Response | SimulatedMotion | PhysicalUnits, Field(discriminator="notebook")]


class Figures(Section):
    """The figures to build: those of the chapter, each of which may be left out, and one's own under other names."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[Name, OwnFigure]

    fig10_01: Drawing = None
    fig10_02: Drawing = None
    fig10_03: Sawtooth = None
    fig10_04: Manifold = None
    fig10_05: Regions = None
    fig10_06: FixedPoints = None
    fig10_07: Response = None
    fig10_08: SimulatedMotion = None
    fig10_09: FixedPoints = None
    fig10_10: Response = None
    fig10_11: SimulatedMotion = None

    def conditions(self):
        if not self.model_fields_set:
            yield Problem((), "is empty")
        if len(self.model_fields_set) > MOST:
            yield Problem((), f"has {len(self.model_fields_set)} entries, more than {MOST}")
