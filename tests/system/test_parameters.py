"""Parameters are scaled from (10.1) to (10.2); derived quantities, matrices and verdicts follow from them."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import vibroimpact as vi
from chapter import PARAMETERS
from vibroimpact.system.matrices import damping_matrix, dynamic_stiffness, rate_matrix, stiffness_matrix
from vibroimpact.system.verdict import STABLE, UNDECIDED, UNSTABLE, all_stable, verdict

CHAPTER = dict(**PARAMETERS, f10_hat=1.0, f20_hat=0.89)
PLANT = vi.PhysicalSystem(
    M=2.0, m=0.3, k1=50.0, k2=60.0, k12=4.0, c1=0.2, c2=0.5, c12=0.7, F10=0.4, F20=0.9, omega1=5.5, omega2=5.5, L=0.05,
    kappa=0.4,
)  # fmt: skip


def test_dimensionless_parameters_follow_the_definitions_below_10_2():
    system = PLANT.dimensionless()
    assert PLANT.omega10 == 5.0
    assert system.epsilon == pytest.approx(0.15)
    assert system.stiffness2 == pytest.approx(60 / (2 * 25))
    assert (system.gamma1, system.gamma2, system.gamma12) == pytest.approx((0.2 / 10, 0.5 / 10, 0.7 / 10))
    assert system.alpha12 == pytest.approx(4 / 50)
    assert system.Omega == pytest.approx(5.5 / 5)
    assert system.forcing == pytest.approx([0.4 / (2 * 0.05 * 25), 0.9 / (2 * 0.05 * 25)])
    assert system.period == pytest.approx(2 * math.pi / 1.1)


@pytest.mark.parametrize(
    ("coupled", "forces", "modules"),
    [
        (True, (1.0, 0.0), (1, 2)), (True, (0.0, 1.0), (1, 2)), (True, (0.0, 0.0), ()), (False, (1.0, 1.0), (1, 2)),
        (False, (1.0, 0.0), (1,)), (False, (0.0, 1.0), (2,)), (False, (0.0, 0.0), ()),
    ],
)  # fmt: skip
def test_modules_take_part_if_a_force_or_the_other_module_moves_them(coupled, forces, modules):
    links = {} if coupled else dict(alpha12_hat=0.0, gamma12_hat=0.0)
    f10, f20 = forces
    assert vi.System(**CHAPTER | links | dict(f10_hat=f10, f20_hat=f20)).modules == modules


UNDAMPED = dict.fromkeys(("gamma1_hat", "gamma2_hat", "gamma12_hat"), 0.0)


@pytest.mark.parametrize(
    ("changes", "load"),
    [
        # uncoupled boxes: resonance of box 1, of box 2, and of both, where the dynamic stiffness vanishes
        (UNDAMPED | dict(alpha12_hat=0.0, sigma20_hat=0.5, sigma_e_hat=0.0), [1, 0]),
        (UNDAMPED | dict(alpha12_hat=0.0, sigma20_hat=2.1, sigma_e_hat=1.0), [0, 1]),
        (UNDAMPED | dict(alpha12_hat=0.0, sigma20_hat=0.0, sigma_e_hat=0.0), [1, 0]),
        (UNDAMPED | dict(alpha12_hat=0.0, sigma20_hat=0.0, sigma_e_hat=0.0), [0, 1]),
        # equal boxes: in phase, without and with a damper between them, and in antiphase
        (UNDAMPED | dict(sigma20_hat=0.0, sigma_e_hat=0.0), [1, 1]),
        (UNDAMPED | dict(alpha12_hat=0.0, gamma12_hat=0.2, sigma20_hat=0.0, sigma_e_hat=0.0), [1, 1]),
        (UNDAMPED | dict(alpha12_hat=2.2, sigma20_hat=0.0, sigma_e_hat=10 * (math.sqrt(1.44) - 1)), [1, -1]),
    ],
)
def test_forces_that_do_work_on_an_undamped_resonance_are_refused(changes, load):
    """Forces orthogonal to the mode, small damping and detuning are accepted."""
    one, other = load
    for f10, f20 in ((one, other), (-0.01 * one, -0.01 * other), (one + other, other - one)):
        with pytest.raises(ValueError, match=r"\Asigma_e_hat: .* the forces excite an undamped resonance of the boxes"):
            vi.System(**CHAPTER | changes | dict(f10_hat=f10, f20_hat=f20))
    if any(dynamic_stiffness(vi.System(**CHAPTER | changes | dict(f10_hat=0.0, f20_hat=0.0))).ravel()):
        vi.System(**CHAPTER | changes | dict(f10_hat=-other, f20_hat=one))
    vi.System(**CHAPTER | changes | dict(f10_hat=one, f20_hat=other, gamma1_hat=1e-6, gamma2_hat=1e-6))
    vi.System(**CHAPTER | changes | dict(f10_hat=one, f20_hat=other, sigma_e_hat=changes["sigma_e_hat"] + 1e-6))


@pytest.mark.parametrize("drive", [{"base": 0.3}, {"unbalance": 0.2}])
@pytest.mark.parametrize("omega", [0.6, 1.4, 3.0])
def test_the_response_to_a_moving_base_or_an_unbalance_is_the_closed_form(drive, omega):
    """The ball does not impact. The response is the transmissibility, or u omega^2 over the dynamic stiffness."""
    M, k, c, L = 2.0, 5.0, 0.7, 3.0
    machine = vi.PhysicalSystem.single(M=M, m=0.1, k=k, c=c, L=L, omega=omega, **drive)
    load = 0.3 * abs(k + 1j * c * omega) if "base" in drive else 0.2 * omega**2
    amplitude = load / abs(k - M * omega**2 + 1j * c * omega)
    orbit = vi.periodic_orbit(machine.dimensionless(), [0.0] * 8)
    assert orbit.amplitudes[0] * L == pytest.approx(amplitude, rel=1e-12)
    twice = replace(machine, omega1=2 * omega)
    assert pytest.approx(machine.force(2 * omega), rel=1e-15) == twice.F10


def test_a_machine_has_one_drive():
    machine = dict(M=1.0, m=0.1, k=1.0, c=0.1)
    with pytest.raises(ValueError, match=r"\AF, base: got 1.0 and 0.1; give one of them"):
        vi.PhysicalSystem.single(**machine, F=1.0, base=0.1)
    with pytest.raises(ValueError, match=r"\Abase, unbalance: got 0.1 and 0.2; give one of them"):
        vi.PhysicalSystem.single(**machine, base=0.1, unbalance=0.2)
    with pytest.raises(ValueError, match=r"\Aunbalance: -0.2 is below 0"):
        vi.PhysicalSystem.single(**machine, unbalance=-0.2)
    with pytest.raises(ValueError, match=r"\AF: "):
        vi.PhysicalSystem.single(**machine, F=[1.0, 2.0], base=0.1)


def test_matrices_are_those_of_10_2():
    """(10.2) is written out term by term."""
    system = vi.System(**CHAPTER)
    x1, x2, d1, d2, tau = np.random.default_rng(0).normal(size=5)
    spring, damper = 0.1 * (x2 - x1), 0.02 * (d2 - d1)
    first = 0.1 * np.sin(1.02 * tau) - 0.02 * d1 - x1 + damper + spring
    second = 0.089 * np.sin(1.02 * tau) - 0.02 * d2 - 1.05 * x2 - damper - spring
    z = np.array([x1, x2, d1, d2, np.sin(1.02 * tau), np.cos(1.02 * tau)])
    for stuck, mass in (((False, False), (1, 1)), ((True, False), (1.1, 1)), ((True, True), (1.1, 1.1))):
        expected = [d1, d2, first / mass[0], second / mass[1], 1.02 * z[5], -1.02 * z[4]]
        np.testing.assert_allclose(rate_matrix(system, stuck) @ z, expected, rtol=1e-14)
    response = np.linalg.solve(dynamic_stiffness(system), system.forcing)
    residual = stiffness_matrix(system) @ response + 1.02j * damping_matrix(system) @ response - 1.02**2 * response
    np.testing.assert_allclose(residual, system.forcing, atol=1e-14)


@given(st.floats(allow_nan=False), st.floats(0, allow_nan=False))
def test_a_verdict_is_undecided_exactly_within_the_error(margin, error):
    assert verdict(margin, error) == (STABLE if margin > error else UNSTABLE if -margin > error else UNDECIDED)


def test_verdicts_without_numbers_are_undecided_and_one_unstable_module_decides():
    assert {verdict(math.nan, 0.1), verdict(1.0, math.nan), verdict(1e300, math.inf)} == {UNDECIDED}
    assert all_stable([STABLE, UNDECIDED, UNSTABLE]) == all_stable([UNSTABLE, STABLE]) == UNSTABLE
    assert all_stable([STABLE, UNDECIDED]) == all_stable([UNDECIDED]) == UNDECIDED
    assert all_stable([STABLE, STABLE]) == STABLE
