"""Tiles make up the map, and cells say what simulations and theory say."""

import numpy as np
import pytest

import vibroimpact as vi
from vibroimpact.regimes.classification import REGIMES, STRONGLY_MODULATED, starts
from vibroimpact.regimes.regime_map import cell, centres, tile
from vibroimpact.regimes.settling import settle


@pytest.mark.parametrize("tiles", [1, 3, 4, 7])
def test_tiles_compose_to_the_whole(tiles):
    whole = tile((0.0, 1.0), (0.5, 2.0), 9, 0, 1)
    parts = np.vstack([tile((0.0, 1.0), (0.5, 2.0), 9, number, tiles) for number in range(tiles)])
    assert len(whole) == 81
    assert np.array_equal(np.unique(parts, axis=0), np.unique(whole, axis=0))
    sizes = [len(tile((0.0, 1.0), (0.5, 2.0), 9, number, tiles)) for number in range(tiles)]
    assert max(sizes) - min(sizes) <= 1


def test_cells_fill_their_interval():
    x = centres((0.2, 1.2), 5)
    np.testing.assert_allclose(x, [0.3, 0.5, 0.7, 0.9, 1.1])


def test_a_cell_does_not_depend_on_its_tile(chapter, observation):
    states = starts(3, seed=1)
    system = chapter(0.5, 0.5)
    assert cell(system, states, observation) == cell(chapter(0.5, 0.5), states.copy(), observation)


def test_shares_and_theory(chapter, observation):
    system = chapter(0.5, 0.5)
    found = cell(system, starts(4, seed=1), observation)
    assert set(found.shares) == set(REGIMES)
    assert sum(found.shares.values()) == pytest.approx(1)
    assert found.shares[STRONGLY_MODULATED] == 0.75
    assert found.from_rest == "one ball idle"
    assert (found.fixed_points, found.stable_points) == (len(vi.fixed_points(system)), 0)


def test_a_cell_and_its_mirror_image(chapter, observation):
    states = starts(4, seed=2)
    for f10, f20 in ((1.0, 0.89), (1.2, 1.3)):
        ours = cell(chapter(f10, f20), states, observation)
        mirrored = cell(chapter(-f10, -f20), -states, observation)
        assert ours.shares == mirrored.shares
        assert ours.fixed_points == mirrored.fixed_points
        assert ours.stable_points == mirrored.stable_points


def test_uncoupled_modules_are_classified_apart(chapter, observation):
    """Module 1 does the same whatever drives module 2."""
    states = starts(4, seed=3)[1:]
    amplitudes = [
        settle(chapter(1.2, f20, alpha12_hat=0.0, gamma12_hat=0.0), states, observation) for f20 in (0.9, 1.5)
    ]
    for one, other in zip(*amplitudes, strict=True):
        assert one.repeats == other.repeats == 1
        assert one.name != other.name
        assert one.mean_amplitudes[0] == pytest.approx(other.mean_amplitudes[0], rel=1e-6)
