"""Check the printed equations of sections 10.2 and 10.3 at random states and on simulations."""

from itertools import product

import numpy as np
from scipy.integrate import quad

from vibroimpact.studies.claims.finding import Finding, as_printed
from vibroimpact.system.matrices import rate_matrix
from vibroimpact.system.restitution import after_impact
from vibroimpact.theory.manifold import B_min, B_of_C, C_min, C_of_B, impact_phase, rho, sawtooth

ROUNDING = 1e-12
KAPPAS = (0.05, 0.3, 0.65, 0.95)
_TERMS = {"one term": "distance", "two terms": "two terms"}
"""Terms of (10.7) that are added -> panel in `Evidence.epsilon_orders` for the distance of the sum from the orbit."""


def small_balls(evidence):
    """Check the printed condition M << m and its correction m / M << 1, for the masses M of a box and m of a ball."""
    epsilon = evidence.system.epsilon
    return as_printed(1 / epsilon < 1, epsilon < 1, **{"M / m": 1 / epsilon, "m / M": epsilon})


def weak_coupling(evidence):
    """Check that the coupling is weaker than the connection of each box to ground.

    The coupling spring must be softer than both springs to ground. The coupling damper must be weaker than both
    dampers to ground.
    """
    system = evidence.system
    spring = system.alpha12 / min(1.0, system.stiffness2)
    damper = system.gamma12 / min(system.gamma1, system.gamma2)
    parts = {"the coupling spring is the softest": spring < 1, "the coupling damper is the weakest": damper < 1}
    return Finding(parts, {"relative coupling damping": damper, "relative coupling stiffness": spring})


def own_frequency(evidence):
    """Check the frequency of the first force in (10.1) against (10.5).

    (10.1) prints omega_10, the natural frequency of box 1, whose dimensionless value is 1. By (10.5), the dimensionless
    frequency of the force is 1 + epsilon sigma_e_hat.
    """
    system = evidence.system
    corrected = abs(system.Omega - (1 + system.epsilon * system.sigma_e_hat)) < ROUNDING
    return as_printed(system.Omega == 1, corrected, **{"forcing frequency / natural frequency of box 1": system.Omega})


def bound_of_the_balls(evidence):
    """Check -L <= y_i <= L in all simulated motions, and the same bound on the relative displacements x_i - y_i."""
    samples = [simulation.samples for simulation in evidence.simulations.values()]
    absolute = max(table[["Y1", "Y2"]].abs().to_numpy().max() for table in samples)
    relative = max((table[f"X{i}"] - table[f"Y{i}"]).abs().max() for table in samples for i in (1, 2))
    return as_printed(absolute <= 1, relative <= 1 + ROUNDING, **{"largest |Y|": absolute, "largest |W|": relative})


def common_impact_instants(evidence):
    """Check whether both modules in (10.2) share one sequence tau_j of impact times, or have one sequence each."""
    own, other = [], []
    for simulation in evidence.simulations.values():
        impacts = simulation.impacts
        from_wall = np.column_stack([1 - (impacts[f"X{i}"] - impacts[f"Y{i}"]).abs() for i in (1, 2)])
        place = impacts["module"].to_numpy() - 1
        rows = np.arange(len(place))
        own.append(from_wall[rows, place])
        other.append(from_wall[rows, 1 - place])
    own, together = np.abs(np.concatenate(own)).max(), (np.abs(np.concatenate(other)) < ROUNDING).mean()
    numbers = {"share of impacts in both modules at once": together, "largest distance of an impact from its wall": own}
    return as_printed(together == 1, own < ROUNDING, **numbers)


def equations_in_U_and_W(evidence):
    """Check the lines of (10.3) at a random state, and the jumps in (10.3) at random impacts.

    The line for W_1 is printed with the force on box 2. The corrected line has the force on box 1.
    """
    system = evidence.system.with_(f10_hat=1.0, f20_hat=0.89)
    rng = np.random.default_rng(1)
    f, tau = system.forcing, 0.7
    X, Y, dX, dY = rng.uniform(-1, 1, (4, 2))
    phase = [np.sin(system.Omega * tau), np.cos(system.Omega * tau)]
    ddX = (rate_matrix(system) @ [*X, *dX, *phase])[2:4]
    eps = system.epsilon
    U, dU, W, dW = X + eps * Y, dX + eps * dY, X - Y, dX - dY
    place, speed = (U + eps * W) / (1 + eps), (dU + eps * dW) / (1 + eps)
    stiffness, damping = np.array([1, system.stiffness2]), np.array([system.gamma1, system.gamma2])
    left = damping * speed + stiffness * place + system.gamma12 * (speed - speed[::-1])
    left += system.alpha12 * (place - place[::-1])
    printed = {"U1": f[0], "W1": f[1], "U2": f[1], "W2": f[1]}  # amplitude of the force in each line as printed
    # Between impacts Y'' = 0, since the ball flies freely. Therefore U'' = W'' = X''.
    both = dict(zip("12", ddX + left, strict=True))
    residual = {line: both[line[1]] - amplitude * phase[0] for line, amplitude in printed.items()}
    parts = {f"line {line} holds as printed": abs(value) < ROUNDING for line, value in residual.items()}
    with_f10 = both["1"] - f[0] * phase[0]
    jump_of_U, jump_of_W = _errors_of_jumps(system)
    parts |= {"U' does not jump": jump_of_U < ROUNDING, "W' jumps by -(1 + kappa) W'": jump_of_W < ROUNDING}
    others = all(holds for part, holds in parts.items() if not part.startswith("line W1"))
    numbers = {"residual of line W1 as printed": residual["W1"], "residual of line W1 with the force f10": with_f10}
    numbers |= {"largest error of the printed jumps": max(jump_of_U, jump_of_W)}
    return Finding(parts, numbers, corrected=bool(others and abs(with_f10) < ROUNDING))


