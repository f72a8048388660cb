"""Integrators of the same system with a common protocol, for comparison with the engine."""

from vibroimpact.integrators.event_driven import CertifiedEngine, Engine
from vibroimpact.integrators.heyoka_taylor import HeyokaTaylor
from vibroimpact.integrators.ivanov import variants as transformed
from vibroimpact.integrators.leading_order import LeadingOrder
from vibroimpact.integrators.modal import Modal
from vibroimpact.integrators.moreau_jean import MoreauJean
from vibroimpact.integrators.penalty import variants as compliant
from vibroimpact.integrators.runge_kutta import RungeKutta4
from vibroimpact.integrators.solve_ivp import integrators

METHODS = [
    Engine(),
    Modal(),
    HeyokaTaylor(),
    RungeKutta4(),
    *integrators(),
    MoreauJean(),
    *compliant(),
    *transformed(),
    LeadingOrder(),
]
"""All methods, in the order of tables and legends."""
TIMED = [METHODS[0], CertifiedEngine(), *METHODS[1:]]
"""METHODS with the certified engine as the second one, in the order of tables."""
