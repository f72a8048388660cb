"""The proofs of the lanes: the bound on the fourth derivative, the hull of Hermite's polynomial; vectors or none."""

import os
import subprocess
import sys

import numpy as np
import pytest
from llvmlite.binding import get_host_cpu_features, get_host_cpu_name
from mpmath import mp
from scipy.linalg import expm

from attacks import GENES, bred, random_system
from by_hand import exact_rate
from vibroimpact.exact.engine.flow import numbers_of
from vibroimpact.exact.lanes import loop, rows, steps
from vibroimpact.system.matrices import rate_matrix, stiffness_matrix

GRID = 400


def constants(system):
    """Constants of a system in the lanes, left there by a run."""
    memory, unobserved = loop.memory(), (np.empty((1, 4, 0, 6, 6)), np.empty((1, 4, 0)))
    systems = *numbers_of([system], loop.TABLE), np.zeros((1, 2)), *unobserved
    results = np.zeros(1, np.int64), np.zeros((1, 1, 8)), np.zeros((1, 1, rows.STATISTICS))
    loop.run_lanes(loop.Piece(*systems, np.zeros(1, np.int64), np.zeros((1, 8)), (1, 1, 0), *results), memory)
    return memory.constants[:, 0]


def systems(count):
    rng = np.random.default_rng(3)
    yield from (random_system(rng) for _ in range(count))
    while count:
        try:
            yield bred(rng.uniform(0, 1, GENES))[0].system
            count -= 1
        except ValueError:
            continue


def test_a_step_of_the_boxes_is_known_beyond_rounding():
    """What a float leaves out of an entry would repeat in every step."""
    for system in systems(3):
        c = constants(system)
        with mp.workdps(60):
            step = mp.expm(exact_rate(system) * c[rows.STEP]) - mp.eye(6)
            for i, k in np.ndindex(4, 4):
                left = step[i, k] - mp.mpf(c[6 * i + k]) - mp.mpf(c[rows.LOW_PARTS + 4 * i + k])
                assert abs(left) < 2.0**-90 * max(abs(step[i, j]) for j in range(4))


def test_the_fourth_derivative_stays_below_its_bound_throughout_a_flight():
    rng, closest = np.random.default_rng(4), 0.0
    for system in systems(40):
        c, rate = constants(system), rate_matrix(system)
        boxes, phase = rng.normal(size=4) * 10 ** rng.uniform(-2, 1), rng.uniform(0, 7)
        z = np.array([*boxes, np.sin(phase), np.cos(phase)])
        size = np.sqrt(boxes[2:] @ boxes[2:] + boxes[:2] @ stiffness_matrix(system) @ boxes[:2])
        times = np.linspace(0.0, 6.0 / system.Omega, GRID)
        step, fourth = expm(rate * times[1]), np.linalg.matrix_power(rate, 4)[:2]
        for t in times:
            bound = 72 * (c[rows.BEND] * (size + t * c[rows.DRIVE]) + c[rows.BEND_FORCE])
            closest = max(closest, np.abs(fourth @ z).max() / bound)
            z = step @ z
    assert 0.1 < closest <= 1.0


def test_no_function_with_a_bounded_fourth_derivative_leaves_the_hull():
    """The worst, whose fourth derivative is the bound everywhere, with coefficients up to the limits."""
    rng, s, h = np.random.default_rng(5), np.linspace(0.0, 1.0, 2001), 0.4
    nearest = 0.0
    for _ in range(2000):
        bend = 10 ** rng.uniform(-3, 2)
        limit = 1.0 - bend * h**4 / 72
        ends, middle = rng.choice([1.0, rng.uniform(-1, 1)], 2), limit * rng.choice([1.0, rng.uniform(-1, 1)], 2)
        rates = 3 * (middle[0] - ends[0]) / h, 3 * (ends[1] - middle[1]) / h
        inside = steps._inside(limit + 1e-15, ends[0], rates[0], ends[1], rates[1], h / 3)
        assert inside
        cubic = (1 - s) ** 3 * ends[0] + 3 * s * (1 - s) * ((1 - s) * middle[0] + s * middle[1]) + s**3 * ends[1]
        worst = (cubic + bend * h**4 * (s * (1 - s)) ** 2 / 24)[1:-1].max()
        nearest = max(nearest, worst)
        assert worst <= 1.0 + 1e-14
        assert not steps._inside(limit - 1e-9, 1.0, 3 * (limit - 1.0) / h, 0.0, 0.0, h / 3)
    assert nearest > 1.0 - 1e-3


SCRIPT = """
import sys
import numpy as np
import vibroimpact as vi
from attacks import ensembles, unlike_single_runs
for kind in ("equal", "sweep", "hostile"):
    drawn = ensembles[kind](np.random.default_rng(6), 40)
    assert unlike_single_runs(*drawn) == []
    sys.stdout.buffer.write(vi.ensemble(*drawn).tobytes())
"""


def outcomes_of(processor, cache):
    """Outcomes of the script in a process that compiles for another processor."""
    path = os.pathsep.join(entry for entry in sys.path if entry)
    environment = os.environ | {"PYTHONPATH": path, "NUMBA_CACHE_DIR": str(cache)} | processor
    return subprocess.run([sys.executable, "-c", SCRIPT], env=environment, check=True, stdout=subprocess.PIPE).stdout


@pytest.mark.thorough
def test_shorter_vectors_give_the_same_outcomes(tmp_path):
    """The compiler cuts the vectors up; each operation rounds as it does in a lane."""
    features = get_host_cpu_features().flatten()
    short = features.replace("+avx512", "-avx512")
    name = get_host_cpu_name()
    one, other = (
        outcomes_of({"NUMBA_CPU_NAME": name, "NUMBA_CPU_FEATURES": kind}, tmp_path / str(k))
        for k, kind in enumerate((features, short))
    )
    assert one == other


@pytest.mark.thorough
def test_processors_without_vectors_or_fused_products_run_as_simulate_does_there(tmp_path):
    assert outcomes_of({"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}, tmp_path)
