"""Options for the parameters of a system: the chapter's values, unless told otherwise."""

from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS

NAMES = {**PARAMETERS, "f10_hat": None, "f20_hat": None}
"""Every parameter with its usual value, or None where the case says it."""


def add(parser) -> None:
    """Give a parser an option for every parameter, and one for the forces of a case."""
    group = parser.add_argument_group(
        "system", "dimensionless parameters of (10.4)-(10.6), those of section 10.4 unless told otherwise"
    )
    group.add_argument("--case", choices=CASES, default="equal", help="forces of the chapter's case (default: equal)")
    for name, value in NAMES.items():
        usual = "that of the case" if value is None else value
        group.add_argument(option(name), type=float, metavar="X", help=f"default: {usual}")


def option(name: str) -> str:
    """The option of a parameter."""
    return f"--{name.replace('_', '-')}"


def system_of(options) -> System:
    """The system that the options ask for.

    Raises:
        ValueError: there is none, see System.
    """
    given = {name: value for name in NAMES if (value := getattr(options, name)) is not None}
    return System(**{**PARAMETERS, **CASES[options.case], **given})
