"""Check the statements of section 10.3 on the manifold: its fold, the admissible C, and its stable part."""

from itertools import product

import numpy as np
from scipy.optimize import minimize_scalar

from vibroimpact.studies.claims.finding import Finding
from vibroimpact.studies.claims.point_checks import CAPTIONS
from vibroimpact.system.verdict import STABLE
from vibroimpact.theory.manifold import B_min, B_of_C, C_min, impact_phase, largest_C, rho, sawtooth
from vibroimpact.theory.masri import impact_multipliers, lower_limit, printed_limit, upper_limit

KAPPAS = np.linspace(0.01, 0.99, 99)
EXPONENTS = range(4)
"""Exponents tried for pi and for rho in (10.26), in case a misprint has changed the printed ones."""
TOLERANCE = 1e-9


def fold_of_the_manifold(evidence):
    """Check the fold of the manifold, (10.25), against a numerical minimisation of B in (10.16)."""
    place, level = 0.0, 0.0
    for kappa in KAPPAS:
        r = rho(kappa)
        found = minimize_scalar(lambda C, r=r: B_of_C(C, r) ** 2, bracket=(0.0, 0.8, 2.0), tol=1e-10)
        place = max(place, abs(found.x - C_min(r)))
        level = max(level, abs(np.sqrt(found.fun) - B_min(r)))
    # The position of a numerical minimum is accurate only to the square root of rounding errors.
    numbers = {"largest error of C_min": place, "largest error of B_min": level}
    return Finding({"the minimum is at C_min": place < 1e-6, "the minimum is B_min": level < 1e-12}, numbers)


def no_penetration(evidence):
    """Check that the ball leaves the box for C < 0, and stays inside for C >= 0 and at the fixed points.

    The ball is inside if |W_0| <= 1 during the whole cycle. W_0 is the relative displacement at leading order.
    """
    kappa = evidence.system.kappa
    points = evidence.fixed_points[["C1", "C2"]].to_numpy()
    end = largest_C(kappa)
    parts = {
        "the ball leaves the box if C < 0": all(_furthest(C, kappa) > 1 for C in (-1.0, -0.1, -0.01)),
        "the ball is inside at all fixed points": all(_furthest(C, kappa) <= 1 + TOLERANCE for C in points.ravel()),
        "the ball is inside if C >= 0": all(_furthest(C, kappa) <= 1 + TOLERANCE for C in np.linspace(0, 3 * end, 100)),
    }
    numbers = {"largest C with the ball inside": end, "largest C of a fixed point": points.max()}
    return Finding(parts, numbers | {"max |W| at twice the largest C with the ball inside": _furthest(2 * end, kappa)})


def _furthest(C, kappa):
    t = np.linspace(0, 2 * np.pi, 20001)
    r = rho(kappa)
    return np.abs(B_of_C(C, r) * np.sin(t + impact_phase(C, r)) + sawtooth(t, C, 0.0)).max()


def printed_condition(evidence):
    """Check (10.26), the lower limit of C for stable impacts, against the multipliers of the impact map.

    The limit is called a misprint if 4 / (4 + pi^p rho^q) is a correct limit for other exponents p and q.
    """
    kappa = evidence.system.kappa
    limit, squared = printed_limit(rho(kappa)), 4 / (4 + (np.pi * rho(kappa)) ** 2)
    at_limit, at_squared = (_largest_multiplier(C, kappa) for C in (limit, squared))
    stable, below = _stable_above(limit, kappa), _stable(np.linspace(0.0, limit, 200)[1:], kappa)
    parts = {
        "the largest multiplier at the limit is on the unit circle": abs(at_limit - 1) < TOLERANCE,
        "all motions above the limit are stable": stable.all(),
    }
    exponents = np.array(list(product(EXPONENTS, repeat=2)))
    readings = 4 / (4 + np.pi ** exponents[:, 0] * rho(kappa) ** exponents[:, 1])
    at_readings = np.array([_largest_multiplier(C, kappa) for C in readings])
    right = (np.abs(at_readings - 1) < TOLERANCE) & [_stable_above(C, kappa).all() for C in readings]
    least, most = _limits_of_the_captions(evidence)
    fitting = (least < readings) & (readings < most)
    numbers = {
        "largest multiplier at the printed limit": at_limit,
        "printed limit (10.26)": limit,
        "limit with squares, 4 / (4 + pi^2 rho^2)": squared,
        "largest multiplier at the limit with squares": at_squared,
        "derived lower limit": lower_limit(kappa),
        "derived upper limit": upper_limit(kappa),
        "stable share of C above the printed limit": stable.mean(),
        "stable share of C below the printed limit": below.mean(),
        "number of pairs of exponents of pi and rho tried": len(readings),
        "number of pairs of exponents that make the claim hold": int(right.sum()),
        "multiplier nearest to 1 at the limits of all pairs": at_readings[np.abs(at_readings - 1).argmin()],
        "lower bound of limits that fit the captions": least,
        "upper bound of limits that fit captions and left arm": most,
        "exponents of pi and rho that fit captions and left arm": exponents[fitting],
        "limits with exponents that fit captions and left arm": readings[fitting],
        "largest multipliers at limits that fit captions and left arm": at_readings[fitting],
    }
    return Finding(parts, numbers, corrected=bool(right.any()))


