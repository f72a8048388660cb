from vibroimpact.exact.engine.certificate import Certificate as Certificate
from vibroimpact.exact.engine.energy import ENERGY as ENERGY
from vibroimpact.exact.engine.energy import Energy as Energy
from vibroimpact.exact.engine.ensemble import OUTCOME as OUTCOME
from vibroimpact.exact.engine.ensemble import STATUSES as STATUSES
from vibroimpact.exact.engine.ensemble import ensemble as ensemble
from vibroimpact.exact.engine.simulation import Run as Run
from vibroimpact.exact.engine.simulation import simulate as simulate
from vibroimpact.exact.engine.simulation import simulate_many as simulate_many
from vibroimpact.exact.orbits.search import Orbit as Orbit
from vibroimpact.exact.orbits.search import orbits as orbits
from vibroimpact.system import PhysicalSystem as PhysicalSystem
from vibroimpact.system import System as System
from vibroimpact.system.state import EVENT as EVENT
from vibroimpact.system.state import IMPACT as IMPACT
from vibroimpact.system.state import KINDS as KINDS
from vibroimpact.system.state import RELEASE as RELEASE
from vibroimpact.system.state import STICK as STICK
from vibroimpact.theory.fixed_points.search import FixedPoint as FixedPoint
from vibroimpact.theory.fixed_points.search import fixed_points as fixed_points

__version__: str
