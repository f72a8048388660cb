"""States with labelled components are read by their labels by the functions of the studies, too."""

import numpy as np
import pytest

import vibroimpact as vi
from labelled_states import LABELLED, START, SYSTEM

CALLS = {
    "sections": lambda state: vi.sections(SYSTEM, state, 2, progress=False),
    "largest_lyapunov": lambda state: vi.largest_lyapunov(SYSTEM, state, cycles=4, settle=2, blocks=2).mean,
    "lyapunov_spectrum": lambda state: vi.lyapunov_spectrum(SYSTEM, state, cycles=4, settle=2).exponents,
    "attractors": lambda state: vi.attractors(SYSTEM, [state], progress=False),
    "basins": lambda state: vi.basins(SYSTEM, {"X1": [START[0]]}, state, progress=False),
}


@pytest.fixture(autouse=True)
def settled(monkeypatch):
    """In place of attractors, the starts from which they would be looked for."""
    monkeypatch.setattr("vibroimpact.studies.regimes.attractors._basins", lambda system, states, *others: states)


@pytest.mark.parametrize("call", CALLS)
def test_labelled_components_are_read_by_their_labels(call):
    np.testing.assert_array_equal(CALLS[call](LABELLED["a row"]), CALLS[call](START))
