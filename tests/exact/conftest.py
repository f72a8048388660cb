"""An auditor of simulated motions that shares no code with the engine: matrix exponentials and a dense search."""

import numpy as np
import pytest

import vibroimpact as vi
from by_hand import FlightsByHand
from chapter import FORCES, PARAMETERS


@pytest.fixture
def chapter():
    """The chapter's system under given forcing."""

    def make(f10_hat=1.0, f20_hat=1.0, **changes):
        return vi.System(**{**PARAMETERS, **changes}, f10_hat=f10_hat, f20_hat=f20_hat)

    return make


@pytest.fixture(params=FORCES)
def case(request):
    """Each case of the chapter in turn."""
    f10_hat, f20_hat = FORCES[request.param]
    return vi.System(**PARAMETERS, f10_hat=f10_hat, f20_hat=f20_hat)


class Auditor(FlightsByHand):
    """Checks a run flight by flight, in the full coordinates of (10.2) written out by hand."""

    def audit(self, run, state, tau0, cycles, tolerance=2e-12, grid=24):
        """Check a whole run flight by flight; returns the largest errors met.

        Every flight must keep the gaps open and the contact forces pushing, every event must happen at the wall,
        impacts obey restitution and conserve momentum, a release leave the state as it is, a stick join the velocities.
        What a completed chatter leaves out (the flights between its last impact and the stick) is judged elsewhere.
        """
        eps, kappa = self.system.epsilon, self.system.kappa
        walls, now, tau = [0, 0], np.array(state, float), tau0
        worst = dict(gap=0.0, wall=0.0, restitution=0.0, momentum=0.0, position=0.0, pull=0.0)
        end = np.zeros((), run.events.dtype)
        end["tau"], end["module"], end["state"] = tau0 + cycles * self.system.period, 0, run.final
        for event in [*run.events, end]:
            t = event["tau"] - tau
            chattering = int(event["module"]) - 1 if event["kind"] == 1 and event["module"] else -1
            assert t >= -1e-12
            for s in np.linspace(0, max(t, 0), grid) if t > 1e-9 else ():
                mid = self.flow(now, walls, tau, s)
                push = self.acceleration(mid, walls, tau + s)
                for i in range(2):
                    if walls[i]:
                        worst["pull"] = max(worst["pull"], -walls[i] * push[i])
                    elif i != chattering:
                        worst["gap"] = max(worst["gap"], abs(mid[2 * i] - mid[2 * i + 1]) - 1)
            before = self.flow(now, walls, tau, t)
            after = event["state"]
            own = int(event["module"]) - 1
            if own >= 0:
                x, y, dx, dy = 2 * own, 2 * own + 1, 2 * own + 4, 2 * own + 5
                worst["wall"] = max(worst["wall"], abs(after[x] - after[y] - event["wall"]))
                if event["kind"] == 0:
                    assert walls[own] == 0
                    speed = before[dx] - before[dy]
                    assert speed * event["wall"] > -tolerance, "an impact from inside"
                    worst["restitution"] = max(
                        worst["restitution"], abs(after[dx] - after[dy] + kappa * (before[dx] - before[dy]))
                    )
                    worst["momentum"] = max(
                        worst["momentum"], abs(after[dx] + eps * after[dy] - before[dx] - eps * before[dy])
                    )
                    before[dx], before[dy] = after[dx], after[dy]
                elif event["kind"] == 1:
                    assert after[dx] == after[dy]
                    walls[own] = int(event["wall"])
                    before = after
                else:
                    assert walls[own] == event["wall"]
                    walls[own] = 0
            worst["position"] = max(worst["position"], np.abs(after - before).max())
            now, tau = np.array(after), float(event["tau"])
        for name, value in worst.items():
            limit = 1e-9 if name == "pull" else tolerance
            assert value <= limit, (name, value, worst)
        return worst


@pytest.fixture
def auditor():
    return Auditor
