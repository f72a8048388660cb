"""Config section `figures`: figures of the chapter, and your own figures, which use the same drawing code."""

from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from vibroimpact_pipeline.config import fields
from vibroimpact_pipeline.config.section import Section

MAX_FIGURES = 100
"""Maximum number of figures of a build; each is one job."""
LIKE = Field(description="Figure of the chapter whose drawing code is used")
MODEL = "Model: "
"""First word in the description of each key `model`; results/accuracy/models.csv compares the models of a figure."""
THEORY = f"{MODEL}slow_flow (leading order) or exact_orbit (the exact orbits next to the fixed points)"


class Drawing(Section):
    """Figures 10.1 and 10.2, drawings of the system; they have no settings."""


class Sawtooth(Section):
    """Settings of figure 10.3, the saw-tooth function."""

    amplitude: fields.real("Amplitude C of the saw-tooth", 1e-3, 1000)
    theta: fields.real("Phase of the impacts [rad]", -100, 100)
    tau0_max: fields.real("Right end of the axis, above pi so that it contains an impact [rad]", 3.15, 100)


class Manifold(Section):
    """Settings of figure 10.4, the slow invariant manifold."""

    C_max: fields.Amplitude = Field(description="Right end of the axis, above the fold of the manifold (below 1)")


class Regions(Section):
    """Settings of figure 10.5, the stable and unstable regions."""

    C_range: tuple[Annotated[float, Field(ge=0, le=0.6)], Annotated[float, Field(ge=1.01, le=100)]] = Field(
        description="Ends of the axis; it must contain the limit of (10.26)"
    )


class FixedPoints(Section):
    """Fixed points and singular points of a case on the slow invariant manifold, as in figures 10.6 and 10.9."""

    model: Literal["slow_flow", "exact_orbit"] = Field("slow_flow", description=THEORY)
    case: fields.CaseName
    C_max: fields.Planes


class Response(Section):
    """The theoretical response at a fixed point, as in figure 10.7."""

    model: Literal["slow_flow", "exact_orbit", "second_term"] = Field(
        "slow_flow", description=f"{THEORY} or second_term (slow flow with the second term of (10.7))"
    )
    case: fields.CaseName
    fixed_point: fields.Label
    periods: fields.real("Length of the response [forcing periods]", 0.5, 100)


class ResponseOnPlanes(Response):
    """The theoretical response at a fixed point, and the position of this point on the manifold, as in figure 10.10."""

    C_max: fields.Planes


class SimulatedMotion(Section):
    """The motion of module 2 by direct integration, as in figures 10.8 and 10.11."""

    model: Literal["float64", "reference"] = Field(
        "float64",
        description=f"{MODEL}float64 (double precision) or reference (arbitrary precision, for chaotic motions)",
    )
    case: fields.CaseName


class OwnFixedPoints(FixedPoints):
    """Your own figure of fixed points."""

    like: Literal["fig10_06"] = LIKE


class OwnResponse(Response):
    """Your own figure of a response."""

    like: Literal["fig10_07"] = LIKE


class OwnSimulatedMotion(SimulatedMotion):
    """Your own figure of a simulated motion."""

    like: Literal["fig10_08"] = LIKE


class OwnResponseOnPlanes(ResponseOnPlanes):
    """Your own figure of a response and of its fixed point on the manifold."""

    like: Literal["fig10_10"] = LIKE


OwnFigure = Annotated[
    OwnFixedPoints | OwnResponse | OwnSimulatedMotion | OwnResponseOnPlanes, Field(discriminator="like")
]


class Figures(Section):
    """The figures to build: any figures of the chapter, and your own figures with other names."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[Annotated[str, Field(pattern=fields.NAME)], OwnFigure | None]

    fig10_01: Drawing | None = None
    fig10_02: Drawing | None = None
    fig10_03: Sawtooth | None = None
    fig10_04: Manifold | None = None
    fig10_05: Regions | None = None
    fig10_06: FixedPoints | None = None
    fig10_07: Response | None = None
    fig10_08: SimulatedMotion | None = None
    fig10_09: FixedPoints | None = None
    fig10_10: ResponseOnPlanes | None = None
    fig10_11: SimulatedMotion | None = None

    def conditions(self):
        if not 1 <= (number := sum(scene is not None for _, scene in self)) <= MAX_FIGURES:
            yield (), f"has {number} entries, should have 1 to {MAX_FIGURES}"
