"""Parameters, matrices and the impact law of the system, shared by theory and simulation."""

from vibroimpact.system.parameters import System
from vibroimpact.system.physical import PhysicalSystem

__all__ = ["PhysicalSystem", "System"]
