"""Two sectors of the cyclic chain of Weidemann, Bergman, Vakakis and Krack as a System, and its exact responses.

T. Weidemann, L. A. Bergman, A. F. Vakakis, M. Krack (2025), Nonlinear Dynamics, doi 10.1007/s11071-025-10928-4. Their
sector weighs 1 with its absorber, which weighs epsilon_a; its spring to ground is 1, so their frequency r is 1 where
the absorber is fixed. Here the box alone weighs 1, hence

    epsilon = epsilon_a / (1 - epsilon_a),      tau = t / sqrt(1 - epsilon_a),      Omega = r sqrt(1 - epsilon_a).

Each of both modes has the damping ratio D, with their eigenfrequencies 1 and sqrt(1 + 4 kappa_c); the clearance is
Gamma times the amplitude at resonance, 1 / (2 D) for a force of 1.

Their program has two couplings for two sectors: the stiffness matrix has kappa_c between them, the modes of the time
stepping 2 kappa_c. `coupling` chooses; responses in phase are the same, their stability nearly.
"""

import math
from dataclasses import asdict

from vibroimpact.exact.orbits.search import orbits
from vibroimpact.system import System

MATRIX, MODES = 1, 2
"""Coupling of their stiffness matrix, and of their modes, over kappa_c."""
STABLE_AT = 0.983
"""A frequency at which the upper response is stable."""
OF_THE_PROGRAM = (
    (0.98, 1.295545, False, 1.109518, -0.0223438),
    (0.98, 1.392096, True, 1.378723, -1.45826e-05),
    (0.985, 1.360884, False, 1.172214, 0.397354),
    (0.985, 1.533725, True, 1.520319, -6.59591e-07),
    (0.9875, 1.417973, False, 1.157546, -0.25637),
    (0.9875, 1.631437, True, 1.619762, 1.59176e-12),
    (0.9885, 1.448259, False, 1.199536, -0.0322313),
    (0.9885, 1.678322, True, 1.644944, 0.107374),
    (0.99, 1.505541, False, 1.173281, 0.0883085),
    (0.99, 1.759425, True, 1.653377, 0.20818),
    (0.992, 1.617034, False, 1.174543, 0.0655739),
    (0.992, 1.891745, True, 1.665244, 0.289937),
)
"""Responses of two sectors, a case of ours, by their program at commit c4c8a3a: r, theta of harmonic balance, its
verdict stable, and from its time stepping there theta and the difference of the ball's speeds to either side over their
sum."""


def two_sectors(
    r: float,
    kappa_c: float = 0.01,
    epsilon_a: float = 0.02,
    D: float = 1e-3,
    restitution: float = 0.8,
    Gamma: float = 0.3,
    coupling: int = MODES,
) -> System:
    """Return the System of two sectors that are forced alike at the frequency r; all arguments dimensionless.

    Raises
    ------
    ValueError
        As System.
    """
    epsilon, unit = epsilon_a / (1 - epsilon_a), math.sqrt(1 - epsilon_a)
    damping = 2 * D / unit / epsilon
    return System(
        epsilon=epsilon,
        kappa=restitution,
        alpha12_hat=coupling * kappa_c / epsilon,
        gamma1_hat=damping,
        gamma2_hat=damping,
        gamma12_hat=damping * (math.sqrt(1 + 4 * kappa_c) - 1) / 2,
        sigma20_hat=0.0,
        sigma_e_hat=(r * unit - 1) / epsilon,
        f10_hat=2 * D / Gamma / epsilon,
        f20_hat=2 * D / Gamma / epsilon,
    )


def responses(r: float, coupling: int = MODES) -> list[dict]:
    """Return a row per exact response with one impact at each wall per period: amplitudes, lean, multiplier, state.

    theta1, theta2: amplitudes of the absorbers' triangles over the clearance. lean: difference of the speeds of the
    first absorber to either side over their sum. proved: interval arithmetic proves the orbit and its stability; of a
    symmetric one, in phase, it proves the same of one sector (`_alone`). enclosures: moduli of the multipliers that the
    proof encloses, largest first. state (8,) at tau = 0 and the parameters of the system are all that it takes to check
    a row.
    """
    system = two_sectors(r, coupling=coupling)
    rows = []
    for orbit in (found for found in orbits(system) if found.admissible):
        theta, (speeds, _) = orbit.C / (1 + system.epsilon), orbit.ball_speeds
        proved = (_alone(orbit, r) if orbit.symmetric else orbit).with_proof()
        rows.append({
            "r": r,
            "coupling": coupling,
            "symmetric": orbit.symmetric,
            "theta1": float(theta[0]),
            "theta2": float(theta[1]),
            "lean": float((speeds[1] - speeds[0]) / speeds.sum()),
            "multiplier": float(abs(orbit.multipliers).max()),
            "stable": orbit.stable,
            "proved": proved.proved,
            "enclosures": [str(abs(multiplier)) for multiplier in proved.proof.multipliers],
            "state": orbit.state.tolist(),
            "system": asdict(system),
        })  # fmt: skip
    return rows


def _alone(orbit, r):
    """Return the same motion of sector 1 without coupling, beside a sector 2 that is tuned to a stable response.

    No coupling acts on a motion in phase, so that both sectors move like one alone. In phase, all impacts of both come
    at once, which the proof leaves out; here they do not. Multipliers outside the unit circle are those of sector 1.
    """
    tuned = ((r / STABLE_AT) ** 2 - 1) / orbit.system.epsilon
    uncoupled = orbit.system.with_(alpha12_hat=0.0, gamma12_hat=0.0, sigma20_hat=tuned)
    found = [one for one in orbits(uncoupled) if one.symmetric and abs(one.C[0] - orbit.C[0]) < 1e-9]
    return max(found, key=lambda one: one.C[1])