def _errors_of_jumps(system):
    """Return the largest errors of the printed jumps of U' and W' at random impacts.

    As printed, U' does not jump, and W' jumps by -(1 + kappa) W'.
    """
    box, ball = np.random.default_rng(2).uniform(-1, 1, (2, 100))
    X, Y = after_impact(system.epsilon, system.kappa, box, ball)
    U = np.abs(X + system.epsilon * Y - box - system.epsilon * ball).max()
    W = np.abs(X - Y + system.kappa * (box - ball)).max()
    return U, W


def leading_order_solution(evidence):
    """Check that the leading-order solution, (10.9)-(10.11) with (10.16) and (10.17), solves (10.8).

    The Fourier coefficients in (10.19) are checked by quadrature.
    """
    t, found = np.linspace(0.1, np.pi - 0.1, 50), []
    for kappa, C in product(KAPPAS, (0.3, 0.9, 1.1, 1.6)):
        B, phase, slope = B_of_C(C, rho(kappa)), impact_phase(C, rho(kappa)), 2 * C / np.pi
        Z = sawtooth(np.array([t - 0.05, t, t + 0.05]), C, 0.0)
        at_walls = [B * np.sin(j * np.pi + phase) + sawtooth(j * np.pi, C, 0.0) - (-1) ** j for j in (0, 1)]
        impact = 2 * slope - (1 + kappa) * (B * np.cos(phase) + slope)
        found.append({"flight equation": Z[0] - 2 * Z[1] + Z[2], "wall condition": at_walls, "impact law": impact})
    return _vanish(found, **{"formula of the harmonics": _error_of_the_harmonics()})


def _vanish(found, **others):
    """Return a Finding with one part for each relation; the part is True if all residuals of the relation vanish.

    A residual counts as zero if its absolute value is below ROUNDING.

    found: list of dictionaries {name of the relation: residuals}, all with the same names.
    others: for each further relation, its largest residual.
    """
    worst = {name: max(np.abs(residuals[name]).max() for residuals in found) for name in found[0]} | others
    parts = {f"{name} holds": value < ROUNDING for name, value in worst.items()}
    return Finding(parts, {f"largest residual of {name}": value for name, value in worst.items()})


def manifold_from_impact_conditions(evidence):
    """Check (10.15), (10.16) and (10.17) against (10.12) and (10.14) at random values of C."""
    found = []
    for kappa in KAPPAS:
        r = rho(kappa)
        for C in np.random.default_rng(3).uniform(0.05, 2.5, 50):
            sine = 1 - C  # equals B sin(phase), by (10.12)
            cosine = 4 * C / (np.pi * (1 + kappa)) - 2 * C / np.pi  # equals B cos(phase), by (10.14)
            B = np.hypot(sine, cosine)
            residuals = {"(10.16)": B**2 - (1 - 2 * C + (1 + r**2) * C**2)}
            # Close to the fold, the square root in (10.15) loses half of the digits. Therefore the residual is
            # multiplied by the distance of C from the fold, if this distance is below 1.
            residuals["(10.15)"] = min(abs(arm - C) for arm in C_of_B(B, r)) * min(1, abs(C - C_min(r)))
            residuals["(10.17)"] = [sine - B * np.sin(impact_phase(C, r)), cosine - r * C]
            found.append(residuals)
    lowest = max(abs(B_of_C(C_min(rho(kappa)), rho(kappa)) - B_min(rho(kappa))) for kappa in KAPPAS)
    return _vanish(found, **{"(10.25) for B_min": lowest})


def _error_of_the_harmonics():
    """Return the largest difference of the coefficients n = 1, ..., 7 in (10.19) from their values by quadrature."""
    off = 0.0
    for n in range(1, 8):
        found = 2 / np.pi * quad(lambda t, n=n: float(sawtooth(t, 1.0, 0.0)) * np.cos(n * t), 0, np.pi)[0]
        off = max(off, abs(found - (8 / (np.pi * n) ** 2 if n % 2 else 0.0)))
    return off


def orders_of_the_expansion(evidence):
    """Check the expansion (10.7): its error must be O(epsilon) with one term and O(epsilon^2) with two terms.

    The first term is the fixed point. The second term is epsilon times the derivative of the exact orbit with respect
    to epsilon at epsilon = 0.
    """
    table = evidence.epsilon_orders
    orders = {name: table.loc[table["panel"] == panel, "order"] for name, panel in _TERMS.items()}
    off = {f"order {n} in epsilon with {name}": (orders[name] - n).abs() for n, name in enumerate(_TERMS, start=1)}
    parts = {f"the error is of {order}": (errors < 0.01).all() for order, errors in off.items()}
    numbers = {f"largest deviation from {order}": errors.max() for order, errors in off.items()}
    return Finding(parts, numbers | {"number of fixed points compared": len(orders["one term"])})
