"""Use the engine of this package as a method for comparison with other integrators."""

from functools import partial

import numpy as np

from vibroimpact.exact.engine.contact import APPROACH, KIND, MODULE, TIME, WALL
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.integrators.protocol import REFUSED, Method, MethodRun, failed
from vibroimpact.system.state import IMPACT


class Engine(Method):
    """The engine of this package, `vibroimpact.simulate`.

    It computes flights in closed form and certifies events. It needs no tolerance.
    """

    name, family, knob, settings, careful = "this engine", "exact flow", "precision", ("float64",), "float64"

    def run(self, system, state, cycles, tau0, setting):
        try:
            run = simulate(system, state, cycles, tau0)
        except ArithmeticError as error:
            return failed(REFUSED, str(error), 0)
        return MethodRun(run.final, partial(_impacts, run), len(run.rows) + 1, doubt=partial(_doubt, run))


class CertifiedEngine(Engine):
    """The engine of this package; its run time includes the computation of the error certificate, `Run.certificate`."""

    name = "this engine, certified"

    def run(self, system, state, cycles, tau0, setting):
        run = super().run(system, state, cycles, tau0, setting)
        run.doubt()
        return run


def _impacts(run):
    """Return the impacts of a run as rows [tau, module, wall, speed]; all other events are left out."""
    rows = run.rows[run.rows[:, KIND] == IMPACT]
    return np.stack([run.tau0 + rows[:, TIME], rows[:, MODULE], rows[:, WALL], np.abs(rows[:, APPROACH])], axis=1)


def _doubt(run):
    """Return a text on what the certificate of a run leaves undecided, or an empty text."""
    certificate = run.certificate
    if certificate.horizon < run.tau0 + run.cycles * run.system.period:
        return f"known up to tau = {certificate.horizon:.6g}"
    if not certificate.decided:
        nearest = min(certificate.nearest_miss, certificate.shallowest_hit)
        return f"an approach to a wall (the nearest: {nearest:.1e}) is within its error"
    return ""
