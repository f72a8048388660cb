"""Parameters: scaling of (10.1) to (10.2) and back, derived quantities, refused values."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.system.matrices import damping_matrix, dynamic_stiffness, rate_matrix, stiffness_matrix

CHAPTER = dict(
    **PARAMETERS, f10_hat=1.0, f20_hat=0.89,
)  # fmt: skip

BAD = {
    "kappa of 1": (dict(kappa=1.0), r"kappa: 1.0 is not between 0 and 1"),
    "kappa of 0": (dict(kappa=0.0), r"kappa: 0.0 is not between 0 and 1"),
    "no ball": (dict(epsilon=0.0), r"epsilon: 0.0 is not above 0"),
    "negative damping": (dict(gamma12_hat=-0.1), r"gamma12_hat: -0.1 is below 0"),
    "negative coupling": (dict(alpha12_hat=-1.0), r"alpha12_hat: -1.0 is below 0"),
    "no stiffness": (dict(sigma20_hat=-10.0), r"sigma20_hat: 1 \+ epsilon sigma20_hat = 0.0 is not above 0"),
    "no frequency": (dict(sigma_e_hat=-11.0), r"sigma_e_hat: 1 \+ epsilon sigma_e_hat = .* is not above 0"),
    "not a number": (dict(f10_hat=math.nan), r"f10_hat: nan is not finite"),
    "huge": (dict(epsilon=1e300), r"epsilon: 1e\+300 is beyond 1e\+15"),
    "text": (dict(f10_hat="much"), r"f10_hat: 'much' is not a number"),
    "undamped resonance": (
        dict(alpha12_hat=0.0, gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0, sigma_e_hat=0.0),
        r"sigma_e_hat: 0.0 drives the undamped boxes at their resonance",
    ),
}


@pytest.mark.parametrize(("changes", "message"), BAD.values(), ids=BAD)
def test_inadmissible_parameters_are_named(changes, message):
    with pytest.raises(ValueError, match=message):
        vi.System(**{**CHAPTER, **changes})


def test_resonance_without_load_or_with_damping_is_admissible():
    undamped = dict(alpha12_hat=0.0, gamma1_hat=0.0, gamma2_hat=0.0, gamma12_hat=0.0, sigma_e_hat=0.0)
    vi.System(**{**CHAPTER, **undamped, "f10_hat": 0.0})  # the resonating first box carries no force
    vi.System(**{**CHAPTER, **undamped, "gamma1_hat": 0.1})


def test_definitions_below_10_2():
    """Every dimensionless parameter from its definition, written out with numbers."""
    physical = vi.PhysicalSystem(
        M=2.0, m=0.3, k1=50.0, k2=60.0, k12=4.0, c1=0.2, c2=0.5, c12=0.7, F10=0.4, F20=0.9, omega1=5.5, omega2=5.5,
        L=0.05, kappa=0.4,
    )  # fmt: skip
    system = physical.dimensionless()
    assert physical.omega10 == 5.0
    assert system.epsilon == pytest.approx(0.15)
    assert system.stiffness2 == pytest.approx(60 / (2 * 25))
    assert (system.gamma1, system.gamma2, system.gamma12) == pytest.approx((0.2 / 10, 0.5 / 10, 0.7 / 10))
    assert system.alpha12 == pytest.approx(4 / 50)
    assert system.Omega == pytest.approx(5.5 / 5)
    assert system.forcing == pytest.approx([0.4 / (2 * 0.05 * 25), 0.9 / (2 * 0.05 * 25)])
    assert system.period == pytest.approx(2 * math.pi / 1.1)


positive = st.floats(0.05, 20.0)


@given(M=positive, k1=positive, L=positive, epsilon=st.floats(0.01, 1), kappa=st.floats(0.01, 0.99))
def test_there_and_back(M, k1, L, epsilon, kappa):
    system = vi.System(**{**CHAPTER, "epsilon": epsilon, "kappa": kappa})
    back = vi.PhysicalSystem.from_dimensionless(system, M=M, k1=k1, L=L).dimensionless()
    for name in CHAPTER:
        assert getattr(back, name) == pytest.approx(getattr(system, name), rel=1e-12, abs=1e-12)


def test_physical_refusals():
    values = vars(vi.PhysicalSystem.from_dimensionless(vi.System(**CHAPTER), M=1.0, k1=1.0, L=1.0))
    for name, value, message in (
        ("M", 0.0, "M: 0.0 is not above 0"),
        ("L", -1.0, "L: -1.0 is not above 0"),
        ("c1", -1.0, "c1: -1.0 is below 0"),
        ("F10", math.inf, "F10: inf is not finite"),
        ("kappa", 1.5, "kappa: 1.5 is not between 0 and 1"),
    ):
        with pytest.raises(ValueError, match=message):
            vi.PhysicalSystem(**{**values, name: value}).dimensionless()
    with pytest.raises(ValueError, match=r"omega2: 2.0 differs from omega1"):
        vi.PhysicalSystem(**{**values, "omega2": 2.0}).dimensionless()


def test_matrices_are_those_of_10_2():
    """Against the left-hand sides of (10.2) typed term by term."""
    system = vi.System(**CHAPTER)
    rng = np.random.default_rng(0)
    x1, x2, d1, d2, tau = rng.normal(size=5)
    spring, damper = 0.1 * (x2 - x1), 0.02 * (d2 - d1)
    first = 0.1 * np.sin(1.02 * tau) - 0.02 * d1 - x1 + damper + spring
    second = 0.089 * np.sin(1.02 * tau) - 0.02 * d2 - 1.05 * x2 - damper - spring
    z = np.array([x1, x2, d1, d2, np.sin(1.02 * tau), np.cos(1.02 * tau)])
    for stuck, mass in (((False, False), (1, 1)), ((True, False), (1.1, 1)), ((True, True), (1.1, 1.1))):
        rates = rate_matrix(system, stuck) @ z
        expected = [d1, d2, first / mass[0], second / mass[1], 1.02 * z[5], -1.02 * z[4]]
        np.testing.assert_allclose(rates, expected, rtol=1e-14)
    assert np.allclose(stiffness_matrix(system), stiffness_matrix(system).T)
    assert (np.linalg.eigvalsh(damping_matrix(system)) > 0).all()
    response = np.linalg.solve(dynamic_stiffness(system), system.forcing)
    residual = stiffness_matrix(system) @ response + 1.02j * damping_matrix(system) @ response - 1.02**2 * response
    np.testing.assert_allclose(residual, system.forcing, atol=1e-14)


def test_import_stays_light():
    import subprocess
    import sys

    loaded = "import sys, vibroimpact; print([m for m in ('pandas', 'matplotlib', 'numba') if m in sys.modules])"
    assert subprocess.check_output([sys.executable, "-c", loaded], text=True).strip() == "[]"
