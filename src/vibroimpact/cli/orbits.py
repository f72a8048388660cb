"""vibroimpact orbits"""

from vibroimpact.cli.table import Table
from vibroimpact.exact.orbits.floquet import floquet
from vibroimpact.exact.orbits.search import orbits

HELP = "all periodic responses of the exact system with two impacts per cycle and module"
SIDES = ("1_plus", "1_minus", "2_plus", "2_minus")
PHASES, SPEEDS = (tuple(f"{what}{side}" for side in SIDES) for what in ("phase", "speed"))
COLUMNS = ("symmetric", "C1", "C2", *PHASES, *SPEEDS, "largest_multiplier", "residual", "floquet")


def add_options(parser) -> None:
    """None but those of the system."""


def compute(system, options) -> Table:
    """A row per orbit that is a motion; phases in periods, at wall +1 and -1; the modulus of the largest multiplier."""
    return Table(COLUMNS, [_row(orbit) for orbit in orbits(system) if orbit.admissible])


def _row(orbit):
    numbers = (*orbit.C.tolist(), *orbit.impact_phases.ravel().tolist(), *orbit.ball_speeds.ravel().tolist())
    return orbit.symmetric, *numbers, float(abs(orbit.multipliers[0])), orbit.residual, floquet(orbit)
