"""Motions that every method is measured on, with their references."""

from functools import cache

import pytest

from chapter import PARAMETERS
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.integrators import METHODS
from vibroimpact.system import System

EQUAL = System(**PARAMETERS, f10_hat=1.0, f20_hat=1.0)
WEAK = System(**PARAMETERS, f10_hat=0.5, f20_hat=0.5)
MOTIONS = {
    "periodic": (EQUAL, (-0.0863, 0.3689, -0.4889, -0.7167, -0.1597, -0.6893, -0.3681, -1.2869), 3),
    "chatter": (WEAK, (-0.8, -1.799, 0.1, 0.1, 0.0, -0.01, 0.0, 0.0), 1),
}


@cache
def reference(name):
    system, state, cycles = MOTIONS[name]
    return proven_run(system, state, cycles).run


@pytest.fixture
def motion():
    """By name: (system, start, cycles, reference run)."""
    return lambda name: (*MOTIONS[name], reference(name))


@pytest.fixture
def method():
    """By name: an installed method."""

    def find(name):
        found = next(method for method in METHODS if method.name == name)
        if found.available():
            pytest.skip(found.available())
        return found

    return find
