"""Check claims of sections 10.4 and 10.5 about simulated responses, modulation, and the accuracy of the theory."""

import numpy as np
import pandas as pd

from vibroimpact.accuracy.verdict_table import NO_ORBIT
from vibroimpact.exact.measures.slow_variables import measure
from vibroimpact.exact.orbits.search import orbits
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.studies.claims.finding import Finding
from vibroimpact.studies.regimes.classification import IDLE, STRONGLY_MODULATED
from vibroimpact.studies.regimes.epsilon_limit import distance_to_orbit
from vibroimpact.system.verdict import STABLE, UNSTABLE
from vibroimpact.theory.fixed_points.symmetric_points import fixed_points
from vibroimpact.theory.manifold import stays_within_walls

SIMILAR = 0.1
"""Amplitudes count as similar up to this relative difference; smaller differences are hardly visible in a figure."""
BEAT_VARIATION = 0.5 / np.sqrt(2)
"""Standard deviation / mean of the amplitude 1 + cos(...) / 2 of a beat; its maximum is 3 times its minimum."""
PER_CYCLE = 2
SMALL = 2e-4, 1e-4
"""Two values of epsilon, so small that the error of the theory is proportional to epsilon."""
VERDICT_LABELS = [STABLE, UNSTABLE]
DISPLACEMENTS = ["X1", "Y1", "X2", "Y2"]


def steady_two_impacts(evidence, case):
    """Check that the simulated motion repeats every cycle, with one impact of each ball at each wall."""
    simulation = evidence.simulations[case]
    cycles = simulation.summary["settings"]["window_cycles"]
    change = simulation.summary["largest_change_after_cycles"]["1"]
    counts = [simulation.summary["events"]["impact"][str(module)] for module in (1, 2)]
    impacts = simulation.impacts
    alternate = all((np.diff(impacts.loc[impacts["module"] == i, "wall"]) != 0).all() for i in (1, 2))
    parts = {
        "the motion repeats every cycle": change < 1e-6,
        # The count may differ by one, since an impact may be at the edge of the observed window.
        "each ball impacts twice a cycle": all(abs(count - PER_CYCLE * cycles) <= 1 for count in counts) and alternate,
    }
    return Finding(parts, {"change after a cycle": change, "impacts of each ball": counts, "cycles observed": cycles})


def numerical_results_are_similar(evidence, case, label):
    """Check that C, B and the symmetry of the simulated response are as predicted at the fixed point `label`."""
    row, simulation = evidence.points(case).loc[label], evidence.simulations[case]
    tau, displacements = (simulation.samples.iloc[:-1][names].to_numpy() for names in ("tau", DISPLACEMENTS))
    measured = measure(evidence.systems[case], tau, displacements, simulation.impacts)
    predicted = {name: row[[f"{name}1", f"{name}2"]].to_numpy(float) for name in ("C", "B")}
    off = {name: np.abs(getattr(measured, name) / value - 1) for name, value in predicted.items()}
    asymmetry = np.abs(np.mod(measured.impact_phases @ [-1, 1], 1) - 0.5) * 2
    parts = {
        **{f"simulated {name} is within 10 % of theory": (values < SIMILAR).all() for name, values in off.items()},
        "the simulated flights are symmetric, as predicted": asymmetry.max() < 1e-6,
    }
    numbers = {"difference of the two flights of each ball, in periods": asymmetry}
    for name in predicted:
        numbers |= {f"predicted {name}": predicted[name], f"simulated {name}": getattr(measured, name)}
        numbers |= {f"relative difference of predicted and simulated {name}": off[name]}
    return Finding(parts, numbers)


def transients_are_long(evidence, case):
    """Check that perturbations of at least one stable orbit need more than 10 cycles to shrink to a tenth."""
    motions = evidence.motions(case)
    cycles = (np.log(0.1) / np.log(motions.loc[motions["exact"] == STABLE, "modulus_1"])).max()
    return Finding({"a transient exceeds the plotted time": cycles > 10}, {"longest decay to a tenth, cycles": cycles})


def only_possible_behaviour(evidence, case):
    """Check that no 1:1 response is stable, and that all motions end strongly modulated, with impacts of both balls.

    The motions start from evenly spread initial states and from rest.
    """
    shares = evidence.shares(case)
    (rest,) = evidence.measured(case, "rest", "resonant share")["regime"].unique()
    motions = evidence.motions(case)
    parts = {
        "no 1:1 response is stable": not (motions["exact"] == STABLE).any(),
        "all evenly spread starts end modulated": shares.get(STRONGLY_MODULATED, 0.0) == 1.0,
        "the start from rest ends modulated, with both balls": rest == STRONGLY_MODULATED,
    }
    numbers = {f"share of evenly spread starts that end {regime}": share for regime, share in shares.items()}
    numbers |= {"regime of the start from rest": rest, "one ball idle after the start from rest": rest == IDLE}
    for quantity in ("amplitude variation", "resonant share"):
        of_modules = evidence.measured(case, "rest", quantity).set_index("module")["mean"]
        numbers[f"{quantity} of each module, start from rest"] = of_modules.loc[[1, 2]].to_list()
    return Finding(parts, numbers)


