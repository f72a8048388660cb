"""Commands of the command line: their options, and the tables that they compute."""

import csv
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

import vibroimpact
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.exact.orbits.search import orbits
from vibroimpact.system import PhysicalSystem
from vibroimpact.system.arguments import real, whole
from vibroimpact.system.chapter import CASES, PARAMETERS
from vibroimpact.system.extras import need
from vibroimpact.system.state import KINDS
from vibroimpact.system.state import NAMES as STATE
from vibroimpact.theory.criteria import CRITERIA, of_fixed_point
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points

NAMES = {**PARAMETERS, "f10_hat": None, "f20_hat": None}
"""Default of each parameter; None for the forces, which have the values of the case."""
MACHINE = {
    "M": "mass of the machine with its box, without the ball [kg]",
    "m": "mass of the ball [kg]",
    "k": "stiffness of the spring [N/m]",
    "c": "damping [N s/m]",
    "F": "amplitude of the force [N]",
}
"""Options of a machine: the arguments of PhysicalSystem.single that have no default."""
PICTURES = (".png", ".pdf", ".svg")
_MOST_SAMPLES = 10_000_000
_SIDES = ("1_plus", "1_minus", "2_plus", "2_minus")


class Table(NamedTuple):
    """Result of a command: column names, and rows of numbers, texts and booleans."""

    columns: tuple[str, ...]
    rows: list[tuple]
    answer: str = ""
    """Summary text, printed instead of the rows."""
    plot: Callable | None = None
    """Function that draws the result as a Matplotlib Figure."""

    def write(self, file) -> None:
        """Write the table as CSV to an open text file, with all digits; NaN is an empty field."""
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows([["" if value != value else value for value in row] for row in self.rows])


class Command(NamedTuple):
    """Description of a command: its help text, its options and the function that computes its table."""

    help: str
    compute: Callable[..., Table]
    add_options: Callable = lambda parser: None
    of_system: bool = True
    """True if the command takes the dimensionless parameters besides its own options."""


def add_system_options(parser) -> None:
    """Add an option for each dimensionless parameter, and the option --case for the forces of a case of the chapter."""
    group = parser.add_argument_group(
        "system", "dimensionless parameters of (10.4)-(10.6); the defaults are those of section 10.4"
    )
    group.add_argument("--case", choices=CASES, default="equal", help="use the forces of a case (default: equal)")
    for name, value in NAMES.items():
        usual = "that of the case" if value is None else value
        spellings = dict.fromkeys((f"--{name.replace('_', '-')}", f"--{name}"))
        group.add_argument(*spellings, type=float, metavar="X", help=f"default: {usual}")


def _fixed_points(system, options):
    """Return one row per fixed point, with the verdict of each criterion in CRITERIA."""
    columns = ("label", "C1", "C2", "B1", "B2", "psi1", "psi2", *CRITERIA)
    rows = [point.row() | of_fixed_point(system, point) for point in fixed_points(system)]
    return Table(columns, [tuple(row[name] for name in columns) for row in rows])


def _orbits(system, options):
    """Return one row per admissible orbit.

    Phases are in forcing periods. Speeds are speeds just after an impact. modulus_1 is the modulus of the largest
    Floquet multiplier.
    """
    measures = [f"{what}{side}" for what in ("phase", "speed") for side in _SIDES]
    columns = ("symmetric", "C1", "C2", *measures, "modulus_1", "residual", "exact")
    rows = [orbit.row() for orbit in orbits(system) if orbit.admissible]
    return Table(columns, [tuple(row[name] for name in columns) for row in rows])


def _simulate_options(parser):
    """Add the options for the initial state, for the length of the run and for the output."""
    parser.add_argument(
        "--state", type=float, nargs=8, metavar=STATE, default=[0.0] * 8, help="initial state (default: at rest)"
    )
    parser.add_argument("--cycles", type=int, default=100, metavar="N", help="forcing cycles to run (default: 100)")
    parser.add_argument("--tau0", type=float, default=0.0, metavar="TAU", help="initial time (default: 0)")
    parser.add_argument(
        "--samples-per-cycle", type=int, default=32, metavar="N", help="rows per forcing cycle (default: 32)"
    )
    parser.add_argument("--events", action="store_true", help="write a row per impact, stick and release instead")


def _simulate(system, options):
    """Return one row per sample, with tau and the state.

    With the option --events, return one row per event instead, with the state just after the event.
    """
    cycles = whole("cycles", options.cycles, 0, _MOST_SAMPLES)
    if options.events:
        events = simulate(system, options.state, cycles, options.tau0).events.tolist()
        rows = [(tau, module, wall, KINDS[kind], *state.tolist()) for tau, module, wall, kind, state in events]
        return Table(("tau", "module", "wall", "kind", *STATE), rows)
    count = cycles * whole("samples-per-cycle", options.samples_per_cycle, 1, _MOST_SAMPLES)
    whole("cycles times samples-per-cycle", count, 0, _MOST_SAMPLES)
    times = options.tau0 + np.linspace(0.0, cycles * system.period, count + 1)
    run = simulate(system, options.state, cycles, options.tau0, times)
    return Table(("tau", *STATE), np.column_stack([times, run.samples]).tolist())


def _design_options(parser):
    """Add the options for the machine (SI units), the frequency band, the candidate balls and the plot."""
    group = parser.add_argument_group("machine", "all required, in SI units")
    for name, words in MACHINE.items():
        group.add_argument(f"--{name}", type=float, required=True, metavar="X", help=words)
    parser.add_argument("--from", dest="low", type=float, required=True, metavar="HZ", help="first frequency [Hz]")
    parser.add_argument("--to", dest="high", type=float, required=True, metavar="HZ", help="last frequency [Hz]")
    parser.add_argument(
        "--clearance", type=float, nargs="+", metavar="L",
        help="candidate clearances to each side [m] (default: 8 around (F / k) (M / m), then more near the best)",
    )  # fmt: skip
    parser.add_argument(
        "--restitution", type=float, nargs="+", metavar="E",
        help="candidate restitution coefficients (default: five from 0.05 to 0.8)",
    )  # fmt: skip
    parser.add_argument("--plot", type=Path, metavar="FILE", help=f"also save a plot ({', '.join(PICTURES)})")


def _design(options):
    """Return a table of the response with the chosen ball, one row per frequency.

    The summary of the table is the text of the `Design`.
    """
    if options.plot is not None:
        if options.plot.suffix not in PICTURES:
            raise ValueError(f"plot: {options.plot} should end in {', '.join(PICTURES)}")
        need("figures", "matplotlib", "pandas")
    low, high = real("from", options.low), real("to", options.high)
    if not 0 < low < high:
        raise ValueError(f"from, to: {low:g} and {high:g} Hz; expected 0 < from < to")
    machine = PhysicalSystem.single(**{name: getattr(options, name) for name in MACHINE})
    choices = {"restitutions": options.restitution} if options.restitution else {}
    found = vibroimpact.design(machine, (low, high), options.clearance, **choices)
    return Table(tuple(found.response[0]), [tuple(row.values()) for row in found.response], str(found), found.plot)


COMMANDS = {
    "fixed-points": Command(
        "list all fixed points of the slow flow with the verdict of each stability criterion", _fixed_points
    ),
    "orbits": Command("list all periodic responses of the exact system with two impacts per cycle and module", _orbits),
    "simulate": Command(
        "integrate the exact system from an initial state, with impacts, chatter and sticking",
        _simulate,
        _simulate_options,
    ),
    "design": Command(
        "choose clearance and restitution of the ball for one machine, in SI units, and report their effect",
        _design,
        _design_options,
        of_system=False,
    ),
}
