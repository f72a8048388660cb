"""Proofs on single orbits agree with orbits in 80 digits, and refuse wrong or degenerate orbits."""

import dataclasses

import mpmath
import numpy as np
import pytest

flint = pytest.importorskip("flint", reason="python-flint belongs to the optional extra `reference`")

import vibroimpact as vi  # noqa: E402
from attacks import random_system  # noqa: E402
from chapter import system_of  # noqa: E402
from stroboscope import ORDER, Stroboscope  # noqa: E402
from vibroimpact.exact.orbits.floquet import floquet  # noqa: E402
from vibroimpact.exact.orbits.proof.orbit import prove  # noqa: E402
from vibroimpact.exact.orbits.search import symmetric_orbit  # noqa: E402
from vibroimpact.exact.orbits.symmetric import symmetric_solutions  # noqa: E402

DIGITS = 80
REFUSED = (0.0, np.inf, "not proved", "not proved", np.inf)


def results(proof):
    return proof.radius, proof.error, proof.motion, proof.stability, proof.moduli_error


@pytest.fixture(scope="module")
def orbits():
    """Return the orbits of the case `equal` by label: S1 to S4 and A1 to A8."""
    labels = [*(f"S{k}" for k in range(1, 5)), *(f"A{k}" for k in range(1, 9))]
    return dict(zip(labels, vi.orbits(system_of("equal")), strict=True))


@pytest.fixture(scope="module")
def proofs(orbits):
    return {label: prove(orbit) for label, orbit in orbits.items()}


@pytest.mark.parametrize("label", ["S4", "A3", "A7"])
def test_enclosures_contain_the_multipliers_of_the_orbit_in_80_digits(orbits, proofs, label):
    orbit, proof = orbits[label], proofs[label]
    with mpmath.workdps(DIGITS), flint.ctx.workprec(4 * DIGITS):
        strobe = Stroboscope(orbit)
        state, jacobian = strobe.closed(mpmath.matrix(orbit.state[ORDER].tolist()))
        assert mpmath.norm(strobe(state) - state) < mpmath.mpf(10) ** -45
        phases, speeds = strobe.phases, strobe.speeds
        true = mpmath.eig(jacobian, right=False)
        inside = [[box.contains(_ball(value)) for value in true] for box in proof.multipliers]
        moduli = sorted((abs(value) for value in true), reverse=True)
        listed = np.abs(orbit.multipliers)  # moduli of an array are rounded differently from those of its entries
        error = max(abs(value - mpmath.mpf(float(one))) for value, one in zip(moduli, listed, strict=True))
    np.testing.assert_array_equal(np.sum(inside, axis=1), 1)
    np.testing.assert_array_equal(np.sum(inside, axis=0), 1)
    assert all(float(box.rad()) < 1e-20 for box in proof.multipliers)
    assert float(error) <= proof.moduli_error == pytest.approx(float(error), rel=1e-6)
    order = np.argsort(orbit.impact_phases.ravel())
    gaps = [*(phases - orbit.impact_phases.ravel()[order]), *(speeds - orbit.ball_speeds.ravel()[order])]
    assert float(max(map(abs, gaps))) <= proof.error == pytest.approx(float(max(map(abs, gaps))), rel=1e-6)


def _ball(value):
    digits = [mpmath.nstr(part, 40) for part in (value.real, value.imag)]
    return flint.acb(*(flint.arb(text) + flint.arb(0, 1e-38) for text in digits))


def test_proofs_of_all_orbits_of_the_case_agree_with_the_verdicts_in_floats(orbits, proofs):
    assert {proofs[label].motion for label, orbit in orbits.items() if orbit.admissible} == {"legal"}
    assert {proofs[label].motion for label, orbit in orbits.items() if not orbit.admissible} == {"not legal"}
    assert all(proofs[label].stability == floquet(orbit) for label, orbit in orbits.items())
    assert {proof.stability for proof in proofs.values()} == {"stable", "unstable"}
    assert min(proof.radius for proof in proofs.values()) > 1e-4
    through_a_wall = [
        label for label, orbit in orbits.items() if (orbit.ball_speeds > 0).all() and not orbit.admissible
    ]
    assert through_a_wall  # inadmissible orbits that are not recognised by the signs of their speeds


@pytest.mark.parametrize("seed", [5, 11])
def test_orbits_of_random_systems_are_proved(seed):
    for orbit in vi.orbits(random_system(np.random.default_rng(seed))):
        proof = prove(orbit)
        assert (proof.motion, proof.stability) == ("legal" if orbit.admissible else "not legal", floquet(orbit))


@pytest.mark.parametrize(("beyond", "motion"), [(-1e-7, "not legal"), (1e-7, "legal")])
def test_proofs_distinguish_a_near_miss_from_a_hit(chapter, beyond, motion):
    """The force is next to the one at which an asymmetric orbit grazes, found by continuation."""
    near = vi.orbits(chapter(1.0, 0.7645496612 + beyond))
    orbit = min(near, key=lambda o: np.hypot(*(o.C - [1.7160529, 0.6802411])) + o.symmetric)
    assert prove(orbit).motion == motion


def test_wrong_orbits_are_refused_and_small_errors_are_reported(orbits):
    orbit = orbits["A3"]
    wrong = [
        {"impact_phases": orbit.impact_phases + np.array([[0.01, 0.0], [0.0, 0.0]])},
        {"ball_speeds": orbit.ball_speeds * 1.05},
        {"symmetric": True},
        {"system": orbit.system.with_(f10_hat=1.01)},
        {"state": orbit.state + np.eye(8)[5] * 1e-3},
        {"multipliers": orbit.multipliers * [1, 1, 1, 0.99, 1, 1, 1, 1]},
        {"multipliers": np.r_[orbit.multipliers[:-1], orbit.multipliers[0]]},
    ]
    for change in wrong:
        assert results(prove(dataclasses.replace(orbit, **change))) == REFUSED, change
    assert results(prove(dataclasses.replace(orbits["S4"], symmetric=False))) == REFUSED
    off = dataclasses.replace(orbit, ball_speeds=orbit.ball_speeds + 1e-7, multipliers=orbit.multipliers * (1 + 1e-6))
    assert prove(off).error == pytest.approx(1e-7, rel=1e-3)
    assert prove(off).moduli_error == pytest.approx(1e-6 * abs(orbit.multipliers[0]), rel=1e-3)


def test_nothing_is_proved_where_symmetry_breaks_or_impacts_coincide(chapter):
    """At a symmetry breaking three orbits merge; the order of simultaneous impacts is undecided."""

    def symmetric(f):
        system = chapter(f, f)
        root = min(symmetric_solutions(system), key=lambda root: np.hypot(root[2] - 1.6217, root[3] - 1.2138))
        return symmetric_orbit(system, root)

    low, high = 1.19, 1.21
    while low < (middle := (low + high) / 2) < high:
        low, high = (middle, high) if np.abs(symmetric(middle).multipliers[1]) < 1 else (low, middle)
    outside = [sum(abs(value) > 1 for value in prove(symmetric(f)).multipliers) for f in (1.19, 1.21)]
    assert outside == [1, 2]
    assert results(prove(symmetric(low))) == results(prove(symmetric(high))) == REFUSED
    equal = [orbit for orbit in vi.orbits(chapter(sigma20_hat=0)) if np.ptp(orbit.impact_phases, axis=0).max() < 1e-9]
    assert equal
    assert {results(prove(orbit)) for orbit in equal} == {REFUSED}
