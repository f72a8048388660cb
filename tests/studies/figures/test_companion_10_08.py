"""Flights in the companion of Fig. 10.8 are those of the exact orbits and of the fixed point."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import system_of
from figure_tables import tables_of_run
from vibroimpact.studies.figures import companion_10_08
from vibroimpact.tables import select
from vibroimpact.theory.fixed_points.table import fixed_point_table

SYSTEM = system_of("equal")


@pytest.fixture(scope="module")
def pair():
    """Return the stable asymmetric orbit and its mirror image."""
    return [orbit for orbit in vi.orbits(SYSTEM) if not orbit.symmetric and orbit.stable]


@pytest.fixture(scope="module")
def motion(pair):
    """Return the samples and events of the first orbit over three periods."""
    return tables_of_run(SYSTEM, pair[0].state, 0, 3, 64)


@pytest.fixture(scope="module")
def table(motion):
    """Return the table of the figure."""
    return companion_10_08.compute(SYSTEM, fixed_point_table("", SYSTEM), *motion)


def test_the_flights_are_those_of_the_exact_orbit_and_of_the_fixed_point(pair, table):
    hits = select(table, "simulation", "impact")
    expected = np.sort(np.add.outer(pair[0].impact_phases[1], [0, 1]).ravel())
    np.testing.assert_allclose(hits["phase"], expected, atol=1e-9)
    theory = select(table, "theory", "impact")
    assert set(theory["label"]) == {"c"}
    np.testing.assert_allclose(np.diff(theory["phase"]), 0.5)
    np.testing.assert_allclose(theory["W2"], np.resize([1, -1], len(theory)), atol=1e-9)


def test_the_grey_line_is_the_mirror_image(pair, table):
    image = select(table, "simulation", "mirror image")
    for wall, phase in zip((1, -1), pair[1].impact_phases[1], strict=True):
        np.testing.assert_allclose(np.interp([phase, phase + 1], image["phase"], image["W2"]), wall, atol=1e-6)
    assert image["phase"].between(0, 2).all()


def test_the_figure_labels_both_motions_and_the_lengths_of_their_flights(table, motion):
    figure = companion_10_08.draw(table)
    theory, simulated = ({text.get_text() for text in axes.texts} for axes in figure.axes)
    assert theory == {"", "0.50 $T$"}
    assert simulated == {"", "0.38 $T$", "0.62 $T$"}
    assert [axes.get_title("left") for axes in figure.axes] == ["theory: fixed point (c)", "simulated"]
    none = companion_10_08.compute(SYSTEM, fixed_point_table("", SYSTEM).head(0), *motion)
    assert companion_10_08.draw(none).axes[0].get_title("left") == "theory: no fixed point"
