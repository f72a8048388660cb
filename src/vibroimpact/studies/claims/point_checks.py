"""Check claims of section 10.4 about fixed points: number, position, stability, dependence on forces, singularity."""

from itertools import permutations

import numpy as np
from scipy.optimize import brentq

from vibroimpact.studies.claims.finding import Finding
from vibroimpact.system.verdict import STABLE, UNSTABLE
from vibroimpact.theory.fixed_points.balance import Balance, determinant, singular_points
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points
from vibroimpact.theory.manifold import B_of_C, C_min, rho
from vibroimpact.theory.slow_flow import rates

NAMES = ["C1", "C2"]
CAPTIONS = {
    "equal": {"a": UNSTABLE, "b": STABLE, "c": STABLE},
    "unequal": {"a": UNSTABLE, "b": UNSTABLE, "c": STABLE},
    "weak": {"a": UNSTABLE},
}
"""Stability of each fixed point according to the captions of Figs. 10.6, 10.9 and 10.10."""
CONTINUATION_VALUES = 111
"""Number of values of the second forcing amplitude at which a fixed point is followed from case to case."""


def number_of_fixed_points(evidence, case, number):
    """Check the number of fixed points; interval arithmetic must prove that the list of fixed points is complete."""
    proof = evidence.proofs[case]["fixed_points"]
    listed = len(evidence.points(case))
    parts = {f"the number of fixed points with C1, C2 >= 0 is {number}": listed == number and proof["complete"]}
    numbers = {"number of fixed points found": listed, "fixed points proved, C1, C2 of either sign": proof["proved"]}
    return Finding(parts, numbers | {"list proved complete": proof["complete"]})


def phases_can_be_eliminated(evidence):
    """Check that equations in B_i and C_i alone, without the phases, lead to all fixed points.

    The solutions of these equations must satisfy (10.23). The list of solutions must be proved complete.
    """
    worst, complete = 0.0, True
    for case, system in evidence.systems.items():
        complete &= evidence.proofs[case]["fixed_points"]["complete"]
        for point in fixed_points(system):
            worst = max(worst, np.abs(rates(system, point.B, point.psi, point.C)).max())
    parts = {"all solutions satisfy (10.23)": worst < 1e-12, "it is proved that no solution is missing": complete}
    return Finding(parts, {"largest residual of (10.23) at a solution": worst})


def label_of_a_point(evidence, case, label, says):
    """Check what a caption says about the stability of a fixed point.

    The verdict `says` must agree with the theory and with the exact orbit of the fixed point.
    """
    row = evidence.points(case).loc[label]
    orbits = evidence.orbits.query("case == @case").set_index("label")
    verdicts = {"both time scales": row["theory"], "its exact orbit": row["exact"]}
    parts = {
        f"the point is {says} by {name}": found == says if found in (STABLE, UNSTABLE) else None
        for name, found in verdicts.items()
    }
    others = {"(10.26)": row["printed_10_26"], "the fast criterion": row["fast"], "the slow flow": row["slow"]}
    numbers = {"largest multiplier of its orbit": orbits["modulus_1"].get(row["orbit"]), "C1, C2": row[NAMES].tolist()}
    return Finding(parts, numbers | {f"verdict by {name}": found for name, found in (others | verdicts).items()})


def stable_points(evidence, case, number):
    """Count the stable fixed points of a case by each criterion of the theory, and by their exact orbits.

    The chapter uses the fast criterion: the impacts must be stable at constant B and phase. Here the fast criterion
    uses the condition that this project derives. Fixed points that are stable by the printed condition, (10.26), are
    counted separately.
    """
    points = evidence.points(case)
    counts = {
        "points stable by their exact orbits": int((points["exact"] == STABLE).sum()),
        "points stable by the derived fast criterion": int((points["fast"] == STABLE).sum()),
        "points stable by (10.26)": int((points["printed_10_26"] == STABLE).sum()),
        "points stable by both time scales": int((points["theory"] == STABLE).sum()),
    }
    right = {
        name: sum(evidence.points(name)["fast"].get(label) == caption for label, caption in captions.items())
        for name, captions in CAPTIONS.items()
    }
    parts = {f"the number of {name} is {number}": count == number for name, count in counts.items()}
    parts["the fast criterion gives all captions of the case"] = right[case] == len(CAPTIONS[case])
    numbers = {"captions of all cases that the fast criterion gives": sum(right.values())}
    return Finding(parts, counts | numbers | {"number of captions of all cases": sum(map(len, CAPTIONS.values()))})


def on_the_left_arm(evidence, case, label, modules):
    """Check that C_i of a fixed point is left of the fold of the manifold, for each module i in `modules`."""
    row, fold = evidence.points(case).loc[label], C_min(rho(evidence.systems[case].kappa))
    parts = {f"P{i} is left of the fold": row[f"C{i}"] < fold for i in modules}
    return Finding(parts, {"C1 and C2 of the point": row[NAMES].tolist(), "C_min at the fold": fold})


def points_move_left(evidence, before, after):
    """Check that each C_i of each fixed point is smaller in the case `after` than in the case `before`.

    Fixed points with the same label are compared.
    """
    first, last = (evidence.points(case)[NAMES] for case in (before, after))
    parts = {f"P{i} of {x} moves left": last.at[x, f"C{i}"] < first.at[x, f"C{i}"] for x in first.index for i in (1, 2)}
    pairings = [int((last.loc[list(order)].to_numpy() < first.to_numpy()).sum()) for order in permutations(last.index)]
    moved = {"projections that move left": sum(parts.values()), "number of projections": len(parts)}
    return Finding(parts, moved | {"largest number that moves left in any pairing of points": max(pairings)})


