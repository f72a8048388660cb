"""Compute the slow flow on the manifold, (10.22), and its linearisation, as derived in docs/derivation.md."""

import numpy as np
from scipy.linalg import eigvals

from vibroimpact.theory.manifold import B_of_C, rho, slope

# Amplitude of the first harmonic of the saw-tooth with C = 1, (10.19).
FIRST_HARMONIC = 8 / np.pi**2
MODULES = np.array([1, 1, 2, 2])
"""Number of the module to which each slow variable (C_1, psi_1, C_2, psi_2) belongs."""
_ONE = np.eye(2)


def impedances(system) -> tuple[np.ndarray, complex]:
    """Return the slow impedances e_n of the boxes, shape (2,), and the slow impedance K of the coupling.

    The impedance e_n describes box n alone, without ball and coupling. With b_n = B_n exp(-i psi_n), the slow flow is
    2i D_1 b_n = f_n - (e_n + N(C_n)) b_n - K (b_n - b_m). Here m is the module other than n, N is the describing
    function of the ball, and D_1 = d / dtau_1.
    """
    detuning = np.array([0, system.sigma20_hat]) - 2 * system.sigma_e_hat
    damping = np.array([system.gamma1_hat, system.gamma2_hat])
    return detuning + 1j * damping, system.alpha12_hat + 1j * system.gamma12_hat


def rates(system, B, psi, C) -> tuple[np.ndarray, np.ndarray]:
    """Return the rates D_1 B_i and D_1 psi_i of (10.22), each of shape (2,).

    All rates vanish at a fixed point, (10.23). The amplitudes B, the phases psi [rad] and the saw-tooth amplitudes C
    have the shape (2,).
    """
    return rates_from_phasors(system, np.asarray(B), np.cos(psi), np.sin(psi), np.asarray(C))


def rates_from_phasors(system, B, cosine, sine, C):
    """Return the same values as `rates`, but take cos psi and sin psi as arguments instead of psi.

    B, cosine, sine and C have the shape (2,), with cosine = cos psi and sine = sin psi. The rates are rational
    functions of these arguments. Therefore computer algebra can evaluate this function.
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
    """Return the rates D_1 B_1, D_1 psi_1, D_1 B_2, D_1 psi_2 on the manifold, shape (4,), and their Jacobian.

    The Jacobian has the shape (4, 4). It contains the derivatives of the rates with respect to C_1, psi_1, C_2, psi_2.
    If exactly one module is active, the shapes are (2,) and (2, 2). The phases psi [rad] and the saw-tooth amplitudes C
    have the shape (2,).
    """
    psi, C = (np.where(_active(system)[::2], of, 0.0) for of in (psi, C))
    rest = np.column_stack(rates(system, B_of_C(C, rho(system.kappa)), psi, C)).ravel()
    return rest[_active(system)], linearisation(system, psi, C)[0]


def linearisation(system, psi, C) -> tuple[np.ndarray, np.ndarray]:
    """Return the matrices J and M of the linearised slow flow M dx/dtau_1 = J x, each of shape (..., 4, 4).

    x contains the perturbations of C_1, psi_1, C_2, psi_2. At the fold of the manifold, J and M are finite and M is
    singular, whereas a Jacobian with respect to B and psi would be infinite. The phases psi [rad] and the saw-tooth
    amplitudes C have the shape (..., 2). If exactly one module is active, J and M have the shape (..., 2, 2).
    """
    r = rho(system.kappa)
    psi, C = (np.where(_active(system)[::2], of, 0.0) for of in (psi, C))
    B, B_C = B_of_C(C, r), slope(C, r)
    ball = FIRST_HARMONIC * (C * (1 - C) + 1j * r * C**2) / B
    ball_C = FIRST_HARMONIC * (1 - 2 * C + 2j * r * C) / B - ball * B_C / B
    return pencil(system, psi, B, ball, B_C, ball_C)


def pencil(system, psi, B, ball, B_x, ball_x) -> tuple[np.ndarray, np.ndarray]:
    """Return the matrices J and M as in `linearisation`, for any curve instead of the manifold.

    The amplitude B_i and the product N_i B_i are functions of a parameter x_i, where N_i is the describing function of
    ball i. J and M apply to perturbations of x_1, psi_1, x_2, psi_2. The arguments are arrays of shape (..., 2):

    - psi: phases [rad],
    - B, ball: values of B_i and of N_i B_i,
    - B_x, ball_x: derivatives of B_i and of N_i B_i with respect to x_i.
    """
    e, K = impedances(system)
    forcing = np.array([system.f10_hat, system.f20_hat])
    ahead = np.exp(1j * np.asarray(psi))
    # The complex form of (10.22) is D_1 B_i = Im(drive_i) / 2 and D_1 psi_i = Re(drive_i) / (2 B_i).
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
    part = _active(system)
    return J[..., part, :][..., part], M[..., part, :][..., part]


def _active(system):
    """Return a mask of the slow variables that belong to active modules, shape (4,).

    If no module is active, all entries are True.
    """
    return np.isin(MODULES, system.modules or (1, 2))


def slow_eigenvalues(system, psi, C) -> np.ndarray:
    """Return the complex eigenvalues of the slow flow per unit of tau_1, sorted by descending real part.

    There are two eigenvalues per active module. At the fold of the manifold, one eigenvalue is infinite. The phases
    psi [rad] and the saw-tooth amplitudes C have the shape (2,).
    """
    return descending(eigvals(*linearisation(system, psi, C)))


def descending(values) -> np.ndarray:
    """Return the complex values, shape (n,), sorted by descending real part."""
    return values[np.argsort(-values.real, kind="stable")]
