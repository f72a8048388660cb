"""The impulse response, computed by matrix exponentials, equals its Fourier series."""

import numpy as np
import pytest

import vibroimpact as vi
from by_hand import BoxesByHand
from vibroimpact.exact.orbits.impulse_response import ImpulseResponse, forced_amplitude


def fourier(system, sign, s, harmonics=4000):
    """Return the displacements (2, 2) from unit impulses that repeat with the given sign, summed over harmonics."""
    orders = np.arange(1, harmonics, 2) if sign == -1 else np.arange(1, harmonics)
    weight = 2 / (system.period / 2 if sign == -1 else system.period)
    hand, omega = BoxesByHand(system), orders[:, None, None] * system.Omega
    receptance = np.linalg.inv(hand.stiffness - omega**2 * np.eye(2) + 1j * omega * hand.damping)
    total = weight * (receptance * np.exp(1j * omega * s)).real.sum(axis=0)
    return total if sign == -1 else total + np.linalg.inv(hand.stiffness) / system.period


def motion(response, s):
    """Return the motion (4, 2) a time s after an impulse; column j is the response to impulses on box j."""
    return response(s, np.arange(2)).T


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize("fraction", [0.11, 0.37, 0.83])
def test_displacement_is_the_fourier_series(chapter, sign, fraction):
    system = chapter(epsilon=0.3)
    s = fraction * system.period
    found = motion(ImpulseResponse(system, sign), s)[:2]
    np.testing.assert_allclose(found, fourier(system, sign, s), rtol=0, atol=3e-7)


@pytest.mark.parametrize("sign", [-1, 1])
def test_only_velocities_jump_at_an_impulse_and_by_the_impulse(chapter, sign):
    response = ImpulseResponse(chapter(), sign)
    n = response.interval
    after = motion(response, 0.0)
    jump = after - sign * motion(response, np.nextafter(n, 0))
    np.testing.assert_allclose(jump, np.eye(4)[:, 2:], rtol=0, atol=3e-14 * abs(after).max())


UNDAMPED = dict.fromkeys(("alpha12_hat", "gamma1_hat", "gamma2_hat", "gamma12_hat", "sigma20_hat"), 0.0)


@pytest.mark.parametrize(("sign", "harmonic", "fails"), [(-1, 3, True), (-1, 2, False), (1, 2, True), (1, 3, True)])
@pytest.mark.parametrize("boxes", ["second", "both"])
def test_undamped_resonance_with_the_impacts_is_refused(chapter, sign, harmonic, fails, boxes):
    """If both boxes resonate, the matrix of the equations is zero within rounding, and then appears regular."""
    system = chapter(**UNDAMPED)
    tuned = system.with_(sigma20_hat=((harmonic * system.Omega) ** 2 - 1) / system.epsilon)
    if boxes == "both":
        tuned = system.with_(sigma_e_hat=(1 / harmonic - 1) / system.epsilon)
    if fails:
        with pytest.raises(ValueError, match=r"\Asystem: .* undamped resonance at an? .*multiple of the forcing"):
            ImpulseResponse(tuned, sign)
    else:
        assert np.isfinite(motion(ImpulseResponse(tuned, sign), 1.0)).all()


def test_an_undamped_resonance_on_which_the_forces_do_no_work_is_refused(chapter):
    """The forces are in antiphase; boxes with only a damper between them oscillate freely in phase."""
    free = dict.fromkeys(("alpha12_hat", "gamma1_hat", "gamma2_hat", "sigma20_hat", "sigma_e_hat"), 0.0)
    system = chapter(**free, f10_hat=1.0, f20_hat=-1.0)
    for call in (vi.orbits, forced_amplitude):
        with pytest.raises(ValueError, match=r"\Asystem: .* undamped resonance at "):
            call(system)
    with pytest.raises(ValueError, match=r"\Asigma_e_hat: .* resonance"):
        vi.fixed_points(system)
