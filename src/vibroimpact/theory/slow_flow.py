"""Slow flow on the manifold, (10.22), and its linearisation, as derived in docs/derivation.md."""

import numpy as np
from scipy.linalg import eigvals

from vibroimpact.theory.manifold import B_of_C, rho, slope

# Amplitude of the first harmonic of the saw-tooth with C = 1, (10.19).
FIRST_HARMONIC = 8 / np.pi**2
MODULES = np.array([1, 1, 2, 2])
"""Modules of the slow variables (C_1, psi_1, C_2, psi_2) and of the equations of their rates."""
_ONE = np.eye(2)


def impedances(system) -> tuple[np.ndarray, complex]:
    """Return the slow impedances (e_1, e_2), shape (2,), of the uncoupled boxes without balls, and K.

    K is the impedance of the coupling. With b_i = B_i exp(-i psi_i) the slow flow is 2i D_1 b_i = f_i - (e_i + N(C_i))
    b_i - K (b_i - b_j), where N is the describing function of the ball.
    """
    detuning = np.array([0, system.sigma20_hat]) - 2 * system.sigma_e_hat
    damping = np.array([system.gamma1_hat, system.gamma2_hat])
    return detuning + 1j * damping, system.alpha12_hat + 1j * system.gamma12_hat


def rates(system, B, psi, C) -> tuple[np.ndarray, np.ndarray]:
    """Return (D_1 B_i, D_1 psi_i), each shape (2,), by (10.22); both vanish at a fixed point, (10.23).

    Parameters
    ----------
    B, psi, C
        Amplitudes, phases [rad] and saw-tooth amplitudes of the modules, each shape (2,).
    """
    return rates_from_phasors(system, np.asarray(B), np.cos(psi), np.sin(psi), np.asarray(C))


def rates_from_phasors(system, B, cosine, sine, C):
    """Return `rates` as rational functions of B, cos psi, sin psi and C, each shape (2,).

    This form is suitable for computer algebra.
    """
    forcing = np.array([system.f10_hat, system.f20_hat])
    damping = np.array([system.gamma1_hat, system.gamma2_hat]) + system.gamma12_hat
    stiffness = np.array([0, system.sigma20_hat]) + system.alpha12_hat - 2 * system.sigma_e_hat
    other = B[::-1]
    cosine_ahead = cosine * cosine[::-1] + sine * sine[::-1]  # cos(psi_i - psi_j)
    sine_ahead = sine * cosine[::-1] - cosine * sine[::-1]
    ball_damping = FIRST_HARMONIC * rho(system.kappa) * C**2 / B
    ball_stiffness = FIRST_HARMONIC * C * (1 - C) / B
    in_quadrature = system.gamma12_hat * cosine_ahead + system.alpha12_hat * sine_ahead
    in_phase = system.alpha12_hat * cosine_ahead - system.gamma12_hat * sine_ahead
    dB = (forcing * sine - damping * B - ball_damping + other * in_quadrature) / 2
    dpsi = (forcing * cosine - stiffness * B - ball_stiffness + other * in_phase) / (2 * B)
    return dB, dpsi


def equations(system, psi, C) -> tuple[np.ndarray, np.ndarray]:
    """Return D_1 of (B_1, psi_1, B_2, psi_2) on the manifold, (4,), and its derivative (4, 4).

    The derivative is with respect to (C_1, psi_1, C_2, psi_2).

    For a single machine the shapes are (2,) and (2, 2).

    Parameters
    ----------
    psi, C
        Phases [rad] and saw-tooth amplitudes, each shape (2,).
    """
    psi, C = (np.where(_taking_part(system)[::2], of, 0.0) for of in (psi, C))
    rest = np.column_stack(rates(system, B_of_C(C, rho(system.kappa)), psi, C)).ravel()
    return rest[_taking_part(system)], linearisation(system, psi, C)[0]