def stable_point_moves_down_the_right_arm(evidence, before, after, label):
    """Check that the stable fixed point moves down the right arm from the case `before` to the case `after`.

    Two fixed points of the case `after` are checked. One has the same letter in the captions. The other one is found by
    continuation as f20_hat changes.
    """
    fold, r = C_min(rho(evidence.system.kappa)), rho(evidence.system.kappa)
    first, named = (evidence.points(case).loc[label, NAMES].to_numpy(float) for case in (before, after))
    ends = {"the point with the same letter": named, "its continuation": _followed(evidence, before, after, first)}
    parts = {
        f"P{i + 1} moves down the right arm to {end}": fold < C[i] < first[i] and B_of_C(C, r)[i] < B_of_C(first, r)[i]
        for end, C in ends.items()
        for i in (0, 1)
    }
    moved = {f"C1 and C2 of {end}": C for end, C in ends.items()}
    return Finding(parts, {"C1 and C2 of the point before the move": first} | moved | {"C_min at the fold": fold})


def _followed(evidence, before, after, C):
    """Follow a fixed point from the case `before` to the case `after`; return its C in the case `after`.

    C: amplitudes of the fixed point in the case `before`. The force f20_hat changes in small steps.
    """
    start, end = evidence.systems[before], evidence.systems[after]
    for f20 in np.linspace(start.f20_hat, end.f20_hat, CONTINUATION_VALUES)[1:]:
        points = np.array([point.C for point in fixed_points(end.with_(f20_hat=f20))])
        C = points[np.linalg.norm(points - C, axis=1).argmin()]
    return C


def singular_and_bifurcating(evidence, case, f20_range):
    """Check whether fixed points bifurcate where a fixed point coincides with a singular point.

    At a singular point, the determinant of (10.24) is 0. The force f20_hat at which both points coincide is compared
    with the force at which two fixed points merge.
    """
    system = evidence.systems[case]

    def on_branch(f20):
        """Return the determinant of (10.24) for the force f20, at the fixed point with the second largest C_2."""
        there = system.with_(f20_hat=f20)
        return determinant(there, sorted(fixed_points(there), key=lambda point: point.C[1])[-2].C)

    meeting = brentq(on_branch, *f20_range, xtol=1e-12)
    here = system.with_(f20_hat=meeting)
    point = min(fixed_points(here), key=lambda p: _nearest_singular(here, p))
    counts = [len(fixed_points(system.with_(f20_hat=meeting + shift))) for shift in (-1e-3, 0.0, 1e-3)]
    rate = np.abs(point.slow_eigenvalues).min()
    special = evidence.special_points.set_index(["path", "family", "kind"])
    fold = special.loc[[("f20_hat", "fixed point", "fold")]].iloc[0]
    at_fold = system.with_(f20_hat=fold["p"] + 1e-6)
    merging = min(fixed_points(at_fold), key=lambda p: np.abs(p.C - fold[NAMES].to_numpy(float)).max())
    distance = _nearest_singular(at_fold, merging)
    parts = {
        "a fixed point becomes singular where P1 = S1": _nearest_singular(here, point) < 1e-6,
        "the number of fixed points changes where P1 = S1": len(set(counts)) > 1,
        "an eigenvalue of the slow flow vanishes where P1 = S1": rate < 1e-3,
        "a fixed point is singular where two fixed points merge": distance < 1e-2,
    }
    numbers = {"f20 where P1 = S1": meeting, "number of fixed points where P1 = S1": counts[1]}
    numbers |= {"smallest |eigenvalue| where P1 = S1": rate, "f20 where two fixed points merge": fold["p"]}
    return Finding(parts, numbers | {"distance from S where two fixed points merge": distance})


def _nearest_singular(system, point):
    """Return the distance of a fixed point from the nearest singular point.

    The distance from a singular point S_1 is measured in C_1, the distance from a singular point S_2 in C_2.
    """
    gaps = [np.abs(singular_points(system, point, i)[:, 0] - point.C[i - 1]) for i in (1, 2)]
    return np.concatenate(gaps).min(initial=np.inf)


def places_of_singular_points(evidence, case, label):
    """Compare the singular points S_1 that result from two ways of eliminating the phases from (10.23).

    The chapter does not print the functions h_1 and h_2 of (10.24). Therefore each of the two ways may be the one that
    the chapter used.
    """
    system = evidence.systems[case]
    point = next(point for point in fixed_points(system) if point.label == label)
    first = singular_points(system, point, 1)[:, 0]
    C = np.linspace(0.0, 3.0, 3001)
    other = np.array([_other_determinant(system, [c, point.C[1]]) for c in C])
    second = C[:-1][np.diff(np.sign(other)) != 0]
    same = len(first) == len(second) and np.allclose(first, second, atol=2e-3)
    numbers = {"C1 of S1 from sin^2 + cos^2 = 1": first, "C1 of S1 from the product of both equations": second}
    return Finding({"the squares are where (10.24) is singular": True if same else None}, numbers)


def _other_determinant(system, C):
    """Return the determinant that results from the second way of eliminating the phases.

    It is (|K|^4 - |a_1 a_2|^2) |z_1 z_2|^2, in the symbols of docs/derivation.md, section 8. The factor
    |z_1 z_2|^2 keeps the determinant finite.
    """
    balance = Balance.of(system)
    z, q = balance.at(C)
    p = q + balance.K * z
    B = B_of_C(np.asarray(C), rho(system.kappa))
    return abs(balance.K) ** 4 * np.prod(B**2) - abs(np.prod(p)) ** 2
