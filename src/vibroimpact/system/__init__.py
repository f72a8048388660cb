"""Parameters, matrices and the impact law, shared by theory and simulation."""

from vibroimpact.system.parameters import System
from vibroimpact.system.physical import PhysicalSystem

__all__ = ["PhysicalSystem", "System"]
