"""Test the proof that lists of fixed points are complete: known counts, closed forms, folds and wrong lists."""

import dataclasses
import itertools

import numpy as np
import pytest

from systems_of_points import FOLD, NEARLY_ELASTIC, UNCOUPLED, UNDAMPED, build, single_module
from vibroimpact.studies.completeness import points as module
from vibroimpact.studies.completeness.points import certify
from vibroimpact.theory import manifold
from vibroimpact.theory.fixed_points.symmetric_points import search

IMPEDANCES = -0.4 + 0.2j, 0.1 + 0.2j  # of the boxes without balls


@pytest.mark.parametrize(("f10", "f20", "points"), [(1, 1, 4), (1, 0.89, 4), (0.5, 0.5, 2)])
def test_lists_for_the_cases_of_the_chapter_are_complete(f10, f20, points):
    proof = certify(build(dict(f10_hat=f10, f20_hat=f20)))
    assert proof.complete
    assert proof.undecided == []
    assert len(proof.isolated) == points


@pytest.mark.parametrize("kappa", [0.1, 0.65, 0.95])
def test_boxes_of_uncoupled_modules_contain_the_roots_of_two_quadratics(kappa):
    proof = certify(build(UNCOUPLED | dict(kappa=kappa)))
    expected = list(itertools.product(*(single_module(e, 1.0, kappa) for e in IMPEDANCES)))
    assert proof.complete
    assert len(expected) == len(proof.isolated) > 0
    for box, C in zip(proof.isolated, expected, strict=True):
        assert all(low <= c <= high for (low, high), c in zip(box, C, strict=True))
        assert np.diff(box).max() < 1e-5 * (1 + np.square(C).max())


def test_a_point_on_the_edge_between_charts_is_counted_once():
    """Closed forms give the forces of a point at C_1 = C_2 = 1, the edge between the charts of small and large C."""
    edge = {f"f{i}0_hat": abs(8 / np.pi**2 - 1j * e * manifold.rho(0.65)) for i, e in enumerate(IMPEDANCES, 1)}
    proof = certify(build(UNCOUPLED | edge))
    assert proof.complete
    contains_edge = [all(low <= 1 <= high for low, high in box) for box in proof.isolated]
    assert sum(contains_edge) == 1
    assert len(contains_edge) == 4


def test_a_list_with_a_missing_or_spurious_point_is_not_complete(monkeypatch):
    listed = search(build())
    elsewhere = dataclasses.replace(listed[-1], C=listed[-1].C + 1)
    for wrong in (listed[:-1], [*listed, listed[-1]], [*listed, elsewhere]):
        monkeypatch.setattr(module, "search", lambda system, wrong=wrong: wrong)
        assert not certify(build()).complete


def test_the_neighbourhood_of_a_fold_is_undecided_and_nearby_systems_are_complete():
    proof = certify(build(dict(f20_hat=FOLD)))
    assert not proof.complete
    assert proof.undecided
    for box in proof.undecided:
        np.testing.assert_allclose(np.mean(box, axis=1), [0.62661, 1.86850], atol=1e-4)
    before, after = (certify(build(dict(f20_hat=FOLD + shift))) for shift in (-1e-6, 1e-6))
    assert before.complete
    assert after.complete
    assert len(after.isolated) - len(before.isolated) == 2


@pytest.mark.parametrize(
    ("f10", "f20", "changes"),
    [(0.1, 0.1, {}), (0, 0.3, {}), (0, 0, {}), (0, 0, UNDAMPED), (0.1, 0, UNCOUPLED), (0, 0, UNCOUPLED)],
)
def test_the_absence_of_fixed_points_is_proved(f10, f20, changes):
    """(10.22) has no solution, since impacting balls would dissipate more energy than the forces can supply."""
    proof = certify(build(dict(f10_hat=f10, f20_hat=f20, **changes)))
    assert proof == module.Proof([], [], 0, complete=True)


@pytest.mark.parametrize("name", NEARLY_ELASTIC)
def test_nearly_elastic_systems_are_proved_or_undecided(name):
    """Where Delta, n_1 and n_2 nearly vanish, rounding may leave boxes undecided."""
    system = build({"gamma12_hat": 0.0} | NEARLY_ELASTIC[name])
    found = search(system)
    proof = certify(system)
    assert proof.complete == (len(proof.isolated) == len(found) and not proof.undecided)
    assert proof.undecided or name == "weak dampers"
