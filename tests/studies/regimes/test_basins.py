"""Basins of attraction on a plane of starts: the plane, the basin of a stable orbit, and mirror images."""

import numpy as np

from vibroimpact.studies.regimes.basins import MIRRORED, ends, plane, stable_response
from vibroimpact.studies.regimes.classification import ASYMMETRIC


def test_the_plane_varies_only_the_positions_of_the_balls():
    state = np.array([0.1, 0.5, -0.2, 0.3, 0.4, -0.6, 0.7, -0.8])
    states = plane(state, 4)
    W = np.column_stack([states[:, 0] - states[:, 1], states[:, 2] - states[:, 3]])
    others = [0, 2, 4, 5, 6, 7]
    assert np.array_equal(states[:, others], np.tile(state[others], (16, 1)))
    np.testing.assert_allclose(W[:4], [[-0.75, -0.75], [-0.75, -0.25], [-0.75, 0.25], [-0.75, 0.75]])
    assert len(np.unique(W.round(9), axis=0)) == 16


def test_a_stable_orbit_is_in_its_own_basin(chapter, observation):
    system = chapter(1.0, 0.89)
    orbit = stable_response(system)
    flights = orbit.ball_speeds[:, ::-1] / orbit.ball_speeds.sum(axis=1, keepdims=True)
    assert flights[0, 0] > 0.5  # a longer flight from wall +1, which is a positive flight asymmetry
    assert ends(system, [orbit.state, orbit.state + 1e-3], observation) == [ASYMMETRIC] * 2


def test_without_a_stable_asymmetric_orbit_the_response_is_none(chapter):
    assert stable_response(chapter(0.5, 0.5)) is None


def test_mirrored_starts_under_mirrored_forces_end_in_the_mirror_image(chapter, observation):
    states = plane(stable_response(chapter(1.0, 0.89)).state, 6)
    names = ends(chapter(1.0, 0.89), states, observation)
    mirrored = ends(chapter(-1.0, -0.89), -states, observation)
    swap = {ASYMMETRIC: MIRRORED, MIRRORED: ASYMMETRIC}
    assert {ASYMMETRIC, MIRRORED} <= set(names)
    assert [swap.get(name, name) for name in names] == mirrored
