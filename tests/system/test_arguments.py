"""What is no argument is refused before anything is computed, in one line that begins with its name."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import vibroimpact as vi
from chapter import PARAMETERS

CHAPTER = dict(**PARAMETERS, f10_hat=1.0, f20_hat=0.89)
REST = [0.0] * 8
NO_NUMBERS = {
    "text": "0.65",
    "nothing": None,
    "truth value": True,
    "numpy's truth value": np.True_,
    "complex": 0.65 + 0j,
    "not a number": float("nan"),
    "infinite": float("-inf"),
    "beyond floats": 10**400,
    "beyond what Python prints": 10**5000,
    "masked": np.ma.masked,
    "array": np.array([0.65]),
    "decimal": Decimal("0.65"),
}
NO_ARRAYS = {
    "texts": ["a"] * 8,
    "numeric strings": ["0.0"] * 8,
    "nothing": None,
    "nothing inside": [None] * 8,
    "truth values": [False] * 8,
    "complex": [0j] * 8,
    "masked": np.ma.masked_array(REST, mask=[1, *[0] * 7]),
    "objects": np.array([Fraction(0)] * 8, dtype=object),
    "beyond floats": [10**400, *REST[1:]],
    "ragged": [[0.0], [0.0, 0.0]],
    "mapping": dict.fromkeys(range(8), 0.0),
    "not a number": [np.nan, *REST[1:]],
}
NO_STATES = {
    **NO_ARRAYS,
    "number": 0.0,
    "seven": [0.0] * 7,
    "two rows": [REST, REST],
    "infinite": [np.inf, *REST[1:]],
    "beyond a wall": [1.5, *REST[1:]],
}
NO_CYCLES = {**NO_NUMBERS, "negative": -1, "half": 2.5, "huge": 10**12, "very huge": 10**5000, "array of one": [3]}
NO_START = {**NO_NUMBERS, "huge": 1e300, "huge, whole": 10**30, "huge, rational": Fraction(10**30)}
NO_TIMES = {
    **{name: value for name, value in NO_ARRAYS.items() if name != "nothing"},
    "descending": [1.0, 0.5],
    "before the start": [-0.1],
    "after the end": [100.0],
    "two rows": [[0.0, 1.0]],
    "number": 1.0,
}
NO_SYSTEMS = {"mapping": CHAPTER, "nothing": None, "class": vi.System, "number": 0.1}


def cases(**tables):
    """A case per argument and malformed value."""
    return [
        pytest.param(name, value, id=f"{name}: {what}")
        for name, table in tables.items()
        for what, value in table.items()
    ]


def refused(name, call):
    """The message of a refusal, which is one short line that begins with the argument."""
    with pytest.raises(ValueError, match=rf"\A{name}[:\[]") as refusal:
        call()
    message = str(refusal.value)
    assert "\n" not in message
    assert len(message) < 240
    return message


@pytest.mark.parametrize(("name", "value"), cases(**dict.fromkeys(CHAPTER, NO_NUMBERS)))
def test_a_parameter_is_a_real_number(name, value):
    refused(name, lambda: vi.System(**{**CHAPTER, name: value}))
    refused(name, lambda: vi.System(**CHAPTER).with_(**{name: value}))


@pytest.mark.parametrize(("name", "value"), cases(**dict.fromkeys(("M", "F10", "kappa"), NO_NUMBERS)))
def test_a_physical_parameter_is_a_real_number(name, value):
    physical = vars(vi.PhysicalSystem.from_dimensionless(vi.System(**CHAPTER), M=1.0, k1=1.0, L=1.0))
    refused(name, lambda: vi.PhysicalSystem(**{**physical, name: value}))


@pytest.mark.parametrize(
    ("name", "value"),
    cases(system=NO_SYSTEMS, state=NO_STATES, cycles=NO_CYCLES, tau0=NO_START, sample_times=NO_TIMES),
)
def test_arguments_of_simulate(name, value):
    arguments = {"system": vi.System(**CHAPTER), "state": REST, "cycles": 2, name: value}
    refused(name, lambda: vi.simulate(**arguments))


@pytest.mark.parametrize(
    ("name", "value"), cases(system=NO_SYSTEMS, states={**NO_ARRAYS, "one": REST}, cycles=NO_CYCLES, tau0=NO_START)
)
def test_arguments_of_simulate_many(name, value):
    arguments = {"system": vi.System(**CHAPTER), "states": [REST], "cycles": 2, name: value}
    refused(name, lambda: vi.simulate_many(**arguments))


def test_the_row_of_a_bad_start_is_named():
    system, row = vi.System(**CHAPTER), np.ma.masked_array(REST, mask=True)
    refused("states", lambda: vi.simulate_many(system, [REST, row], 2))
    assert "states[1]: state: |X1 - Y1| = 1.5 is above 1" in refused(
        "states", lambda: vi.simulate_many(system, [REST, [1.5, *REST[1:]]], 2)
    )


@pytest.mark.parametrize("search", [vi.fixed_points, vi.orbits])
@pytest.mark.parametrize("value", NO_SYSTEMS.values(), ids=NO_SYSTEMS)
def test_searches_want_a_system(search, value):
    refused("system", lambda: search(value))


@pytest.mark.parametrize("kind", [float, int, Fraction, np.float32, np.float64, np.longdouble, np.int64])
def test_real_numbers_of_every_kind_are_taken(kind):
    system = vi.System(**{**CHAPTER, "f10_hat": kind(2)})
    assert type(system.f10_hat) is float
    run = vi.simulate(system, np.array([0] * 8, dtype=np.int16), kind(3), tau0=kind(1), sample_times=(1, 2))
    expected = vi.simulate(vi.System(**{**CHAPTER, "f10_hat": 2.0}), REST, 3, tau0=1.0)
    np.testing.assert_array_equal(run.final, expected.final)
    assert run.cycles == 3


def test_the_state_of_the_caller_is_left_alone():
    start = np.zeros(8)
    run = vi.simulate(vi.System(**CHAPTER), start, 1)
    start[0] = 5.0
    assert run.start[0] == 0.0
