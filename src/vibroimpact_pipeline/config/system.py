"""Section `system`: the dimensionless parameters that all cases share, and what makes parameters a system."""

from typing import Annotated

from pydantic import Field, ValidationError

from vibroimpact.system import System
from vibroimpact_pipeline.config.fields import Epsilon, Force
from vibroimpact_pipeline.config.messages import problems_of
from vibroimpact_pipeline.config.section import Problem, Section

SLOWEST = 1e-3
"""Least forcing frequency: the forcing period, and with it the work of a cycle, grows as one over it."""
Coefficient = Annotated[float, Field(ge=0, le=10_000)]
Detuning = Annotated[float, Field(ge=-10_000, le=10_000)]


class SystemSection(Section):
    """Dimensionless parameters shared by all cases, hatted as in (10.4) and (10.6)."""

    epsilon: Epsilon
    kappa: float = Field(gt=0, lt=1, description="Restitution coefficient")
    alpha12_hat: Coefficient = Field(description="Stiffness of the coupling")
    gamma1_hat: Coefficient = Field(description="Damping of box 1 to ground")
    gamma2_hat: Coefficient = Field(description="Damping of box 2 to ground")
    gamma12_hat: Coefficient = Field(description="Damping of the coupling")
    sigma20_hat: Detuning = Field(description="Detuning of box 2; 1 + epsilon sigma20_hat, its stiffness, is above 0")
    sigma_e_hat: Detuning = Field(description="Detuning of the forcing; 1 + epsilon sigma_e_hat is at least 0.001")


class Parameters(SystemSection):
    """All parameters of one system: what the cases share, and two forces."""

    f10_hat: Force
    f20_hat: Force

    def conditions(self):
        try:
            system = System(**dict(self))
            _refuse_resonance(system)
        except ValueError as error:
            name, _, what = str(error).partition(": ")
            yield (name,) if name in NAMES else (), what
            return
        if system.Omega < SLOWEST:
            yield ("sigma_e_hat",), f"1 + epsilon sigma_e_hat = {system.Omega} is below {SLOWEST}"


NAMES = tuple(Parameters.model_fields)


def unsound(parameters: dict) -> list[Problem]:
    """Return what keeps parameters from being those of a system."""
    try:
        Parameters.model_validate(parameters)
    except ValidationError as error:
        return problems_of(error)
    return []


def _refuse_resonance(system):
    """Refuse an undamped system whose periodic responses are not isolated, or not bounded."""
    if system.gamma1 > 0 and system.gamma2 > 0:
        return
    # Here, because SciPy takes longer to load than all else that a build with nothing to do needs.
    from vibroimpact.exact.orbits.impulse_response import ImpulseResponse
    from vibroimpact.theory.fixed_points.search import refuse_free_motion

    refuse_free_motion(system)
    if not system.has_undriven_module:
        for sign in (1, -1):
            ImpulseResponse(system, sign)