def linearisation(system, psi, C) -> tuple[np.ndarray, np.ndarray]:
    """Return matrices (J, M), each (..., 4, 4): M d/dtau_1 = J for perturbations of (C_1, psi_1, C_2, psi_2).

    Both stay finite at the fold C_min, where M (the slope of the manifold) is singular because C cannot
    follow B; the usual Jacobian in (B, psi) is infinite there. For a single machine both are (..., 2, 2).

    Parameters
    ----------
    psi, C
        Phases [rad] and saw-tooth amplitudes on the manifold, each shape (..., 2); of a single machine those of the
        other module have no effect.
    """
    r = rho(system.kappa)
    psi, C = (np.where(_taking_part(system)[::2], of, 0.0) for of in (psi, C))
    B, B_C = B_of_C(C, r), slope(C, r)
    ball = FIRST_HARMONIC * (C * (1 - C) + 1j * r * C**2) / B
    ball_C = FIRST_HARMONIC * (1 - 2 * C + 2j * r * C) / B - ball * B_C / B
    return pencil(system, psi, B, ball, B_C, ball_C)


def pencil(system, psi, B, ball, B_x, ball_x) -> tuple[np.ndarray, np.ndarray]:
    """Return `linearisation` for modules on any curve B(x), N(x) B(x) of a parameter x.

    The perturbations are those of (x_i, psi_i).

    Parameters
    ----------
    psi
        Phases [rad], shape (..., 2).
    B, ball
        Amplitudes B_i and complex N_i B_i, each shape (..., 2).
    B_x, ball_x
        Their derivatives by x_i.
    """
    e, K = impedances(system)
    forcing = np.array([system.f10_hat, system.f20_hat])
    ahead = np.exp(1j * np.asarray(psi))
    # D_1 B_i = Im(drive_i) / 2 and D_1 psi_i = Re(drive_i) / (2 B_i), the complex form of (10.22).
    from_other = K * ahead * (B / ahead)[..., ::-1]
    drive = forcing * ahead - (e + K) * B - ball + from_other
    drive_own_x = -(e + K) * B_x - ball_x
    drive_own_psi = 1j * (forcing * ahead + from_other)
    drive_other_x = K * ahead * (B_x / ahead)[..., ::-1]
    drive_other_psi = -1j * from_other

    change = np.stack([drive_own_x, drive_own_psi, drive_other_x, drive_other_psi], axis=-1)
    change[..., 1, :] = change[..., 1, [2, 3, 0, 1]]
    J = np.stack([change.imag / 2, change.real / (2 * B[..., None])], axis=-2).reshape(*B.shape[:-1], 4, 4)
    J[..., 1::2, ::2] -= _ONE * (drive.real * B_x / (2 * B**2))[..., None]
    M = np.zeros(J.shape)
    M[..., ::2, ::2], M[..., 1::2, 1::2] = _ONE * B_x[..., None], _ONE
    part = _taking_part(system)
    return J[..., part, :][..., part], M[..., part, :][..., part]


def _taking_part(system):
    """Return the rows (4,) of the modules that take part.

    For a system at rest these are all rows, since motions die out.
    """
    part = system.modules or (1, 2)
    return np.array([module in part for module in MODULES])


def jacobian(system, psi, C) -> np.ndarray:
    """Return the Jacobian (4, 4) of (10.22) in (B_1, psi_1, B_2, psi_2).

    C follows B on its arm of the manifold.

    Parameters
    ----------
    psi, C
        Phases [rad] and saw-tooth amplitudes on the manifold, each shape (2,).

    Raises
    ------
    ValueError
        If some C_i is at the fold, where the Jacobian is infinite.
    """
    J, M = linearisation(system, psi, C)
    follow = np.diag(M)
    if np.any(follow == 0):
        raise ValueError(f"C: {C} is at the fold C_min of the manifold, where dC/dB is infinite")
    return J / follow


def slow_eigenvalues(system, psi, C) -> np.ndarray:
    """Return the complex eigenvalues, per unit of tau_1, by descending real part; infinite at the fold.

    There are two for each module that takes part.

    Parameters
    ----------
    psi, C
        Phases [rad] and saw-tooth amplitudes of a fixed point, each shape (2,).
    """
    return descending(eigvals(*linearisation(system, psi, C)))


def descending(values) -> np.ndarray:
    """Return the eigenvalues by descending real part."""
    return values[np.argsort(-values.real, kind="stable")]
