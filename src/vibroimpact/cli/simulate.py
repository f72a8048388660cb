"""vibroimpact simulate"""

import numpy as np

from vibroimpact.cli.table import Table
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.system.arguments import whole
from vibroimpact.system.state import KINDS, NAMES

HELP = "integrate the exact system from a start, impacts, chatter and sticking included"
_MOST_SAMPLES = 10_000_000


def add_options(parser) -> None:
    """The start, the length, and what to write."""
    parser.add_argument(
        "--state", type=float, nargs=8, metavar=NAMES, default=[0.0] * 8, help="the start (default: at rest)"
    )
    parser.add_argument("--cycles", type=int, default=100, metavar="N", help="forcing cycles to run (default: 100)")
    parser.add_argument("--tau0", type=float, default=0.0, metavar="TAU", help="time of the start (default: 0)")
    parser.add_argument(
        "--samples-per-cycle", type=int, default=32, metavar="N", help="rows per forcing cycle (default: 32)"
    )
    parser.add_argument("--events", action="store_true", help="write the impacts, sticks and releases instead")


def compute(system, options) -> Table:
    """A row per sample, tau and the state; or per event, with the state just after it."""
    if options.events and options.plot:
        raise ValueError("plot: it draws samples, not events")
    cycles = whole("cycles", options.cycles, 0, _MOST_SAMPLES)
    if options.events:
        run = simulate(system, options.state, cycles, options.tau0)
        return Table(("tau", "module", "wall", "kind", *NAMES), [_event(*event) for event in run.events.tolist()])
    count = cycles * whole("samples-per-cycle", options.samples_per_cycle, 1, _MOST_SAMPLES)
    whole("cycles times samples-per-cycle", count, 0, _MOST_SAMPLES)
    times = options.tau0 + np.linspace(0.0, cycles * system.period, count + 1)
    run = simulate(system, options.state, cycles, options.tau0, times)
    return Table(("tau", *NAMES), np.column_stack([times, run.samples]).tolist())


def _event(tau, module, wall, kind, state):
    return tau, module, wall, KINDS[kind], *state.tolist()
