"""Invalid arguments are refused before any computation, in one short line that begins with the argument's name."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.accuracy.reference.run import reference_run
from vibroimpact.exact.orbits.search import search

CHAPTER = dict(**PARAMETERS, f10_hat=1.0, f20_hat=0.89)
SYSTEM = vi.System(**CHAPTER)
PHYSICAL = dict(
    M=1.0, m=0.1, k1=1.0, k2=1.05, k12=0.1, c1=0.02, c2=0.02, c12=0.02, F10=0.1, F20=0.089, omega1=1.02, omega2=1.02,
    L=1.0, kappa=0.65,
)  # fmt: skip
REST = [0.0] * 8
NOT_NUMBERS = [
    "0.65", None, True, np.True_, 0.65 + 0j, float("nan"), float("-inf"), 10**400, 10**5000, np.ma.masked,
    np.array([0.65]), Decimal("0.65"),
]  # fmt: skip
NOT_ARRAYS = [
    ["a"] * 8, ["0.0"] * 8, [None] * 8, [False] * 8, [0j] * 8, np.ma.masked_array(REST, mask=[1, *[0] * 7]),
    np.array([Fraction(0)] * 8, dtype=object), [10**400, *REST[1:]], [[0.0], [0.0, 0.0]], dict.fromkeys(range(8), 0.0),
    [np.nan, *REST[1:]],
]  # fmt: skip
BEYOND = [[1.5, *REST[1:]], [1e13, 1e13 - 10, 0, 0, 0, 0, 0, 0], [100.0, 99.0 - 1e-11, 0, 0, 0, 0, 0, 0]]
BAD_STATES = [*NOT_ARRAYS, None, 0.0, [0.0] * 7, [REST, REST], [np.inf, *REST[1:]], *BEYOND]
BAD_CYCLES = [*NOT_NUMBERS, -1, 2.5, 1e17, 10**12, 10**13, [3]]
BAD_TAU0 = [*NOT_NUMBERS, 1e300, 10**30, Fraction(10**30), 2.0**43, -(2.0**43)]
BAD_TIMES = [*NOT_ARRAYS, [1.0, 0.5], [-0.1], [100.0], [[0.0, 1.0]], 1.0]
NOT_SYSTEMS = [CHAPTER, None, vi.System, 0.1]
OUT_OF_BOUNDS = {
    "kappa": [0.0, 1.0, 1.5], "epsilon": [0.0, -0.1, 1e300], "gamma12_hat": [-0.1], "alpha12_hat": [-1.0],
    "sigma20_hat": [-10.0], "sigma_e_hat": [-11.0],
}  # fmt: skip
PHYSICAL_OUT_OF_BOUNDS = {"M": [0.0], "L": [-1.0], "k2": [0.0], "c1": [-1.0], "kappa": [1.5], "omega2": [2.0]}
CALLS = {
    "simulate": (vi.simulate, dict(system=SYSTEM, state=REST, cycles=2)),
    "simulate_many": (vi.simulate_many, dict(system=SYSTEM, states=[REST], cycles=2)),
    "ensemble": (vi.ensemble, dict(systems=SYSTEM, states=REST, cycles=3)),
    "fixed_points": (vi.fixed_points, {}),
    "orbits": (vi.orbits, {}),
    "periodic_orbit": (vi.periodic_orbit, dict(system=SYSTEM, state=REST, periods=1)),
    "search": (search, dict(system=SYSTEM)),
    "reference_run": (reference_run, dict(system_parameters=CHAPTER, state=REST, cycles=1, digits=30)),
    "errors": (vi.simulate(SYSTEM, REST, 1).errors, {}),
}
BAD = {
    "simulate": dict(system=NOT_SYSTEMS, state=BAD_STATES, cycles=BAD_CYCLES, tau0=BAD_TAU0, sample_times=BAD_TIMES),
    "simulate_many": dict(
        system=NOT_SYSTEMS, states=[*NOT_ARRAYS, None, REST, [REST, BEYOND[0]]], cycles=BAD_CYCLES, tau0=BAD_TAU0
    ),
    "ensemble": dict(systems=["equal", [None]], states=[np.zeros(7)], cycles=[-1], settle=[4, -1], tau0=[np.nan]),
    "fixed_points": dict(system=NOT_SYSTEMS),
    "orbits": dict(system=NOT_SYSTEMS),
    "periodic_orbit": dict(system=[None], state=[BEYOND[0]], periods=[0]),
    "search": dict(system=[None]),
    "reference_run": dict(
        state=[BEYOND[0], [0.0] * 7, [np.nan, *REST[1:]], [0, 0, 0, "1.0000000000000000001", 0, 0, 0, 0]], digits=[10],
        cycles=[-1], sample_times=[[3, 2], [7]], system_parameters=[{"kappa": "0.5"}],
    ),
    "errors": dict(times=[[2 * SYSTEM.period]]),
}  # fmt: skip


def cases():
    for call, table in BAD.items():
        for name, values in table.items():
            yield from (pytest.param(call, name, value, id=f"{call}, {name}, {k}") for k, value in enumerate(values))


def assert_refused(name, call):
    with pytest.raises(ValueError, match=rf"\A{name}[:\[]") as refusal:
        call()
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 240


@pytest.mark.parametrize(("call", "name", "value"), [*cases()])
def test_invalid_arguments_of_functions_are_refused(call, name, value):
    function, good = CALLS[call]
    assert_refused(name, lambda: function(**{**good, name: value}))


@pytest.mark.parametrize("name", CHAPTER)
def test_parameters_are_real_numbers_within_bounds(name):
    for value in [*NOT_NUMBERS, *OUT_OF_BOUNDS.get(name, [])]:
        assert_refused(name, lambda value=value: vi.System(**{**CHAPTER, name: value}))
        assert_refused(name, lambda value=value: SYSTEM.with_(**{name: value}))


@pytest.mark.parametrize("name", ["M", "F10", "kappa", "L", "k2", "c1", "omega2"])
def test_physical_parameters_are_real_numbers_within_bounds(name):
    for value in [*NOT_NUMBERS, *PHYSICAL_OUT_OF_BOUNDS.get(name, [])]:
        assert_refused(name, lambda value=value: vi.PhysicalSystem(**{**PHYSICAL, name: value}).dimensionless())


@pytest.mark.parametrize("kind", [float, int, Fraction, np.float32, np.float64, np.longdouble, np.int64])
def test_real_numbers_of_every_type_are_accepted(kind):
    system = vi.System(**{**CHAPTER, "f10_hat": kind(2)})
    assert type(system.f10_hat) is float
    start = np.array([0] * 8, dtype=np.int16)
    run = vi.simulate(system, start, kind(3), tau0=kind(1), sample_times=(1, 2))
    start[0] = 5  # the run has its own copy
    expected = vi.simulate(SYSTEM.with_(f10_hat=2.0), REST, 3, tau0=1.0)
    np.testing.assert_array_equal(run.final, expected.final)
    assert (run.cycles, run.start[0]) == (3, 0.0)


def test_results_are_shown_in_one_line():
    run = vi.simulate(SYSTEM, REST, 200)
    for result in (run, run.certificate, run.energy, vi.fixed_points(SYSTEM)[0], vi.orbits(SYSTEM)[1]):
        line = repr(result)
        assert line.startswith(f"{type(result).__name__}(")
        assert len(line) < 240
        assert "\n" not in line
    assert f"events={len(run.events)}: " in repr(run)
