"""A word before something is compiled that takes long; nothing where Numba finds it in its cache."""

import sys

from numba.core import event

SIMULATION = "the simulation, some 15 s"
ON_DEMAND = "what certificates, energies and Jacobians of runs need, some 10 s"
ENSEMBLE = "the simulation of ensembles, some 25 s"
APART = {"flow_tables": SIMULATION, "event_loop": SIMULATION, "ensemble": ENSEMBLE}
"""What is compiled apart, by the modules that it starts from, and about how long it takes."""


class _Notice(event.Listener):
    """Hears of all that Numba compiles, a function within another included, just before it does."""

    def __init__(self):
        self.within, self.said, self.hint = 0, set(), " (python -m vibroimpact.compile does it beforehand)"

    def beforehand(self) -> None:
        """Who compiles on purpose needs no hint."""
        self.hint = ""

    def on_start(self, compilation):
        module = compilation.data["dispatcher"].py_func.__module__ or ""
        what = APART.get(module.removeprefix(f"{__package__}."), ON_DEMAND)
        if not self.within and module.startswith(__package__) and what not in self.said:
            self.said.add(what)
            say(f"compiling {what}, once{self.hint}")
        self.within += 1

    def on_end(self, compilation):
        self.within -= 1


def say(words: str) -> None:
    """One line on standard error."""
    print(f"vibroimpact: {words}", file=sys.stderr, flush=True)


NOTICE = _Notice()
event.register("numba:compile", NOTICE)
