"""vibroimpact response"""

import sys

import numpy as np

from vibroimpact.cli.system_options import NAMES
from vibroimpact.cli.table import Table
from vibroimpact.regimes.branches import Path, branches
from vibroimpact.regimes.families import AsymmetricOrbits, FixedPoints, SymmetricOrbits
from vibroimpact.system.arguments import real, whole

HELP = "C over a parameter: all branches of fixed points and of exact orbits, with stability and special points"
_MOST_SEEDS = 1000
SIDES: dict[str, list] = {
    "theory": [FixedPoints],
    "exact": [SymmetricOrbits, AsymmetricOrbits],
    "both": [SymmetricOrbits, AsymmetricOrbits, FixedPoints],
}


def add_options(parser) -> None:
    """The path through the parameters."""
    parser.add_argument(
        "--along", nargs="+", choices=NAMES, metavar="PARAMETER", default=["f20_hat"],
        help="the parameter, or several that move together (default: f20_hat)",
    )  # fmt: skip
    parser.add_argument("--from", dest="low", type=float, default=0.2, metavar="P", help="first value (default: 0.2)")
    parser.add_argument("--to", dest="high", type=float, default=1.2, metavar="P", help="last value (default: 1.2)")
    parser.add_argument(
        "--of", choices=SIDES, default="both", help="fixed points, exact orbits (which take longer), or both (default)"
    )
    parser.add_argument(
        "--seeds", type=int, default=5, metavar="N", help="values at which branches are looked for (default: 5)"
    )


def compute(system, options) -> Table:
    """Rows in their order along each piece of a branch between special points, which belong to the pieces they join."""
    low, high = real("from", options.low), real("to", options.high)
    if not low < high:
        raise ValueError(f"to: {high} is not above {low}, where the path begins")
    path, seeds = Path(system, tuple(options.along)), whole("seeds", options.seeds, 1, _MOST_SEEDS)
    for name, end in (("from", low), ("to", high)):
        try:
            path(end)
        except ValueError as error:
            raise ValueError(f"{name}: at {end}, {error}") from None
    rows = []
    for family in SIDES[options.of]:
        print(f"looking for every {family.name} ...", file=sys.stderr)
        found = branches(family, path, (low, high), np.linspace(low, high, seeds), (high - low) / 10)
        rows += [row for number, branch in enumerate(found) for row in _rows(number, branch, low, high)]
    columns = (" = ".join(options.along), "C1", "C2")
    return Table(("family", "branch", "piece", *columns, "stable", "admissible", "special"), rows)


def _rows(number, branch, low, high):
    """The nodes within the range; the last step of a branch may go beyond it."""
    for piece, (inner, nodes) in enumerate(branch.pieces()):
        for node in (node for node in nodes if low <= node.p <= high):
            C = node.amplitudes.tolist()
            yield branch.family.name, number, piece, node.p, *C, inner.stable, inner.admissible, node.kind
