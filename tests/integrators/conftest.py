"""Motions with which all methods are tested, and their references."""

from functools import cache

import pytest

from chapter import system_of
from vibroimpact.accuracy.reference.run import proven_run
from vibroimpact.integrators import METHODS

MOTIONS = {
    "periodic": (system_of("equal"), (-0.0863, 0.3689, -0.4889, -0.7167, -0.1597, -0.6893, -0.3681, -1.2869), 3),
    "chatter": (system_of("weak"), (-0.8, -1.799, 0.1, 0.1, 0.0, -0.01, 0.0, 0.0), 1),
}


@cache
def reference(name):
    system, state, cycles = MOTIONS[name]
    return proven_run(system, state, cycles).run


@pytest.fixture
def motion():
    """Return a function that returns (system, start, cycles, reference run) by name."""
    return lambda name: (*MOTIONS[name], reference(name))


@pytest.fixture
def method():
    """Return a function that returns an installed method by name; the test is skipped without it."""

    def find(name):
        found = next(method for method in METHODS if method.name == name)
        if found.available():
            pytest.skip(found.available())
        return found

    return find