def no_practical_importance(evidence, case, label):
    """Check that the exact orbit that belongs to the fixed point `label` is not stable."""
    partner = evidence.points(case).loc[label, "orbit"]
    orbit = evidence.motions(case).set_index("label").loc[partner]
    parts = {"the exact orbit of the solution is not stable": orbit["exact"] != STABLE}
    return Finding(parts, {"largest multiplier of the exact orbit": orbit["modulus_1"]})


def resonant_intervals(evidence, case):
    """Check that resonance lasts on average longer than a cycle, and longer than the intervals without resonance.

    The motion must also be chaotic: its largest Lyapunov exponent must exceed five times the uncertainty of this
    exponent.
    """
    share, burst = (
        evidence.measured(case, "spread", quantity).set_index("module")["mean"].loc[[1, 2]].to_numpy()
        for quantity in ("resonant share", "burst length")
    )
    gap = burst * (1 - share) / share
    row = evidence.measured(case, "spread", "largest Lyapunov exponent").iloc[0]
    parts = {
        "resonant intervals are longer than a cycle": (burst > 1).all(),
        "non-resonant intervals are shorter than resonant ones": (gap < burst).all(),
        "the motion is chaotic": row["mean"] > 5 * row["uncertainty"],
    }
    numbers = {"resonant share of each ball": share, "mean resonant interval of each ball, in cycles": burst}
    numbers |= {"mean non-resonant interval of each ball, in cycles": gap, "largest Lyapunov exponent": row["mean"]}
    return Finding(parts, numbers)


def beating(evidence, case):
    """Check that the amplitude of each box varies more than the amplitude of a beat.

    The amplitude variation must exceed BEAT_VARIATION by more than twice the uncertainty of the amplitude variation.
    """
    rows = evidence.measured(case, "spread", "amplitude variation").set_index("module")
    lowest = rows["mean"] - 2 * rows["uncertainty"]
    parts = {f"the amplitude of box {i} varies more than in a beat": lowest[i] > BEAT_VARIATION for i in (1, 2)}
    return Finding(parts, {"amplitude variation of each box": rows["mean"].loc[[1, 2]].tolist()})


def lower_amplitudes_end_stable_responses(evidence, sequence):
    """Check that the first case of `sequence` has stable fixed points, and that the last case has none.

    The last case must also have strongly modulated responses.
    """
    points = [evidence.points(case) for case in sequence]
    in_theory = [int((rows["theory"] == STABLE).sum()) for rows in points]
    exactly = [int((rows["exact"] == STABLE).sum()) for rows in points]
    others = [int((evidence.motions(case)["exact"] == STABLE).sum()) for case in sequence]
    share = evidence.shares(sequence[-1]).get(STRONGLY_MODULATED, 0.0)
    parts = {
        "a point is stable at the highest amplitudes, by theory": in_theory[0] > 0,
        "a point's exact orbit is stable at the highest amplitudes": exactly[0] > 0,
        "no fixed point is stable at the lowest amplitudes": in_theory[-1] == exactly[-1] == 0,
        "strong modulation occurs at the lowest amplitudes": share > 0,
    }
    numbers = {"points stable by theory, per case": in_theory, "points stable by their orbits, per case": exactly}
    numbers |= {"stable 1:1 orbits of any kind, per case": others, "modulated share at the lowest amplitudes": share}
    return Finding(parts, numbers)


def unstable_means_modulated(evidence, case):
    """Check that all fixed points of a case are unstable, and that its motions end strongly modulated.

    The motions start from evenly spread initial states.
    """
    observed = evidence.modulation["case"].unique()
    unstable = [name for name in observed if (evidence.points(name)["exact"] == UNSTABLE).all()]
    shares = {name: evidence.shares(name).get(STRONGLY_MODULATED, 0.0) for name in (case, *unstable)}
    parts = {"all points are unstable": case in unstable, "all evenly spread starts end modulated": shares[case] == 1}
    return Finding(parts, {f"share of starts that end modulated, {name} case": share for name, share in shares.items()})


