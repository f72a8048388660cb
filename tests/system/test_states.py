"""States are plain numbers in the documented order; values with labels are refused."""

from collections import namedtuple

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.system.state import NAMES, states_array

SYSTEM = vi.System(**PARAMETERS, f10_hat=1.0, f20_hat=0.89)
START = [0.1, -0.2, 0.3, 0.05, 0.4, -0.6, 0.7, 0.8]
STATE = dict(zip(NAMES, START, strict=True))
ROW = pd.Series(START, NAMES)
LABELLED = [
    ROW,
    STATE,
    [ROW, START],
    [[START], [STATE]],
    pd.DataFrame([START], columns=NAMES),
    namedtuple("State", NAMES)(*START),
]


@pytest.mark.parametrize("values", LABELLED)
def test_values_with_labels_are_refused_in_one_line(values):
    for name, call in (("state", vi.simulate), ("states", vi.simulate_many), ("states", vi.ensemble)):
        with pytest.raises(
            ValueError, match=rf"\A{name}: got a \w+, expected plain numbers in the order X1, Y1.*dY2\Z"
        ):
            call(SYSTEM, values, 1)


def test_an_array_of_xarray_with_labels_is_refused():
    xarray = pytest.importorskip("xarray")
    labelled = xarray.DataArray(START, dims="component", coords={"component": [*NAMES]})
    with pytest.raises(ValueError, match="state: got a DataArray"):
        vi.simulate(SYSTEM, labelled, 1)


def test_a_row_of_a_structured_array_is_refused():
    row = np.array([tuple(START)], [(name, float) for name in NAMES])[0]
    with pytest.raises(ValueError, match=r"state: .* is not an array of real numbers"):
        vi.simulate(SYSTEM, row, 1)


@pytest.mark.parametrize("values", [START, tuple(START), np.array(START), np.array(START, object), [np.float32(1)] * 8])
def test_plain_numbers_are_read_by_position(values):
    np.testing.assert_array_equal(states_array("state", values), np.array(values, dtype=float))


def test_the_columns_of_a_table_of_events_are_states():
    run = vi.simulate(SYSTEM, START, 3)
    states = run.to_frame()[[*NAMES]].to_numpy()
    np.testing.assert_array_equal(states_array("states", states), run.events["state"])
