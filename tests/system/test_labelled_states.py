"""States with labelled components are read by their labels, in whatever order, or refused."""

import numpy as np
import pandas as pd
import pytest

import vibroimpact as vi
from labelled_states import LABELLED, ROW, SHUFFLED, START, STATE, SYSTEM, UNKNOWN, VALUES
from vibroimpact.system.state import NAMES, states_array

TABLE = pd.DataFrame([VALUES, VALUES], columns=SHUFFLED)
OWN = vi.simulate(SYSTEM, START, 3).to_frame()
CALLS = {
    "simulate": lambda state: vi.simulate(SYSTEM, state, 2).final,
    "simulate_many": lambda state: [run.final for run in vi.simulate_many(SYSTEM, [state, state], 2)],
    "ensemble": lambda state: vi.ensemble(SYSTEM, state, 2)["final"],
    "ensemble of lists": lambda state: vi.ensemble([[SYSTEM], [SYSTEM]], [[state], [state]], 2)["final"],
}


@pytest.mark.parametrize("kind", LABELLED)
@pytest.mark.parametrize("call", CALLS)
def test_labelled_components_are_read_by_their_labels(call, kind):
    np.testing.assert_array_equal(CALLS[call](LABELLED[kind]), CALLS[call](START))


@pytest.mark.parametrize("kind", UNKNOWN)
def test_other_labels_are_refused_with_their_names(kind):
    state, labels = UNKNOWN[kind]
    with pytest.raises(ValueError, match=rf"\Astate: the columns .*{labels}.* are not those of a state, X1, Y1"):
        vi.simulate(SYSTEM, state, 2)


@pytest.mark.parametrize(
    "states", [TABLE, TABLE.to_dict("list"), TABLE.to_records(), [ROW, START], TABLE.assign(n="a")]
)
def test_tables_of_states_are_read_by_their_columns(states):
    np.testing.assert_array_equal(states_array("states", states), [START, START])


def test_rows_of_tables_of_results_are_states():
    """Of events, which have words beside the numbers; and of ensembles, which end in a state."""
    events = vi.simulate(SYSTEM, START, 3).events["state"]
    assert OWN.iloc[0].dtype == object
    for states in (OWN, [row for _, row in OWN.iterrows()], [*OWN.itertuples()], OWN.to_dict("records")):
        np.testing.assert_array_equal(states_array("states", states), events)
    np.testing.assert_array_equal(vi.simulate(SYSTEM, OWN.iloc[0], 0).final, events[0])
    np.testing.assert_array_equal(vi.simulate(SYSTEM, OWN.iloc[0][[*NAMES]].to_numpy(), 0).final, events[0])
    outcome = vi.ensemble(SYSTEM, [START, START], 2)
    np.testing.assert_array_equal(states_array("states", vi.to_frame(outcome)), outcome["final"])


@pytest.mark.parametrize(
    "values",
    [START, tuple(START), np.array(START), pd.Series(START), pd.DataFrame([START]).iloc[0], [np.float32(1)] * 8],
)
def test_without_labels_a_state_is_read_by_position(values):
    np.testing.assert_array_equal(states_array("state", values), np.array(values, dtype=float))


@pytest.mark.parametrize("value", [None, "0.1", True, 1j, pd.NA])
def test_a_labelled_component_that_is_no_number_is_named(value):
    with pytest.raises(ValueError, match=r"\Astate\['Y2'\]: .* is not an array of real numbers\Z"):
        vi.simulate(SYSTEM, {**STATE, "Y2": value}, 1)


def test_an_array_of_xarray_with_labels_is_refused():
    xarray = pytest.importorskip("xarray")
    labelled = xarray.DataArray(VALUES, dims="component", coords={"component": SHUFFLED})
    with pytest.raises(ValueError, match="state: arrays labelled by 'component' are not supported; pass a table"):
        vi.simulate(SYSTEM, labelled, 1)
