"""The bounds that prove steps of lanes free of impacts hold; results do not depend on the length of vectors."""

import numpy as np
import pytest
from llvmlite.binding import get_host_cpu_features, get_host_cpu_name
from mpmath import mp
from scipy.linalg import expm

from attacks import ensembles, random_system
from by_hand import exact_rate
from programs import run_program
from vibroimpact.exact.engine.flow import numbers_of
from vibroimpact.exact.lanes import loop, rows, steps
from vibroimpact.system.matrices import rate_matrix, stiffness_matrix

GRID = 400


def constants(system):
    """Return the constants of a system in the memory of the lanes after a run."""
    memory, unobserved = loop.memory(), (np.empty((1, 4, 0, 6, 6)), np.empty((1, 4, 0)))
    systems = *numbers_of([system], loop.TABLE), np.zeros((1, 2)), *unobserved
    results = np.zeros(1, np.int64), np.zeros((1, 1, 8)), np.zeros((1, 1, rows.STATISTICS))
    loop.run_lanes(loop.Piece(*systems, np.zeros(1, np.int64), np.zeros((1, 8)), (1, 1, 0), *results), memory)
    return memory.constants[:, 0]


def systems(count):
    """Return random systems with moderate parameters, and as many stiff ones."""
    rng = np.random.default_rng(3)
    return [*(random_system(rng) for _ in range(count)), *ensembles["stiff"](rng, count)[0]]


def test_the_matrix_of_a_step_is_known_beyond_float_accuracy():
    """The rounding error of an entry would repeat in every step."""
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
    """The worst function has the bound as its fourth derivative everywhere, and coefficients up to the limits."""
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
import numpy as np
import vibroimpact as vi
from attacks import ensembles, unlike_single_runs
for kind in ("equal", "sweep", "hostile"):
    drawn = ensembles[kind](np.random.default_rng(6), 40)
    assert unlike_single_runs(*drawn) == []
    print(vi.ensemble(*drawn).tobytes().hex())
"""


def outcomes_of(name, features, cache):
    """Return the outcomes of the script in a process that compiles for another processor."""
    processor = {"NUMBA_CPU_NAME": name, "NUMBA_CPU_FEATURES": features}
    run = run_program(SCRIPT, NUMBA_CACHE_DIR=str(cache), **processor)
    assert run.returncode == 0, run.stderr
    return run.stdout


@pytest.mark.thorough
def test_shorter_vectors_give_the_same_outcomes(tmp_path):
    """The compiler divides the vectors; each operation has the same rounding."""
    name, features = get_host_cpu_name(), get_host_cpu_features().flatten()
    short = outcomes_of(name, features.replace("+avx512", "-avx512"), tmp_path / "short")
    assert outcomes_of(name, features, tmp_path / "long") == short


@pytest.mark.thorough
def test_ensembles_agree_with_single_runs_on_processors_without_vectors_or_fused_products(tmp_path):
    assert outcomes_of("generic", "", tmp_path)
