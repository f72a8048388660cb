"""A perturbed motion departs at the rate of its multiplier until its flights are unequal."""

import numpy as np
import pytest

import vibroimpact as vi
from chapter import system_of
from vibroimpact.studies.figures import nudge

EQUAL = system_of("equal")


def test_the_distance_grows_by_the_multiplier_until_flights_are_unequal():
    tables = nudge.compute(EQUAL)
    orbit = min(
        (one for one in vi.orbits(EQUAL) if one.symmetric), key=lambda one: np.abs(one.C - [1.0957, 1.8108]).max()
    )
    assert tables["orbit"].to_numpy().tolist() == [["c", pytest.approx(abs(orbit.multipliers[0]))]]
    growth = np.diff(np.log(tables["distance"]["distance"]))
    assert tables["distance"]["distance"][0] == pytest.approx(nudge.PERTURBATION, rel=1e-6)
    np.testing.assert_allclose(growth[3:11], np.log(2.43617), atol=0.01)
    lengths = tables["flights"]["length"].to_numpy()
    np.testing.assert_allclose(lengths[:12], 0.5, atol=1e-3)
    assert (np.abs(lengths[-40:] - 0.5) > 0.05).all()
    texts = [text.get_text() for text in nudge.draw(tables).axes[0].texts]
    assert texts == ["times 2.44\nper period"]


def test_tables_are_empty_if_no_unstable_motion_is_called_stable():
    tables = nudge.compute(EQUAL.with_(f10_hat=0.5, f20_hat=0.5))
    assert all(len(table) == 0 for table in tables.values())
    assert len(nudge.draw(tables).axes) == 2
