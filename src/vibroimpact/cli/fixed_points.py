"""vibroimpact fixed-points"""

from vibroimpact.cli.table import Table
from vibroimpact.theory.criteria import CRITERIA, fast_and_slow, of_fixed_point
from vibroimpact.theory.fixed_points.search import fixed_points, labels

HELP = "all fixed points of the slow flow, with what the criteria of stability say"
COLUMNS = ("label", "C1", "C2", "B1", "B2", "psi1", "psi2", *CRITERIA, "theory")


def add_options(parser) -> None:
    """None but those of the system."""


def compute(system, options) -> Table:
    """A row per fixed point; theory: the verdict of Masri's analysis and of the slow flow together."""
    points = fixed_points(system)
    return Table(COLUMNS, [_row(system, *pair) for pair in zip(labels(system, points), points, strict=True)])


def _row(system, label, point):
    says = of_fixed_point(system, point)
    numbers = (*point.C.tolist(), *point.B.tolist(), *point.psi.tolist())
    return label, *numbers, *says.values(), fast_and_slow(says)