def periodic_solutions(evidence, f10_hat, f20_hat):
    """Check that every fixed point of the cases and of a grid of forces has an admissible exact orbit.

    f10_hat, f20_hat: one more pair of forces, at which the fixed points and the exact orbits are counted in `numbers`.
    """
    both = evidence.fixed_points.merge(
        evidence.orbits, left_on=["case", "orbit"], right_on=["case", "label"], suffixes=("", "_exact")
    )
    off = np.hypot(both["C1"] - both["C1_exact"], both["C2"] - both["C2_exact"])
    grid, system = _at_epsilon(evidence), evidence.system.with_(f10_hat=f10_hat, f20_hat=f20_hat)
    folds = evidence.special_points.query("path == 'f20_hat' and kind == 'fold'").groupby("family")["p"].min()
    parts = {
        "each fixed point of the chapter has an exact orbit": len(both) == len(evidence.fixed_points),
        "exact orbits of the chapter's points stay between the walls": both["admissible_exact"].all(),
        "each point of a force grid has an orbit between the walls": grid["admissible"].all(),
    }
    numbers = {
        "largest error of C": off.max(),
        "number of fixed points of the chapter": len(evidence.fixed_points),
        "number of fixed points over the force grid": len(grid),
        "points of the force grid without an orbit between the walls": int((~grid["admissible"]).sum()),
        f"fixed points at forces {f10_hat}, {f20_hat}": len(fixed_points(system)),
        f"exact orbits at forces {f10_hat}, {f20_hat}": sum(o.symmetric and o.admissible for o in orbits(system)),
        "f20 where two fixed points merge": folds["fixed point"],
        "f20 where two exact orbits merge": folds["symmetric orbit"],
    }
    return Finding(parts, numbers)


def _at_epsilon(evidence):
    """Return the rows of `verdict_grid` with the epsilon of the chapter's cases."""
    grid = evidence.verdict_grid
    return grid[grid["epsilon"] == evidence.system.epsilon]


def assesses_stability(evidence):
    """Measure the share of right verdicts of each criterion over a grid of forces.

    A verdict on a fixed point is right if it equals the verdict on the exact orbit of this point. For each criterion
    and epsilon, `numbers` has a confusion matrix. Its rows are the verdicts of the criterion. Its columns are the
    verdicts on the exact orbits.
    """
    grid = evidence.verdict_grid
    parts, shares = {}, {}
    numbers = {"points of the force grid without an exact orbit": (_at_epsilon(evidence)["exact"] == NO_ORBIT).sum()}
    for name, criterion in {"(10.26)": "printed_10_26", "both time scales": "theory"}.items():
        for epsilon, rows in grid.groupby("epsilon", sort=False):
            found = pd.crosstab(rows[criterion], rows["exact"])
            found = found.reindex(index=VERDICT_LABELS, columns=[*VERDICT_LABELS, NO_ORBIT], fill_value=0)
            matrix = found[VERDICT_LABELS]
            numbers[f"verdicts of {name} against exact, epsilon = {epsilon}"] = matrix.to_numpy().tolist()
            numbers[f"verdicts of {name} without an orbit, epsilon = {epsilon}"] = found[NO_ORBIT].to_list()
            if epsilon == evidence.system.epsilon:
                for saying in VERDICT_LABELS:
                    right, predicted = matrix.loc[saying, saying], matrix.loc[saying].sum()
                    parts[f"most points {saying} by {name} are {saying}"] = 2 * right > predicted
                    shares[f"share of right verdicts, {saying} by {name}"] = right / predicted if predicted else None
    points = evidence.fixed_points
    numbers["number of fixed points of the chapter"] = len(points)
    numbers["points of the chapter judged right by (10.26)"] = int((points["printed_10_26"] == points["exact"]).sum())
    numbers["points of the chapter judged right by both time scales"] = int((points["theory"] == points["exact"]).sum())
    return Finding(parts, shares | numbers)


def restitution_far_from_unity(evidence, kappas, forces):
    """Compare fixed points with exact orbits at each restitution coefficient of `kappas` and each force of `forces`.

    Both boxes have the same force. Each fixed point must belong to one symmetric orbit, and each symmetric orbit to one
    fixed point. The distance of a fixed point from its orbit must be proportional to epsilon. At each fixed point, the
    balls must stay between the walls. For each restitution coefficient, at least one force must give a fixed point.
    """
    parts, numbers = {}, {}
    for kappa in kappas:
        listed = {force: _points_beside_orbits(evidence.system, kappa, force) for force in forces}
        parts[f"kappa = {kappa}: some force gives a fixed point"] = any(points for points, _ in listed.values())
        for force, (points, together) in listed.items():
            numbers[f"number of fixed points at kappa = {kappa}, forces {force}"] = len(points)
            if points:
                inside = all(stays_within_walls(C, kappa) for point in points for C in point.C)
                parts[f"kappa = {kappa}, forces {force}: points match the orbits"] = together
                parts[f"kappa = {kappa}, forces {force}: balls stay inside"] = inside
    return Finding(parts, numbers)


def _points_beside_orbits(system, kappa, force):
    """Return the fixed points, and True if they match the symmetric exact orbits one to one.

    A fixed point and an orbit match if the fixed point is the limit of the orbit as epsilon tends to 0. Both boxes have
    the force `force`.
    """
    system = system.with_(kappa=kappa, f10_hat=force, f20_hat=force)
    points = fixed_points(system)
    roots = symmetric_solutions(system.with_(epsilon=SMALL[-1]))
    ratios = [
        np.divide(*(distance_to_orbit(system.with_(epsilon=e), point).distance for e in SMALL)) for point in points
    ]
    motions = int((roots[:, 2:] > 0).all(axis=1).sum())
    return points, motions == len(points) and np.allclose(ratios, SMALL[0] / SMALL[1], rtol=0.05)
