"""Integrators of (10.2) with a common protocol: the engine of this package, and other methods for comparison."""

from vibroimpact.integrators import ivanov, penalty, solve_ivp
from vibroimpact.integrators.event_driven import CertifiedEngine, Engine
from vibroimpact.integrators.heyoka_taylor import HeyokaTaylor
from vibroimpact.integrators.leading_order import LeadingOrder
from vibroimpact.integrators.modal import Modal
from vibroimpact.integrators.moreau_jean import MoreauJean
from vibroimpact.integrators.runge_kutta import RungeKutta4

METHODS = [
    Engine(),
    Modal(),
    HeyokaTaylor(),
    RungeKutta4(),
    *solve_ivp.METHODS,
    MoreauJean(),
    *penalty.METHODS,
    *ivanov.METHODS,
    LeadingOrder(),
]
"""All methods, in the order of tables and legends."""
TIMED = [METHODS[0], CertifiedEngine(), *METHODS[1:]]
"""METHODS with the certified engine inserted in second place, in the order of tables."""
