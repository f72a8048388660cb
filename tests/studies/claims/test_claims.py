"""Test the claims: the list is valid, verdicts follow from the evidence, and other evidence changes them."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from scipy.optimize import fsolve

import vibroimpact as vi
from pipeline_trees import ROOT
from vibroimpact.studies.claims import equation_checks as claims_equations
from vibroimpact.studies.claims import manifold_checks as claims_manifold
from vibroimpact.studies.claims import point_checks as claims_points
from vibroimpact.studies.claims.finding import HOLDS, IN_PART, MISPRINT, OPEN, REFUTED, VERDICTS, Finding
from vibroimpact.studies.claims.judge import CHECKS, judge, problems
from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.masri import impact_multipliers
from vibroimpact.theory.slow_flow import rates
from vibroimpact_pipeline.studies.claims_evidence import evidence as evidence_of

DOCUMENT = yaml.safe_load((ROOT / "docs/studies/claims.yaml").read_text(encoding="utf-8"))
CLAIMS = {claim["id"]: claim for claim in DOCUMENT["claims"]}
POINTWISE = [claim for claim in CLAIMS.values() if not hasattr(claims_equations, claim["check"])]
"""Claims except those on equations, whose checks are slow and use no fixed points."""
EXPECTED = yaml.safe_load((Path(__file__).parent / "expected_verdicts.yaml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def evidence(studied):
    """Return the evidence that a build has computed."""
    results = studied / "results"
    names = ["fixed_points", "orbits", "verdict_grid"]
    names += [f"regimes/{name}" for name in ("modulation", "special_points", "epsilon_orders")]
    inputs = {Path(name).name: results / f"{name}.csv" for name in names} | {"proofs": results / "proofs.json"}
    for case, model in {"equal": "float64", "weak": "reference"}.items():
        for name in ("samples.csv", "events.csv", "summary.json"):
            inputs[f"{case}_{Path(name).stem}"] = results / "simulations" / case / model / name
    return evidence_of(inputs)


@pytest.fixture(scope="module")
def judged(studied):
    """Return the claims by id, with the verdicts of a build."""
    claims = json.loads((studied / "results/claims.json").read_text(encoding="utf-8"))
    return {claim["id"]: claim for claim in claims}


def verdict(claim, evidence):
    """Return the verdict on the claim with an id."""
    return judge([CLAIMS[claim]], evidence)[0]["verdict"]


# The list


def test_the_list_is_valid_and_uses_every_check():
    assert problems(list(CLAIMS.values())) == []
    assert len(DOCUMENT["claims"]) == len(CLAIMS) >= 25
    assert {claim["check"] for claim in CLAIMS.values()} == set(CHECKS)


def test_problems_of_an_invalid_list_are_named():
    valid = {"id": "one", "place": "p", "statement": "s", "check": "weak_coupling", "refuted_by": "r"}
    assert problems([valid]) == []
    assert problems([valid, valid]) == ["one: id given twice"]
    assert problems([valid | {"check": "nothing"}]) == ["one: no check is called 'nothing'"]
    assert problems([valid | {"verdict": "holds"}]) == ["one: unknown field 'verdict'"]
    assert problems([{key: valid[key] for key in valid if key != "place"}]) == ["one: place is missing"]
    with pytest.raises(ValueError, match=r"^claims: one: id given twice"):
        judge([valid, valid], None)


# Verdicts


@pytest.mark.parametrize(
    ("parts", "corrected", "expected"),
    [
        ([True, True], None, HOLDS), ([True, False], None, IN_PART), ([False, False], None, REFUTED),
        ([True, None], None, OPEN), ([np.bool_(False)], None, REFUTED), ([True], True, HOLDS),
        ([False], False, REFUTED), ([True, False], True, MISPRINT), ([True, False], False, IN_PART),
        ([None, False], True, OPEN),
    ],
)  # fmt: skip
def test_a_verdict_follows_from_the_parts(parts, corrected, expected):
    """A statement that fails as printed and holds as corrected is a misprint."""
    assert Finding({str(k): part for k, part in enumerate(parts)}, corrected=corrected).verdict == expected


def test_misprints_follow_all_other_verdicts():
    order = [EXPECTED[claim] for claim in CLAIMS]
    assert VERDICTS[-1] == MISPRINT
    assert REFUTED not in order[order.index(MISPRINT) :]


# Verdicts with changed evidence


def with_values(name, where, column, value):
    """Return a function that sets a column of a table of the evidence in the rows that a query selects."""

    def change(evidence):
        table = getattr(evidence, name).copy()
        table.loc[table.eval(where), column] = value
        return replace(evidence, **{name: table})

    return change


def with_systems(**changes):
    """Return a function that sets parameters of all systems of the evidence."""
    return lambda evidence: replace(evidence, systems={k: one.with_(**changes) for k, one in evidence.systems.items()})


def with_modulated_motion(evidence):
    """Use the modulated motion of the weak case as that of the equal case, where it should repeat and be at (c)."""
    return replace(evidence, simulations={"equal": evidence.simulations["weak"]})


def with_impacts_off_the_walls(evidence):
    """Move box 1 at each impact, so that neither the printed nor the corrected statement on impacts holds."""
    moved = {case: one.events.assign(X1=one.events["X1"] + 0.01) for case, one in evidence.simulations.items()}
    runs = {case: replace(one, events=moved[case]) for case, one in evidence.simulations.items()}
    return replace(evidence, simulations=runs)


def without_proof(evidence):
    """Leave the proof that the fixed points of the weak case are complete unfinished."""
    return replace(evidence, proofs=evidence.proofs | {"weak": {"fixed_points": {"proved": 1, "complete": False}}})


def with_correct_criteria(evidence):
    """Set the verdicts of both criteria to those of the exact system."""
    grid = evidence.verdict_grid
    return replace(evidence, verdict_grid=grid.assign(printed_10_26=grid["exact"], theory=grid["exact"]))


POINTS, GRID, RUNS = "fixed_points", "verdict_grid", "modulation"
EQUAL, WEAK = 'case == "equal"', 'case == "weak"'
CHANGED_EVIDENCE = [
    ("equal-b", with_values(POINTS, f'{EQUAL} and label == "b"', "exact", "stable"), IN_PART),
    ("weak-a", with_values(POINTS, WEAK, "exact", "undecided"), OPEN),
    ("two-stable-equal", with_values(POINTS, EQUAL, "fast", "undecided"), IN_PART),
    ("equal-a-left", with_values(POINTS, f'{EQUAL} and label == "a"', "C1", 1.0), REFUTED),
    ("points-move-left", with_values(POINTS, 'case == "unequal"', ["C1", "C2"], 0.1), HOLDS),
    ("stable-point-moves-down", with_values(POINTS, 'case == "unequal" and label == "c"', "C1", 0.9), IN_PART),
    ("assesses-stability", with_values(GRID, "epsilon > 0", "exact", "stable"), IN_PART),
    ("assesses-stability", with_correct_criteria, HOLDS),
    ("no-practical-importance", with_values("orbits", WEAK, "exact", "stable"), REFUTED),
    ("falling-amplitudes", with_values(POINTS, f'{EQUAL} and label == "c"', "exact", "stable"), HOLDS),
    ("periodic-solutions", with_values(GRID, "epsilon > 0", "admissible", True), HOLDS),
    ("unstable-means-modulated", with_values(RUNS, 'quantity == "share of starts"', "regime", "asymmetric"), IN_PART),
    ("only-possible-behaviour", with_values(RUNS, 'start == "rest"', "regime", "strongly modulated"), HOLDS),
    ("resonant-intervals", with_values(RUNS, 'quantity == "resonant share"', "mean", 0.3), IN_PART),
    ("beating", with_values(RUNS, 'quantity == "amplitude variation"', "mean", 0.35), REFUTED),
    ("order-of-the-expansion", with_values("epsilon_orders", 'panel == "two terms"', "order", 1.0), IN_PART),
    ("common-impact-instants", with_impacts_off_the_walls, REFUTED),
    ("points-weak", without_proof, REFUTED),
    ("phases-can-be-eliminated", without_proof, IN_PART),
    ("points-equal", lambda evidence: replace(evidence, fixed_points=evidence.fixed_points.iloc[1:]), REFUTED),
    ("steady-response", with_modulated_motion, REFUTED),
    ("similar-results", with_modulated_motion, REFUTED),
    ("small-balls", with_systems(epsilon=5.0), HOLDS),
    ("weak-coupling", with_systems(gamma12_hat=0.02), HOLDS),
]


@pytest.mark.parametrize(
    ("claim", "change", "expected"), CHANGED_EVIDENCE, ids=[claim for claim, *_ in CHANGED_EVIDENCE]
)
def test_changed_evidence_gives_the_verdict_that_follows_from_it(evidence, claim, change, expected):
    assert verdict(claim, change(evidence)) == expected


def test_a_restitution_without_fixed_points_does_not_support_the_claim(evidence):
    """At force 1 and kappa 0.3, neither the theory nor the exact system has a motion, so that nothing is compared."""
    claim = CLAIMS["any-restitution"] | {"arguments": {"kappas": [0.3], "forces": [1.0]}}
    assert judge([claim], evidence)[0]["verdict"] == REFUTED
    found = judge([claim | {"arguments": {"kappas": [0.3], "forces": [1.0, 1.2]}}], evidence)[0]
    assert found["verdict"] == HOLDS
    assert len(found["parts"]) == 3


# The fast criterion and the labels of the chapter


def test_the_fast_criterion_gives_all_stability_labels_of_the_chapter(evidence, judged):
    """The test computes the multipliers of the fast impact map at the fixed points; the claims contain the labels."""
    arguments = [claim["arguments"] for claim in CLAIMS.values() if claim["check"] == "label_of_a_point"]
    labels = {(one["case"], one["label"]): one["says"] for one in arguments}
    assert labels == {
        (case, label): says for case, row in claims_points.CAPTIONS.items() for label, says in row.items()
    }
    C = evidence.fixed_points.set_index(["case", "label"])[["C1", "C2"]]
    largest = C.apply(lambda row: np.abs([impact_multipliers(one, 0.65) for one in row]).max(), axis=1)
    assert {place: "stable" if largest[place] < 1 else "unstable" for place in labels} == labels
    assert len(labels) == 7
    for claim, number in {"two-stable-equal": 2, "one-stable-unequal": 1}.items():
        assert judged[claim]["parts"][f"the number of points stable by the derived fast criterion is {number}"]
        assert judged[claim]["parts"]["the fast criterion gives all captions of the case"]
        assert judged[claim]["numbers"]["captions of all cases that the fast criterion gives"] == 7


def test_the_continuation_of_point_c_in_the_force_leaves_the_right_arm(evidence, judged):
    """SciPy follows the zero of the slow flow (10.23), without a list of fixed points."""
    system = evidence.systems["equal"]
    point = next(p for p in vi.fixed_points(system) if abs(p.C[1] - 1.677) < 1e-3)
    unknown = np.concatenate([point.C, point.psi])
    for f20 in np.linspace(1.0, 0.89, 23):
        here = system.with_(f20_hat=f20)

        def residual(x, here=here):
            return np.ravel(rates(here, B_of_C(x[:2], rho(here.kappa)), x[2:], x[:2]))

        unknown, _, success, _ = fsolve(residual, unknown, xtol=1e-12, full_output=True)
        assert success == 1
    claim = judged["stable-point-moves-down"]
    np.testing.assert_allclose(claim["numbers"]["C1 and C2 of its continuation"], unknown[:2], rtol=1e-9)
    assert unknown[0] < 1 / (1 + rho(0.65) ** 2)
    failed = [part for part, holds in claim["parts"].items() if not holds]
    assert failed == ["P1 moves down the right arm to its continuation"]


def test_the_printed_condition_would_be_a_misprint_if_exponents_gave_all_labels(evidence, judged, monkeypatch):
    """No tried exponents give all labels. With 4 / (4 + 4 rho^2) and an upper limit, (10.26) would be a misprint."""
    claim = judged["printed-condition"]
    assert (claim["verdict"], claim["numbers"]["number of pairs of exponents that make the claim hold"]) == (REFUTED, 0)
    kappa = evidence.system.kappa
    squared = claim["numbers"]["limit with squares, 4 / (4 + pi^2 rho^2)"]
    assert squared == pytest.approx((1 + kappa) ** 2 / (2 * (1 + kappa**2)), rel=1e-13)
    with monkeypatch.context() as patch:
        patch.setattr(claims_manifold, "printed_limit", lambda rho: 1 / (1 + rho**2))
        assert verdict("printed-condition", evidence) == IN_PART
    monkeypatch.setattr(claims_manifold, "EXPONENTS", (np.log(4) / np.log(np.pi), 2.0))  # 4 / (4 + 4 rho^2) = C_min
    monkeypatch.setattr(claims_manifold, "largest_C", lambda kappa: 1.68)
    assert verdict("printed-condition", evidence) == MISPRINT


def test_the_claim_of_two_branches_fails_because_of_the_upper_limit(evidence, judged, monkeypatch):
    """One of three pieces is stable. It ends at the upper limit, which the chapter lacks."""
    parts = {"there is one stable branch": True, "there is one unstable branch": False}
    assert judged["two-branches"]["parts"] == parts
    for largest, expected in ((1.68, HOLDS), (0.98, IN_PART)):  # with 0.98, no branch is stable
        monkeypatch.setattr(claims_manifold, "largest_C", lambda kappa, largest=largest: largest)
        assert verdict("two-branches", evidence) == expected


def test_parts_that_do_not_decide_a_verdict_depend_on_the_evidence(evidence, judged, monkeypatch):
    """Evidence is a point beyond the largest C, a singular point at each fixed point, and a cosine as sawtooth."""
    (far,) = judge([CLAIMS["no-penetration"]], with_values("fixed_points", 'case == "weak"', "C1", 6.0)(evidence))
    part = "the ball is inside at all fixed points"
    assert [one["parts"][part] for one in (judged["no-penetration"], far)] == [True, False]
    monkeypatch.setattr(claims_points, "singular_points", lambda system, point, i: np.array([[point.C[i - 1], 0.0]]))
    monkeypatch.setattr(claims_equations, "sawtooth", lambda tau, C, theta: C * np.cos(tau - theta))
    near, other = judge([CLAIMS["singular-bifurcation"], CLAIMS["leading-order-solution"]], evidence)
    assert near["parts"]["a fixed point is singular where two fixed points merge"]
    assert not other["parts"]["formula of the harmonics holds"]


# Facts

ERRATA = (ROOT / "docs/errata.md").read_text(encoding="utf-8")


def test_refuted_claims_belong_to_two_facts(judged):
    assert {claim.get("fact") for claim in judged.values() if claim["verdict"] == REFUTED} == set(DOCUMENT["facts"])
    findings = (ROOT / "docs/studies/findings.md").read_text(encoding="utf-8")
    assert "fail for one of two reasons" in " ".join(findings.split())
    assert not any("fact" in claim for claim in judged.values() if claim["verdict"] == HOLDS)


@pytest.mark.parametrize(
    ("swapped", "expected"),
    [
        (["equal"], {"equal-b": IN_PART, "equal-c": REFUTED, "similar-results": REFUTED}),  # the labels ascend in C_1
        (["unequal"], {}),  # the labels follow from continuation
    ],
)
def test_exchanged_labels_b_and_c_change_only_the_verdicts_that_the_errata_name(evidence, swapped, expected):
    table = evidence.fixed_points.copy()
    rows = table["case"].isin(swapped)
    table.loc[rows, "label"] = table.loc[rows, "label"].map({"a": "a", "b": "c", "c": "b"})
    exchanged = judge(POINTWISE, replace(evidence, fixed_points=table))
    found = {claim["id"]: claim["verdict"] for claim in exchanged if claim["verdict"] != EXPECTED[claim["id"]]}
    assert found == expected
    assert all(f"`{claim}`" in ERRATA for claim in expected)


def test_confusion_matrices_count_all_points_of_the_grid(evidence, judged):
    numbers = judged["assesses-stability"]["numbers"]
    grid = evidence.verdict_grid.query("epsilon == 0.1")
    # docs/studies/findings.md: one more orbit exists only if its ball may leave the box.
    others = judged["periodic-solutions"]["numbers"]
    between_walls = others["points of the force grid without an orbit between the walls"]
    assert numbers["points of the force grid without an exact orbit"] + 1 == between_walls
    for name, column in (("(10.26)", "printed_10_26"), ("both time scales", "theory")):
        called = np.where(grid[column] == "stable", "stable", "other")
        counts = pd.crosstab(called, grid["exact"]).loc[["stable", "other"]]
        matrix = counts[["stable", "unstable"]].to_numpy().tolist()
        assert numbers[f"verdicts of {name} against exact, epsilon = 0.1"] == matrix
        assert numbers[f"verdicts of {name} without an orbit, epsilon = 0.1"] == counts["no orbit"].tolist()
