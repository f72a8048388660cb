"""Other integrators of the same system behind one small protocol, to be measured against the engine."""

from vibroimpact.integrators.event_driven import Engine
from vibroimpact.integrators.heyoka_taylor import HeyokaTaylor
from vibroimpact.integrators.ivanov import variants as transformed
from vibroimpact.integrators.leading_order import LeadingOrder
from vibroimpact.integrators.moreau_jean import MoreauJean
from vibroimpact.integrators.penalty import variants as compliant
from vibroimpact.integrators.solve_ivp import integrators

METHODS = [Engine(), HeyokaTaylor(), *integrators(), MoreauJean(), *compliant(), *transformed(), LeadingOrder()]
"""Every method, in the order of tables and legends."""
