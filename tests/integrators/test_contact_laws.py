"""Each contact law has the restitution coefficient for which it is tuned, in one contact integrated by SciPy."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from vibroimpact.integrators import contact_laws as laws
from vibroimpact.integrators.penalty import force, law_numbers

MASS, DURATION = 0.1 / 1.1, 0.01
LAWS = {"spring": laws.SPRING, "Hertz": laws.HERTZ, "Hunt-Crossley": laws.HUNT_CROSSLEY}
LAWS["power law"] = laws.power_law(20)


def contact(law, stiffness, damping, speed):
    """Return (ratio of speeds after and before, duration, largest W) of a contact of a ball with a fixed wall."""
    numbers = law_numbers(law, stiffness, damping, 1.0)
    begin = 1.0 if law.walls else 0.0

    def rates(time, state):
        return [state[1], -force.py_func(state[0], state[1], numbers, damping) / MASS]

    def left(time, state):
        return state[0] - begin + (time == 0.0)

    def turned(time, state):
        return state[1]

    left.terminal, left.direction = True, -1.0
    span = 10.0 if not law.walls else 20.0 * DURATION
    events = [left, turned]
    run = solve_ivp(rates, (0.0, span), (begin, speed), "DOP853", events=events, rtol=1e-11, atol=1e-14)
    return -run.y[1, -1] / speed, run.t[-1], run.y_events[1][0][0]


def stiffness_in(law, kappa):
    if law.walls:
        return laws.stiffness_of(law, MASS, DURATION)
    return laws.stiffness_turning_at_the_wall(law, MASS, kappa)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("kappa", [0.3, 0.65, 0.95])
def test_restitution_is_kappa_at_every_speed(name, kappa):
    law = LAWS[name]
    stiffness = stiffness_in(law, kappa)
    damping = laws.damping_of(law, MASS, kappa, stiffness)
    power = law_numbers(law, stiffness, damping, 1.0)[4]
    for speed in (0.5, 1.0, 2.0):
        found = contact(law, stiffness, damping * speed**-power, speed)[0]
        assert found == pytest.approx(kappa, rel=1e-6)


def test_an_undamped_contact_has_the_tuned_duration_and_the_power_law_turns_the_ball_at_the_wall():
    for name in ("spring", "Hertz"):
        stiffness = stiffness_in(LAWS[name], 0.65)
        assert contact(LAWS[name], stiffness, 0.0, 1.0)[1] == pytest.approx(DURATION, rel=1e-6)
    law = LAWS["power law"]
    stiffness = stiffness_in(law, 0.65)
    assert contact(law, stiffness, laws.damping_of(law, MASS, 0.65, stiffness), 1.0)[2] == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("kappa", [1e-9, 0.1, 0.999, 1.0 - 1e-9])
def test_the_hunt_crossley_number_solves_its_equation(kappa):
    d = laws.hunt_crossley_number(kappa)
    if kappa > 0.05:  # below, 1 - kappa d is smaller than rounding errors
        assert (1.0 + kappa) * d == pytest.approx(np.log1p(d) - np.log1p(-kappa * d), rel=1e-9)
    assert 1.5 * (1.0 - kappa) <= d * (1.0 + 1e-6)  # limit for kappa to 1
    assert d * kappa <= 1.0
