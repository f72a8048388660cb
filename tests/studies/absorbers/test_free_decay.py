"""How long an impulse is felt, with balls and with what they are held against."""

import math

import numpy as np
import pytest
from scipy.linalg import expm

import vibroimpact as vi
from chapter import PARAMETERS
from stored_energy import stored_energy
from vibroimpact.studies.absorbers.decay import decay_time, quickest_decay
from vibroimpact.studies.absorbers.references import fixed_balls, tuned, without_balls
from vibroimpact.studies.absorbers.tuning import textbook_tuning

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
FREE = SYSTEM.with_(f10_hat=0.0, f20_hat=0.0)


def energies(impulse, module, times):
    """What is left of the energy at some times, as samples of a simulation tell it."""
    cycles = int(times[-1] / FREE.period) + 1
    samples = vi.simulate(FREE, impulse * np.eye(8)[2 + 2 * module], cycles, sample_times=times).samples
    return stored_energy(FREE, samples) / (0.5 * impulse**2)


@pytest.mark.parametrize("module", [1, 2])
@pytest.mark.parametrize("impulse", [1.5, 3.0, -9.0, 40.0])
def test_a_tenth_is_left_then_and_more_before(impulse, module):
    time = decay_time(SYSTEM, impulse, module)
    before, after = energies(impulse, module, np.array([time - 1e-9, time + 1e-9]))
    assert after < 0.1 < before


def test_impacts_take_the_last_of_it_too():
    """At some impulses the energy falls through a tenth in an impact: that instant is the time."""
    run = vi.simulate(FREE, 4.0 * np.eye(8)[4], 20)
    for event in run.events[run.events["kind"] == vi.IMPACT][:12]:
        fraction = stored_energy(FREE, event["state"]) / 8.0 * (1 + 1e-12)
        assert decay_time(SYSTEM, 4.0, fraction=fraction) == pytest.approx(event["tau"], abs=1e-9)


def test_balls_that_meet_no_wall_are_no_balls():
    alone = without_balls(SYSTEM)
    for module in (1, 2):
        assert decay_time(SYSTEM, 0.3, module) == pytest.approx(alone.decay_time(module), rel=1e-12)


@pytest.mark.parametrize("linear", [without_balls(SYSTEM), fixed_balls(SYSTEM), tuned(SYSTEM, textbook_tuning(SYSTEM))])
@pytest.mark.parametrize("fraction", [0.1, 0.9, 1e-4])
def test_a_linear_decay_is_that_of_the_matrix_exponential(linear, fraction):
    time, n = linear.decay_time(2, fraction), len(linear.force)
    start = np.zeros(2 * n)
    start[n + 1] = 1.0 / linear.mass[1, 1]
    weights = np.block([[linear.stiffness, np.zeros((n, n))], [np.zeros((n, n)), linear.mass]])
    later = expm(linear.rate * time) @ start
    assert later @ weights @ later == pytest.approx(fraction * start @ weights @ start, rel=1e-9)


def test_what_is_not_damped_never_decays():
    still = SYSTEM.with_(gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0)
    assert without_balls(still).decay_time() == math.inf
    assert decay_time(still, 0.3, cycles=60) == math.inf
    assert decay_time(still, 3.0) < math.inf


@pytest.mark.parametrize(
    ("name", "given"),
    [("impulse", 0.0), ("impulse", math.nan), ("module", 0), ("fraction", 0.0), ("cycles", 0)],
)
def test_malformed_arguments_are_refused(name, given):
    with pytest.raises(ValueError, match=f"^{name}: "):
        decay_time(SYSTEM, **{"impulse": 1.0, name: given})


@pytest.mark.parametrize(("module", "first", "last"), [(1, 1.08, 1.1), (2, 1.25, 1.3)])
def test_the_quickest_decay_is_that_of_a_dense_search(module, first, last):
    """As quick as at any of very many impulses around it, and not quicker than a neighbour of one of them can be."""
    impulses = np.geomspace(0.5, 50.0, 41)
    times = [decay_time(SYSTEM, impulse, module) for impulse in impulses]
    impulse, shortest = quickest_decay(SYSTEM, impulses, times, module)
    assert shortest == decay_time(SYSTEM, impulse, module) < min(times)
    dense = np.linspace(first, last, 501)
    found = np.array([decay_time(SYSTEM, one, module) for one in dense])
    assert shortest <= found.min() < shortest + 5e-3 * SYSTEM.period
    assert impulse == pytest.approx(dense[found.argmin()], abs=2 * (dense[1] - dense[0]))
