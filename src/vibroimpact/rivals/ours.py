"""The engine of this package, as one method among the others."""

import numpy as np

from vibroimpact.exact.simulation import IMPACT as IMPACT_KIND
from vibroimpact.exact.simulation import simulate
from vibroimpact.rivals.protocol import IMPACT, REFUSED, Method, RivalRun, failed


class Engine(Method):
    """Closed-form flight and certified events (vibroimpact.simulate). It has no tolerance to set."""

    name, family, knob, ladder, careful = "this engine", "exact flow", "precision", ("float64",), "float64"

    def run(self, system, state, cycles, tau0, setting, limit=None):
        try:
            run = simulate(system, state, cycles, tau0)
        except ArithmeticError as error:
            return failed(REFUSED, str(error), 0)
        hits = run.events[run.events["kind"] == IMPACT_KIND]
        impacts = np.empty(len(hits), IMPACT)
        for name in ("tau", "module", "wall"):
            impacts[name] = hits[name]
        one, two = (hits["state"][:, box] - hits["state"][:, box + 1] for box in (4, 6))
        impacts["speed"] = np.abs(np.where(hits["module"] == 1, one, two)) / system.kappa
        return RivalRun(
            run.final, impacts, len(run.events) + 1, doubt=lambda: _doubt(run, tau0 + cycles * system.period)
        )


def _doubt(run, end):
    """What the certificate of a run leaves open, in words."""
    certificate = run.certificate
    if certificate.horizon < end:
        return f"known up to tau = {certificate.horizon:.6g}"
    if not certificate.decided:
        nearest = min(certificate.nearest_miss, certificate.shallowest_hit)
        return f"an approach to a wall (the nearest: {nearest:.1e}) is within its error"
    return None
