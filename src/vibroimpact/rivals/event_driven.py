"""The engine of this package, as one method among the others."""

from functools import partial

import numpy as np

from vibroimpact.exact.engine.event_log import APPROACH, KIND, MODULE, TIME, WALL
from vibroimpact.exact.engine.simulation import simulate
from vibroimpact.rivals.protocol import IMPACT, REFUSED, Method, RivalRun, failed
from vibroimpact.system.state import IMPACT as IMPACT_KIND


class Engine(Method):
    """Closed-form flight and certified events (vibroimpact.simulate). It has no tolerance to set."""

    name, family, knob, ladder, careful = "this engine", "exact flow", "precision", ("float64",), "float64"

    def run(self, system, state, cycles, tau0, setting, limit=None):
        try:
            run = simulate(system, state, cycles, tau0)
        except ArithmeticError as error:
            return failed(REFUSED, str(error), 0)
        hits = run.rows[:, KIND] == IMPACT_KIND
        rows = run.rows if hits.all() else run.rows[hits]
        impacts = np.empty(len(rows), IMPACT)
        impacts["tau"], impacts["module"], impacts["wall"] = tau0 + rows[:, TIME], rows[:, MODULE], rows[:, WALL]
        impacts["speed"] = np.abs(rows[:, APPROACH])
        doubt = partial(_doubt, run, tau0 + cycles * system.period)
        return RivalRun(run.final, impacts, len(run.rows) + 1, doubt=doubt)


def _doubt(run, end):
    """What the certificate of a run leaves open, in words."""
    certificate = run.certificate
    if certificate.horizon < end:
        return f"known up to tau = {certificate.horizon:.6g}"
    if not certificate.decided:
        nearest = min(certificate.nearest_miss, certificate.shallowest_hit)
        return f"an approach to a wall (the nearest: {nearest:.1e}) is within its error"
    return None
