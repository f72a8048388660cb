"""Checks of sections 10.4 and 10.5 on motions: simulated responses, modulation, and what the theory is worth."""

import numpy as np

from vibroimpact.checks.claims_finding import Finding
from vibroimpact.regimes.classification import IDLE, STRONGLY_MODULATED
from vibroimpact.regimes.epsilon_limit import compare
from vibroimpact.system.verdict import STABLE
from vibroimpact.theory.fixed_points import fixed_points

CHECKS = (
    "steady_two_impacts",
    "numerical_results_are_similar",
    "transients_are_long",
    "only_possible_behaviour",
    "no_practical_importance",
    "resonant_intervals",
    "beating",
    "lower_amplitudes_end_stable_responses",
    "periodic_solutions",
    "assesses_stability",
    "restitution_far_from_unity",
)
SIMILAR = 0.1
"""Largest relative difference of amplitudes that are called similar here: what a figure of the chapter shows."""
LARGE = 0.5 / np.sqrt(2)
"""Standard deviation over mean of the amplitudes 1 + d cos of a beat of depth d = 1/2, largest 3 times smallest."""
PER_CYCLE = 2


def steady_two_impacts(evidence, case):
    """The simulated window repeats every cycle, and each ball meets each wall once in it."""
    simulation = evidence.simulations[case]
    cycles = simulation.summary["settings"]["window_cycles"]
    change = simulation.summary["largest_change_after_cycles"]["1"]
    counts = [simulation.summary["events"]["impact"][str(module)] for module in (1, 2)]
    impacts = _impacts(simulation)
    alternate = all((np.diff(impacts.loc[impacts["module"] == i, "wall"]) != 0).all() for i in (1, 2))
    parts = {
        "repeats every cycle": change < 1e-6,
        # One may lie on the edge of the window.
        "two impacts per cycle": all(abs(count - PER_CYCLE * cycles) <= 1 for count in counts) and alternate,
    }
    return Finding(parts, {"change after a cycle": change, "impacts": counts, "cycles": cycles})


def _impacts(simulation):
    return simulation.events[simulation.events["kind"] == "impact"]


def numerical_results_are_similar(evidence, case, label):
    """A simulated response against the predicted one: amplitudes C, and the symmetry that the prediction has."""
    row, system = evidence.points(case).loc[label], evidence.systems[case]
    impacts = _impacts(evidence.simulations[case])
    predicted, measured, lean = row[["C1", "C2"]].to_numpy(float), [], []
    for module in (1, 2):
        mine = impacts[impacts["module"] == module]
        ball, times = mine[f"Y{module}"].to_numpy(), mine["tau"].to_numpy()
        flights = np.diff(times)[:2]  # one from each wall
        speeds = np.abs(np.diff(ball)[:2] / flights)
        measured.append(speeds.mean() * system.period / 4)
        lean.append(abs(flights[0] - flights[1]) / flights.sum())
    off = np.abs(np.array(measured) / predicted - 1)
    parts = {
        "amplitudes within a tenth": (off < SIMILAR).all(),
        "symmetric as predicted": max(lean) < 1e-6,
    }
    numbers = {"C predicted": predicted.tolist(), "C simulated": measured, "relative difference": off.tolist()}
    return Finding(parts, numbers | {"difference of flight times": lean})


def transients_are_long(evidence, case):
    """Cycles in which the slowest perturbation of the attracting orbit shrinks to a tenth."""
    motions = evidence.motions(case)
    stable = motions[motions["floquet"] == STABLE]
    cycles = (np.log(0.1) / np.log(stable["modulus_1"])).max()
    return Finding({"longer than the cycles shown": cycles > 10}, {"cycles to a tenth": cycles})


def only_possible_behaviour(evidence, case):
    """No stable 1:1 response, and where starts end: those spread evenly, and the one from rest."""
    shares = evidence.measured(case, "spread", "share of starts").set_index("regime")["mean"]
    (rest,) = evidence.measured(case, "rest", "resonant share")["regime"].unique()
    motions = evidence.motions(case)
    parts = {
        "no stable 1:1 response": not (motions["floquet"] == STABLE).any(),
        "all spread starts end modulated": shares.get(STRONGLY_MODULATED, 0.0) == 1.0,
        "so does the start from rest, with both balls": rest == STRONGLY_MODULATED,
    }
    numbers = {f"share {regime}": share for regime, share in shares.items()}
    return Finding(parts, numbers | {"from rest": rest, "one ball idle from rest": rest == IDLE})


