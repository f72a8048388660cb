"""Other integrators of the same system behind one small protocol, to be measured against the engine."""

from vibroimpact.rivals.event_driven import Engine
from vibroimpact.rivals.heyoka_taylor import HeyokaTaylor
from vibroimpact.rivals.ivanov import variants as transformed
from vibroimpact.rivals.leading_order import LeadingOrder
from vibroimpact.rivals.moreau_jean import MoreauJean
from vibroimpact.rivals.penalty import variants as compliant
from vibroimpact.rivals.solve_ivp import integrators

METHODS = [Engine(), HeyokaTaylor(), *integrators(), MoreauJean(), *compliant(), *transformed(), LeadingOrder()]
"""Every method, in the order of tables and legends."""
