"""The proof that no fixed point is missing: exact counts, closed forms, folds, and lists that were spoilt."""

import dataclasses
import itertools

import numpy as np
import pytest

from systems_of_points import FOLD, NEARLY_ELASTIC, UNCOUPLED, UNDAMPED, build, single_module
from vibroimpact.studies.completeness import points as module
from vibroimpact.studies.completeness.points import certify
from vibroimpact.theory import manifold
from vibroimpact.theory.fixed_points.symmetric_points import search

EMPTY = -0.4 + 0.2j, 0.1 + 0.2j  # impedances of the boxes without balls


@pytest.mark.parametrize(("f10", "f20", "points"), [(1, 1, 4), (1, 0.89, 4), (0.5, 0.5, 2)])
def test_the_chapter_s_cases_are_complete(f10, f20, points):
    proof = certify(build(dict(f10_hat=f10, f20_hat=f20)))
    assert proof.complete
    assert proof.undecided == []
    assert len(proof.isolated) == points


@pytest.mark.parametrize("kappa", [0.1, 0.65, 0.95])
def test_proved_boxes_of_uncoupled_modules_hold_the_roots_of_two_quadratics(kappa):
    proof = certify(build(UNCOUPLED | dict(kappa=kappa)))
    expected = list(itertools.product(*(single_module(e, 1.0, kappa) for e in EMPTY)))
    assert proof.complete
    assert len(expected) == len(proof.isolated) > 0
    for box, C in zip(proof.isolated, expected, strict=True):
        assert all(low <= c <= high for (low, high), c in zip(box, C, strict=True))
        assert np.diff(box).max() < 1e-5 * (1 + np.square(C).max())


def test_a_point_on_the_edge_of_charts_is_counted_once():
    """C_1 = C_2 = 1, where small C and large C meet, for forces in closed form; with others it is proved as well."""
    edge = {f"f{i}0_hat": abs(8 / np.pi**2 - 1j * e * manifold.rho(0.65)) for i, e in enumerate(EMPTY, 1)}
    proof = certify(build(UNCOUPLED | edge))
    assert proof.complete
    holds = [all(low <= 1 <= high for low, high in box) for box in proof.isolated]
    assert sum(holds) == 1
    assert len(holds) == 4


def test_a_missing_point_and_a_spurious_one_are_found_out(monkeypatch):
    listed = search(build())
    elsewhere = dataclasses.replace(listed[-1], C=listed[-1].C + 1)
    for spoilt in (listed[:-1], [*listed, listed[-1]], [*listed, elsewhere]):
        monkeypatch.setattr(module, "search", lambda system, spoilt=spoilt: spoilt)
        assert not certify(build()).complete


def test_a_fold_stays_open_and_its_neighbours_do_not():
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
def test_no_fixed_point_is_a_result(f10, f20, changes):
    """No zero of (10.22) is there: the balls dissipate more than the forces supply, or than can be supplied."""
    proof = certify(build(dict(f10_hat=f10, f20_hat=f20, **changes)))
    assert proof == module.Proof([], [], 0, complete=True)


@pytest.mark.parametrize("name", NEARLY_ELASTIC)
def test_nearly_elastic_systems_are_proved_or_left_open(name):
    """Where Delta, n_1 and n_2 all but vanish rounding leaves zeros of the squares open that phases decide."""
    system = build({"gamma12_hat": 0.0} | NEARLY_ELASTIC[name])
    found = search(system)
    proof = certify(system)
    # The squares leave the place open, and there twins of one C, too.
    assert proof.complete == (len(proof.isolated) == len(found) and not proof.undecided)
    assert proof.undecided or name == "weak dampers"
