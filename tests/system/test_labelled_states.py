"""States with labelled components are read by their labels, in whatever order, or refused."""

import subprocess
import sys
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
SHUFFLED = ["X1", "X2", "Y1", "Y2", "dX1", "dX2", "dY1", "dY2"]
"""An order in which a state read by position is another admissible one."""
PRIMED = [name if len(name) == 2 else f"{name[1:]}'" for name in SHUFFLED]
VALUES = [STATE[name] for name in SHUFFLED]
ROW = pd.Series(VALUES, SHUFFLED)
TABLE = pd.DataFrame([VALUES, VALUES], columns=SHUFFLED)
OWN = vi.simulate(SYSTEM, START, 3).to_frame()
CALLS = {
    "simulate": lambda state: vi.simulate(SYSTEM, state, 2).final,
    "simulate_many": lambda state: [run.final for run in vi.simulate_many(SYSTEM, [state, state], 2)],
    "ensemble": lambda state: vi.ensemble(SYSTEM, state, 2)["final"],
    "ensemble of lists": lambda state: vi.ensemble([[SYSTEM], [SYSTEM]], [[state], [state]], 2)["final"],
    "sections": lambda state: vi.sections(SYSTEM, state, 2, progress=False),
    "largest_lyapunov": lambda state: vi.largest_lyapunov(SYSTEM, state, cycles=4, settle=2, blocks=2).mean,
    "lyapunov_spectrum": lambda state: vi.lyapunov_spectrum(SYSTEM, state, cycles=4, settle=2).exponents,
    "attractors": lambda state: vi.attractors(SYSTEM, [state], progress=False),
    "basins": lambda state: vi.basins(SYSTEM, {"X1": [START[0]]}, state, progress=False),
}
LABELLED = {
    "a row": ROW,
    "a row with primes": pd.Series(VALUES, PRIMED),
    "a row of mixed columns": pd.Series([*VALUES, "impact"], [*SHUFFLED, "kind"], dtype=object),
    "a mapping": dict(zip(SHUFFLED, VALUES, strict=True)),
    "a named tuple": namedtuple("State", SHUFFLED)(*VALUES),
    "a row of a structured array": np.array([tuple(VALUES)], [(name, float) for name in SHUFFLED])[0],
}
UNKNOWN = {
    "other names": (pd.Series(START, [*"abcdefgh"]), "a, b, c"),
    "a name missing": (ROW.drop("dX1"), "dY1, dY2"),
    "a name twice": (pd.Series([*VALUES, 0.0], [*SHUFFLED, "X1"]), "dY2, X1"),
    "a name in both spellings": (pd.Series([*VALUES, 0.0], [*SHUFFLED, "X1'"]), "dY2, X1'"),
    "a misspelt name": ({"x1": 0.0, **dict.fromkeys(NAMES[1:], 0.0)}, "x1, Y1"),
    "numbers in another order": (pd.Series(START, [1, 0, *range(2, 8)]), "1, 0, 2"),
    "an event": (vi.simulate(SYSTEM, START, 3).events[0], "tau, module, wall, kind, state"),
    "states in columns": (pd.DataFrame([START] * 8, columns=NAMES).T, "0, 1, 2"),
}


@pytest.fixture(autouse=True)
def settled(monkeypatch):
    """In place of attractors, the starts from which they would be looked for."""
    monkeypatch.setattr("vibroimpact.studies.public.attractors._basins", lambda system, states, *others: states)


@pytest.mark.parametrize("kind", LABELLED)
@pytest.mark.parametrize("call", CALLS)
def test_labelled_components_are_read_by_their_labels(call, kind):
    np.testing.assert_array_equal(CALLS[call](LABELLED[kind]), CALLS[call](START))


@pytest.mark.parametrize("kind", UNKNOWN)
@pytest.mark.parametrize("call", ["simulate", "simulate_many", "ensemble", "basins"])
def test_other_labels_are_refused_with_their_names(call, kind):
    state, labels = UNKNOWN[kind]
    with pytest.raises(
        ValueError, match=rf"\Astates?(\[\d\])*: the columns .*{labels}.* are not those of a state, X1, Y1"
    ):
        CALLS[call](state)


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


def test_pandas_is_not_imported_for_it():
    code = "import sys; from vibroimpact.system.state import NAMES, states_array as states; "
    code += "states('state', dict.fromkeys(NAMES, 0.0)); print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "pandas" not in run.stdout.split()


def test_an_array_of_xarray_with_labels_is_refused():
    xarray = pytest.importorskip("xarray")
    labelled = xarray.DataArray(VALUES, dims="component", coords={"component": SHUFFLED})
    with pytest.raises(ValueError, match="state: an array labelled by 'component'; give a table"):
        vi.simulate(SYSTEM, labelled, 1)