def no_practical_importance(evidence, case, label):
    """The orbit of an unstable fixed point is not observed: it is unstable itself, and nothing stays near it."""
    partner = evidence.points(case).loc[label, "orbit"]
    orbit = evidence.motions(case).set_index("label").loc[partner]
    parts = {"its orbit is not stable": orbit["floquet"] != STABLE}
    return Finding(parts, {"largest multiplier": orbit["modulus_1"]})


def resonant_intervals(evidence, case):
    """Bursts of resonant flights, and shorter gaps between them, irregular by the largest Lyapunov exponent."""
    share, burst = (
        evidence.measured(case, "spread", quantity).set_index("module")["mean"].loc[[1, 2]].to_numpy()
        for quantity in ("resonant share", "burst length")
    )
    gap = burst * (1 - share) / share
    row = evidence.measured(case, "spread", "largest Lyapunov exponent").iloc[0]
    parts = {
        "intervals of resonant motion": (burst > 1).all(),
        "shorter non-resonant ones between": (gap < burst).all(),
        "irregular": row["mean"] > 5 * row["uncertainty"],
    }
    numbers = {"resonant share": share.tolist(), "burst, cycles": burst.tolist(), "gap, cycles": gap.tolist()}
    return Finding(parts, numbers | {"largest Lyapunov exponent": row["mean"]})


def beating(evidence, case):
    """Amplitudes of each box vary more than in a sinusoidal beat whose largest is 3 times its smallest."""
    rows = evidence.measured(case, "spread", "amplitude variation").set_index("module")
    found = rows["mean"].loc[[1, 2]]
    parts = {f"box {i}": found[i] - 2 * rows.loc[i, "uncertainty"] > LARGE for i in (1, 2)}
    return Finding(parts, {"amplitude variation": found.tolist()})


def lower_amplitudes_end_stable_responses(evidence, sequence):
    """From case to case with falling amplitudes: stable 1:1 responses, symmetric or not, and modulated ends."""
    stable = [int((evidence.motions(case)["floquet"] == STABLE).sum()) for case in sequence]
    shares = evidence.measured(sequence[-1], "spread", "share of starts").set_index("regime")["mean"]
    parts = {
        "stable responses at first": stable[0] > 0,
        "none at last": stable[-1] == 0,
        "modulated response at last": shares.get(STRONGLY_MODULATED, 0.0) > 0,
    }
    return Finding(parts, {"stable 1:1 orbits": stable, "modulated share at last": shares.get(STRONGLY_MODULATED, 0.0)})


def periodic_solutions(evidence):
    """Every fixed point has an exact orbit that stays between the walls; how far apart they are."""
    both = evidence.fixed_points.merge(
        evidence.orbits, left_on=["case", "orbit"], right_on=["case", "label"], suffixes=("", "_exact")
    )
    off = np.hypot(both["C1"] - both["C1_exact"], both["C2"] - both["C2_exact"])
    parts = {
        "an exact orbit for each": len(both) == len(evidence.fixed_points),
        "that stays between the walls": both["admissible_exact"].all(),
    }
    return Finding(parts, {"points": len(evidence.fixed_points), "largest distance in C": off.max()})


def assesses_stability(evidence):
    """Criteria against the multipliers of the exact orbits, over all fixed points: right more often than by chance."""
    points = evidence.fixed_points
    both = (points["masri_derived"] == STABLE) & (points["slow_flow"] == STABLE)
    right = {
        "(10.26)": int((points["printed_10_26"] == points["floquet"]).sum()),
        "theory, fast and slow": int((both == (points["floquet"] == STABLE)).sum()),
    }
    parts = {f"by {name}": 2 * count > len(points) for name, count in right.items()}
    return Finding(parts, {f"right by {name}": count for name, count in right.items()} | {"of": len(points)})


def restitution_far_from_unity(evidence, kappas):
    """Distance of fixed points from exact orbits falls like epsilon at restitution coefficients from small to large."""
    parts, without = {}, []
    for kappa in kappas:
        system = evidence.system.with_(kappa=kappa)
        pairs = [
            [compare(system.with_(epsilon=eps), point).distance for eps in (2e-4, 1e-4)]
            for point in fixed_points(system)
        ]
        if pairs:
            wide, narrow = np.transpose(pairs)
            parts[f"kappa = {kappa}"] = np.allclose(wide / narrow, 2, rtol=0.05)
        else:
            without.append(kappa)
    return Finding(parts, {"kappa without fixed points": without})
