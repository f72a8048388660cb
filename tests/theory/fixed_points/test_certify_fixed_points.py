"""The proof that no fixed point is missing: against closed forms, planted omissions, and a fold left undecided."""

import itertools
import math

import numpy as np
import pytest

from chapter import PARAMETERS
from vibroimpact.system import System
from vibroimpact.theory import certify as module
from vibroimpact.theory.certify import certify
from vibroimpact.theory.fixed_points.search import FixedPointSearch, search

CHAPTER = System(**PARAMETERS, f10_hat=1, f20_hat=1)
FOLD = 0.6977803686883265  # f20_hat at which two fixed points of the chapter's system merge


def middle(box):
    return np.mean(box, axis=1)


@pytest.mark.parametrize(("f10", "f20", "points"), [(1, 1, 4), (1, 0.89, 4), (0.5, 0.5, 2)])
def test_the_chapter_s_cases_are_complete(f10, f20, points):
    proof = certify(CHAPTER.with_(f10_hat=f10, f20_hat=f20))
    assert proof.complete
    assert proof.undecided == []
    assert len(proof.isolated) == points


@pytest.mark.parametrize("kappa", [0.1, 0.65, 0.95])
def test_uncoupled_modules_have_the_roots_of_two_quadratics(kappa):
    """|(e_i (1 - (1 + i rho) C) + mu C)| = |f_i| in closed form, every pair of roots."""
    system = CHAPTER.with_(alpha12_hat=0, gamma12_hat=0, kappa=kappa)
    r, mu = 2 * (1 - kappa) / (math.pi * (1 + kappa)), 8 / math.pi**2
    roots = []
    for e in (-0.4 + 0.2j, 0.1 + 0.2j):
        slope = mu - e * (1 + 1j * r)
        both = np.roots([abs(slope) ** 2, 2 * (e.conjugate() * slope).real, abs(e) ** 2 - 1])
        roots.append(both[np.isreal(both)].real)
    expected = sorted(itertools.product(*roots))
    proof = certify(system)
    assert proof.complete
    assert len(expected) > 0
    np.testing.assert_allclose([middle(box) for box in proof.isolated], expected, atol=1e-5)


def test_a_missing_point_and_a_spurious_one_are_found_out(monkeypatch):
    listed = search(CHAPTER)
    for points in (listed.points[1:], [*listed.points, listed.points[0]]):
        spoilt = FixedPointSearch(points, listed.outside)
        monkeypatch.setattr(module, "search", lambda system, spoilt=spoilt: spoilt)
        assert not certify(CHAPTER).complete


def test_a_fold_stays_open_and_its_neighbours_do_not():
    proof = certify(CHAPTER.with_(f20_hat=FOLD))
    assert not proof.complete
    assert proof.undecided
    for box in proof.undecided:
        np.testing.assert_allclose(middle(box), [0.62661, 1.86850], atol=1e-4)
    before, after = (certify(CHAPTER.with_(f20_hat=FOLD + shift)) for shift in (-1e-6, 1e-6))
    assert before.complete
    assert after.complete
    assert len(after.isolated) - len(before.isolated) == 2


UNCOUPLED = {"alpha12_hat": 0, "gamma12_hat": 0}
UNDAMPED = {"gamma1_hat": 0, "gamma2_hat": 0, "gamma12_hat": 0}


@pytest.mark.parametrize(
    ("f10", "f20", "changes"),
    [(0.1, 0.1, {}), (0, 0.3, {}), (0, 0, {}), (0, 0, UNDAMPED), (1, 0, UNCOUPLED), (0, 1, UNCOUPLED | UNDAMPED)],
)
def test_no_fixed_point_is_a_result(f10, f20, changes):
    """No zero of (10.22) is there: the balls dissipate more than the forces supply, or than can be supplied."""
    proof = certify(CHAPTER.with_(f10_hat=f10, f20_hat=f20, **changes))
    assert proof == module.Proof([], [], 0, complete=True)


def test_every_damped_system_gets_a_proof_whatever_drives_it():
    """As many proved as listed, none among them, at random parameters and weak forces."""
    rng, without = np.random.default_rng(4), 0
    low = dict(kappa=0.1, alpha12_hat=0, gamma1_hat=0.1, gamma2_hat=0.1, gamma12_hat=0, sigma20_hat=-0.5)
    high = dict(kappa=0.9, alpha12_hat=1, gamma1_hat=0.5, gamma2_hat=0.5, gamma12_hat=0.5, sigma20_hat=1)
    low, high = low | dict(sigma_e_hat=-0.5, f10_hat=0, f20_hat=0), high | dict(sigma_e_hat=1, f10_hat=0.8, f20_hat=0.8)
    for _ in range(12):
        proof = certify(System(epsilon=0.1, **{name: rng.uniform(low[name], high[name]) for name in low}))
        assert proof.complete
        without += not proof.isolated
    assert without >= 3
