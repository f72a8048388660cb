"""Random systems and starts that are difficult for the engine.

Starts are on walls or next to walls, or almost at rest. Systems are uncoupled or almost uncoupled, unforced, undamped,
almost without rebound, stiff, or have fast or strong forcing.
"""

import numpy as np

import vibroimpact as vi
from by_hand import FlightsByHand
from vibroimpact.system.matrices import rate_matrix
from vibroimpact.system.state import IMPACT, STICK

TINY = [0.0, 1e-300, 1e-60, 1e-50, 1e-40, 1e-30, 1e-20, 1e-16, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3]
TOLERANCE = 1e-9
"""Largest distance between the state in a row and the flow from the previous row, relative to the state's size."""
PER_RATE = 1e-5
"""Relative increase of this tolerance per unit of the norm of the rate matrix."""


def example(number):
    """Return (system, start, tau0) for the example of a number."""
    rng = np.random.default_rng(number)

    def size(low, high, *others):
        return float(rng.choice([*others, *[10.0 ** rng.uniform(low, high)] * 4]))

    def small():
        return float(rng.choice([-1, 1]) * rng.choice([rng.choice(TINY), rng.normal()], p=[0.8, 0.2]))

    system = vi.System(
        epsilon=size(-3, 0), kappa=float(rng.choice([10.0 ** rng.uniform(-300, -8), rng.uniform(0.01, 0.95)])),
        alpha12_hat=size(-25, 6, 0.0, 0.0, 1.0, 1.0, 1.0), gamma12_hat=size(-25, 2, 0.0, 0.0, 0.2, 0.2, 0.2),
        gamma1_hat=size(-3, 1, 0.0), gamma2_hat=size(-3, 1, 0.0), sigma20_hat=size(-2, 3, 0.0, 0.5),
        sigma_e_hat=size(-2, 2, 0.2, 0.2), f10_hat=size(-2, 4, 0.0, 1.0, 1.0), f20_hat=-size(-2, 4, 0.0, 0.0, 1.0),
    )  # fmt: skip
    start = np.empty(8)
    for i in range(2):
        box, velocity, wall = small(), small(), rng.choice([-1, 1])
        near = rng.choice([rng.choice(TINY), rng.uniform(0, 2)], p=[0.8, 0.2])
        start[[2 * i, 2 * i + 1]] = box, box - wall * (1.0 - near)
        start[[4 + 2 * i, 5 + 2 * i]] = velocity, velocity + small()
    return system, start, float(rng.choice([0.0, rng.uniform(0, 7), system.period / 4]))


def faults(number):
    """Yield the name of each fault in the run of an example."""
    system, start, tau0 = example(number)
    try:
        run = vi.simulate(system, start, 1, tau0)
    except ArithmeticError as error:
        yield str(error).split(" after ")[0]
        return
    if (np.diff(run.events["tau"]) < 0).any():
        yield "events out of order"
    worst = max(departures(run), default=0.0)
    if not worst <= TOLERANCE * (1.0 + PER_RATE * np.linalg.norm(rate_matrix(system), 2)):
        yield "the state in a row is not the state at its time"


def departures(run):
    """Yield for each row the distance between its state and the flow from the previous row by a matrix exponential.

    Components that jump are left out: at an impact, the velocities of the module; from the last listed impact of a
    chatter to its end, velocities and displacement of the ball, since the row shows the ball at rest on its wall.
    """
    walls, state, tau, flights = [0, 0], run.start, run.tau0, FlightsByHand(run.system)
    size = 1.0 + np.abs(run.start).max() + np.abs(run.system.forcing).max()
    for k, event in enumerate(run.events):
        i = int(event["module"]) - 1
        later = flights.flow(state, walls, tau, event["tau"] - tau)
        kept = np.ones(8, bool)
        kept[[4 + 2 * i, 5 + 2 * i]] = event["kind"] != IMPACT
        for j in range(2):
            own = run.events["kind"][k:][run.events["module"][k:] == j + 1]
            if len(own) and own[0] == STICK:
                kept[[1 + 2 * j, 4 + 2 * j, 5 + 2 * j]] = False
        size = max(size, np.abs(event["state"]).max())
        yield np.abs(later - event["state"])[kept].max() / size
        walls[i] = {IMPACT: 0, STICK: int(event["wall"])}.get(event["kind"], 0)
        state, tau = event["state"], event["tau"]
    left = run.tau0 + run.cycles * run.system.period - tau
    yield np.abs(flights.flow(state, walls, tau, left) - run.final).max() / size
