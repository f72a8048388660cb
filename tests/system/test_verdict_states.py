"""Three states: a verdict only outside the error bound."""

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from vibroimpact.system.verdict import STABLE, UNDECIDED, UNSTABLE, all_stable, verdict


@given(st.floats(allow_nan=False), st.floats(0, allow_nan=False))
def test_decided_exactly_outside_the_error(margin, error):
    assert (verdict(margin, error) == UNDECIDED) == (abs(margin) <= error)
    opposite = {STABLE: UNSTABLE, UNSTABLE: STABLE, UNDECIDED: UNDECIDED}
    assert verdict(-margin, error) == opposite[verdict(margin, error)]


def test_positive_margins_are_stable():
    assert verdict(1.0, 0.5) == STABLE


@pytest.mark.parametrize(("margin", "error"), [(float("nan"), 0.1), (1.0, float("nan")), (1e300, float("inf"))])
def test_nothing_is_decided_without_numbers(margin, error):
    assert verdict(margin, error) == UNDECIDED


def test_one_unstable_module_decides_and_order_does_not_matter():
    states = (STABLE, UNDECIDED, UNSTABLE)
    rank = {state: k for k, state in enumerate(states)}
    for triple in itertools.product(states, repeat=3):
        assert all_stable(triple) == states[max(rank[state] for state in triple)]