def _limits_of_the_captions(evidence):
    """Return both ends of an open interval; it contains the lower limits of C that agree with all CAPTIONS.

    Each of these limits could replace (10.26). By a limit, a fixed point is stable if both C_1 and C_2 exceed the
    limit. A limit agrees with the captions if the same fixed points are stable by the limit and by the captions. The
    interval ends at the fold of the manifold or below it, since a part of the left arm must be stable.

    If the labels of fixed points were exchanged, the interval would stay the same or become empty. The reason is that
    by every limit, the stable fixed points are those with the largest min(C_1, C_2).
    """
    smallest = {True: [], False: []}
    for case, captions in CAPTIONS.items():
        of_points = evidence.points(case)[["C1", "C2"]].min(axis=1)
        for label in captions.keys() & of_points.index:
            smallest[captions[label] == STABLE].append(of_points[label])
    return max(smallest[False]), min(*smallest[True], lower_limit(evidence.system.kappa))


def _largest_multiplier(C, kappa):
    return np.abs(impact_multipliers(C, kappa)).max()


def _stable(C, kappa):
    """Return an array of shape (n,) that is True where the impact map is stable.

    C, kappa: arrays of shape (n,), or numbers.
    """
    return np.array([_largest_multiplier(*one) < 1 for one in np.broadcast(C, kappa)])


def _stable_above(limit, kappa):
    """Return an array that is True where the impact map is stable.

    The array has an entry for each of 499 values of C between `limit` and the largest admissible C.
    """
    return _stable(np.linspace(limit, largest_C(kappa), 500)[1:], kappa)


def two_branches(evidence):
    """Check that the manifold has one stable and one unstable piece."""
    kappa = evidence.system.kappa
    stable = _stable(np.linspace(0.0, largest_C(kappa), 4001)[1:], kappa)
    first = np.append(True, stable[1:] != stable[:-1])  # True at the first point of each piece
    counts = {name: int((first & (stable == says)).sum()) for name, says in (("unstable", False), ("stable", True))}
    parts = {f"there is one {name} branch": count == 1 for name, count in counts.items()}
    return Finding(parts, {f"number of {name} pieces": count for name, count in counts.items()})


def right_arm_is_stable(evidence):
    """Check that the right arm is stable from the fold to the largest admissible C."""
    kappa = evidence.system.kappa
    fold, end = lower_limit(kappa), largest_C(kappa)
    C = np.linspace(fold, end, 2002)[1:-1]
    stable = _stable(C, kappa)
    parts = {"motions just right of the fold are stable": stable[0], "the whole right arm is stable": stable.all()}
    return Finding(parts, {"largest stable C": C[stable].max(), "stable share of the right arm": stable.mean()})


def left_arm_has_a_stable_piece(evidence):
    """Check whether the left arm has stable motions, in particular between the limit (10.26) and the fold."""
    kappa = evidence.system.kappa
    limit, fold = printed_limit(rho(kappa)), lower_limit(kappa)
    piece = _stable(np.linspace(limit, fold, 502)[1:-1], kappa)
    arm = _stable(np.linspace(0, fold, 2002)[1:-1], kappa)
    numbers = {"stable share from (10.26) to the fold": piece.mean(), "limit (10.26)": limit, "C of the fold": fold}
    return Finding({"a piece of the left arm is stable": piece.any() or arm.any()}, numbers)


def stability_regions(evidence):
    """Check the shaded (stable) and the white (unstable) region of Fig. 10.5 against the impact map.

    Every point of a grid of C and kappa must have the stability that the figure shows. The border between the regions,
    (10.26), must be below C_min for every kappa.
    """
    kappa, C = (values.ravel() for values in np.meshgrid(KAPPAS, np.linspace(0.5, 1.1, 61)))
    border, stable = printed_limit(rho(kappa)), _stable(C, kappa)
    shaded, white = stable[border < C].mean(), (~stable[border > C]).mean()
    gap = lower_limit(KAPPAS) - printed_limit(rho(KAPPAS))
    parts = {"the shaded region is stable": shaded == 1, "the white region is unstable": white == 1}
    parts |= {"the boundary is below C_min for every kappa": (gap > 0).all()}
    numbers = {"stable share of the shaded region": shaded, "unstable share of the white region": white}
    return Finding(parts, numbers | {"smallest gap below C_min": gap.min(), "largest gap below C_min": gap.max()})
