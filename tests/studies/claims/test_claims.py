"""Claims: the list is sound, verdicts follow from what is computed, and other evidence leads to other verdicts."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import yaml
from scipy.optimize import fsolve, newton

import vibroimpact as vi
from pipeline_trees import ROOT
from vibroimpact.exact.orbits.symmetric import symmetric_solutions
from vibroimpact.studies.claims import equation_checks as claims_equations
from vibroimpact.studies.claims import manifold_checks as claims_manifold
from vibroimpact.studies.claims import point_checks as claims_points
from vibroimpact.studies.claims.finding import HOLDS, IN_PART, MISPRINT, OPEN, REFUTED, VERDICTS, Finding, as_printed
from vibroimpact.studies.claims.judge import CHECKS, judge, problems
from vibroimpact.theory.manifold import B_of_C, rho
from vibroimpact.theory.slow_flow import rates
from vibroimpact_pipeline.studies.claims_evidence import evidence as evidence_of

DOCUMENT = yaml.safe_load((ROOT / "docs/studies/claims.yaml").read_text(encoding="utf-8"))
CLAIMS = {claim["id"]: claim for claim in DOCUMENT["claims"]}
EXPECTED = yaml.safe_load((Path(__file__).parent / "expected_verdicts.yaml").read_text(encoding="utf-8"))
TABLES = ("fixed_points", "orbits", "verdict_grid")
REGIMES = ("modulation", "special_points", "epsilon_orders")


@pytest.fixture(scope="module")
def evidence(studied):
    """What the pipeline has found."""
    results = studied / "results"
    inputs = {name: results / f"{name}.csv" for name in TABLES}
    inputs |= {name: results / f"regimes/{name}.csv" for name in REGIMES}
    inputs["proofs"] = results / "proofs.json"
    for case, model in {"equal": "float64", "weak": "reference"}.items():
        run = results / "simulations" / case / model
        inputs |= {f"{case}_{name}": run / f"{name}.csv" for name in ("samples", "events")}
        inputs[f"{case}_summary"] = run / "summary.json"
    return evidence_of(inputs)


@pytest.fixture(scope="module")
def verdicts(evidence):
    return {claim["id"]: claim["verdict"] for claim in judge(list(CLAIMS.values()), evidence)}


def verdict(claim, evidence):
    return judge([CLAIMS[claim]], evidence)[0]["verdict"]


# The list


def test_the_list_is_sound_and_every_check_is_used():
    assert problems(list(CLAIMS.values())) == []
    assert len(DOCUMENT["claims"]) == len(CLAIMS) >= 25
    assert {claim["check"] for claim in CLAIMS.values()} == set(CHECKS)


def test_problems_of_a_list_are_named():
    sound = {"id": "one", "place": "p", "statement": "s", "check": "weak_coupling", "refuted_by": "r"}
    assert problems([sound]) == []
    assert problems([sound, sound]) == ["one: id given twice"]
    assert problems([sound | {"check": "nothing"}]) == ["one: no check is called 'nothing'"]
    assert problems([sound | {"verdict": "holds"}]) == ["one: unknown field 'verdict'"]
    assert problems([{key: sound[key] for key in sound if key != "place"}]) == ["one: place is missing"]
    with pytest.raises(ValueError, match=r"^claims: one: id given twice"):
        judge([sound, sound], None)


# Verdicts


@pytest.mark.parametrize("claim", EXPECTED)
def test_the_verdict_on_a_claim_has_not_changed(verdicts, claim):
    assert verdicts[claim] == EXPECTED[claim]


def test_every_claim_has_an_expected_verdict():
    assert EXPECTED.keys() == CLAIMS.keys()


@pytest.mark.parametrize(
    ("parts", "expected"),
    [
        ([True], HOLDS),
        ([True, True], HOLDS),
        ([True, False], IN_PART),
        ([False, False], REFUTED),
        ([None], OPEN),
        ([True, None], OPEN),
        ([np.bool_(False)], REFUTED),
    ],
)
def test_a_verdict_follows_from_the_parts(parts, expected):
    assert Finding({str(k): part for k, part in enumerate(parts)}).verdict == expected


def test_a_finding_has_parts():
    with pytest.raises(ValueError, match=r"^parts: "):
        Finding({})


def test_a_misprint_fails_as_printed_and_holds_as_corrected():
    finding = as_printed(False, True, value=np.float64(2.0))
    assert finding.verdict == MISPRINT
    assert finding.numbers == {"value": 2.0, "as corrected": HOLDS}
    assert type(finding.numbers["value"]) is float


@pytest.mark.parametrize(
    ("parts", "corrected", "expected"),
    [
        ([True], True, HOLDS),
        ([False], False, REFUTED),
        ([False], None, REFUTED),
        ([True, False], True, MISPRINT),
        ([True, False], False, IN_PART),
        ([None, False], True, OPEN),
    ],
)
def test_only_what_fails_as_printed_and_holds_corrected_is_a_misprint(parts, corrected, expected):
    assert Finding({str(k): part for k, part in enumerate(parts)}, corrected=corrected).verdict == expected


def test_misprints_are_presented_last(verdicts):
    """Of the verdicts, and of the claims: none is listed before a refutation of substance."""
    assert VERDICTS[-1] == MISPRINT
    order = [verdicts[claim] for claim in CLAIMS]
    assert order.count(MISPRINT) == 5
    assert REFUTED not in order[order.index(MISPRINT) :]


# Other evidence, other verdicts


def with_table(evidence, name, change):
    table = getattr(evidence, name).copy()
    change(table)
    return dataclasses.replace(evidence, **{name: table})


def at(table, where, column, value):
    table.loc[table.eval(where), column] = value


CHANGED_TABLES = {
    "equal-b": ("fixed_points", 'case == "equal" and label == "b"', "exact", "stable", IN_PART),
    "equal-c": ("fixed_points", 'case == "equal" and label == "c"', "exact", "stable", HOLDS),
    "weak-a": ("fixed_points", 'case == "weak"', "exact", "undecided", OPEN),
    "two-stable-equal": ("fixed_points", 'case == "equal"', "fast", "undecided", IN_PART),
    "one-stable-unequal": ("fixed_points", 'case == "unequal" and label == "b"', "fast", "stable", REFUTED),
    "equal-a-left": ("fixed_points", 'case == "equal" and label == "a"', "C1", 1.0, REFUTED),
    "weak-left-arms": ("fixed_points", 'case == "weak"', "C2", 1.0, IN_PART),
    "points-move-left": ("fixed_points", 'case == "unequal"', ["C1", "C2"], 0.1, HOLDS),
    "stable-point-moves-down": ("fixed_points", 'case == "unequal" and label == "c"', "C1", 0.9, IN_PART),
    "assesses-stability": ("verdict_grid", "epsilon > 0", "exact", "stable", IN_PART),
    "no-practical-importance": ("orbits", 'case == "weak"', "exact", "stable", REFUTED),
    "falling-amplitudes": ("fixed_points", 'case == "equal" and label == "c"', "exact", "stable", HOLDS),
    "periodic-solutions": ("verdict_grid", "epsilon > 0", "admissible", True, HOLDS),
    "unstable-means-modulated": ("modulation", 'quantity == "share of starts"', "regime", "asymmetric", IN_PART),
    "only-possible-behaviour": ("modulation", 'start == "rest"', "regime", "strongly modulated", HOLDS),
    "resonant-intervals": ("modulation", 'quantity == "resonant share"', "mean", 0.3, IN_PART),
    "beating": ("modulation", 'quantity == "amplitude variation"', "mean", 0.35, REFUTED),
    "order-of-the-expansion": ("epsilon_orders", 'panel == "two terms"', "order", 1.0, IN_PART),
}


@pytest.mark.parametrize("claim", CHANGED_TABLES)
def test_other_tables_lead_to_the_verdict_that_they_mean(evidence, claim):
    table, where, column, value, expected = CHANGED_TABLES[claim]
    assert verdict(claim, with_table(evidence, table, lambda rows: at(rows, where, column, value))) == expected


def test_a_grid_without_wrong_verdicts_would_leave_nothing_to_hold_against_the_theory(evidence):
    says = ["printed_10_26", "theory"]
    agreeing = with_table(evidence, "verdict_grid", lambda rows: rows.update(dict.fromkeys(says, rows["exact"])))
    assert {"stable", "unstable"} < set(agreeing.verdict_grid["exact"])
    assert verdict("assesses-stability", agreeing) == HOLDS


def test_confusion_matrices_count_every_point(evidence):
    (judged,) = judge([CLAIMS["assesses-stability"]], evidence)
    grid = evidence.verdict_grid.query("epsilon == 0.1")
    without = grid["exact"] == "no orbit"
    (of_all,) = judge([CLAIMS["periodic-solutions"]], evidence)
    # docs/studies/findings.md: one more exists only if its ball may leave the box.
    assert judged["numbers"]["without an orbit"] + 1 == of_all["numbers"]["without an orbit between the walls"]
    for name in ("(10.26)", "fast and slow"):
        (calm, wrong), (missed, right) = judged["numbers"][f"{name}, epsilon = 0.1"]
        assert calm + wrong + missed + right == (grid["exact"] != "no orbit").sum()
        assert calm + missed == (grid["exact"] == "stable").sum()
        assert sum(judged["numbers"][f"{name}, epsilon = 0.1, no orbit"]) == without.sum()
    called = grid["printed_10_26"] == "stable"
    assert judged["numbers"]["(10.26), epsilon = 0.1, no orbit"][0] == (called & without).sum()
    (calm, wrong), _ = judged["numbers"]["(10.26), epsilon = 0.1"]
    assert calm + wrong == ((grid["printed_10_26"] == "stable") & (grid["exact"] != "no orbit")).sum()


def test_a_small_restitution_is_looked_at(evidence):
    """0.3 has no fixed point and no orbit; at 0.05 the ball of one point leaves its box."""
    (judged,) = judge([CLAIMS["any-restitution"]], evidence)
    assert judged["numbers"]["fixed points at 0.3, forces 1.0"] == 0
    failed = [part for part, holds in judged["parts"].items() if not holds]
    assert failed == ["kappa = 0.05, forces 1.0: between the walls"]
    roots = symmetric_solutions(evidence.system.with_(kappa=0.3, epsilon=1e-4))
    assert not (roots[:, 2:] > 0).all(axis=1).any()


def test_a_restitution_without_fixed_points_is_not_counted_in_favour(evidence):
    """At forces 1 and 0.3 neither theory nor exact system has a motion: nothing has been shown then."""
    claim = CLAIMS["any-restitution"] | {"arguments": {"kappas": [0.3], "forces": [1.0]}}
    assert judge([claim], evidence)[0]["verdict"] == REFUTED
    found = judge([claim | {"arguments": {"kappas": [0.3], "forces": [1.0, 1.2]}}], evidence)[0]
    assert found["verdict"] == HOLDS
    assert len(found["parts"]) == 3


# The fast criterion and the labels of the chapter


def impact_map_multipliers(C, kappa):
    """Moduli of the multipliers of the impact map, with the motion U of the box held, by central differences.

    The state is the instant of an impact at wall +1 and the speed of the ball after it. In flight Y goes at this speed.
    """
    sine, cosine = 1 - C, 2 * (1 - kappa) / (np.pi * (1 + kappa)) * C  # B times those of the impact phase, (10.17)

    def U(t, order=0):
        return np.sin(t + order * np.pi / 2) * cosine + np.cos(t + order * np.pi / 2) * sine

    def next_impact(t, speed):
        """From Y = U - 1 to Y = U + 1, half a period later, and mirrored back."""
        end = newton(lambda s: U(s) - U(t) - speed * (s - t) + 2, t + np.pi, lambda s: U(s, 1) - speed, tol=1e-14)
        rate = U(end, 1)
        return np.array([end - np.pi, -(rate - kappa * (speed - rate))])

    # Y goes from -C to C in half a period.
    start = np.array([0.0, 2 * C / np.pi])
    assert np.allclose(next_impact(*start), start, atol=1e-9)
    h = 1e-6
    columns = [(next_impact(*(start + h * e)) - next_impact(*(start - h * e))) / (2 * h) for e in np.eye(2)]
    return np.abs(np.linalg.eigvals(np.transpose(columns)))


def test_the_fast_criterion_gives_two_one_and_none_and_every_label_of_the_chapter(evidence):
    """Multipliers of the fast impact map at the fixed points, recomputed; labels are those of the claims."""
    said = {
        (claim["arguments"]["case"], claim["arguments"]["label"]): claim["arguments"]["says"]
        for claim in CLAIMS.values()
        if claim["check"] == "label_of_a_point"
    }
    assert len(said) == 7
    assert said == {(case, label): says for case, row in claims_points.CAPTIONS.items() for label, says in row.items()}
    rows = evidence.fixed_points.set_index(["case", "label"])
    found = {
        place: "stable"
        if max(impact_map_multipliers(rows.loc[place, C], 0.65).max() for C in ("C1", "C2")) < 1
        else "unstable"
        for place in said
    }
    assert found == said
    for claim, number in {"two-stable-equal": 2, "one-stable-unequal": 1}.items():
        (judged,) = judge([CLAIMS[claim]], evidence)
        assert judged["parts"][f"{number} by the derived fast criterion"]
        assert judged["parts"]["the captions by the fast criterion"]
        assert judged["numbers"]["captions right in all cases by the fast criterion"] == 7


def test_by_continuation_point_c_leaves_the_right_arm(evidence):
    """Followed by Newton's method on (10.23) itself, by a solver that knows no list of fixed points."""
    system = evidence.systems["equal"]
    point = next(p for p in vi.fixed_points(system) if abs(p.C[1] - 1.677) < 1e-3)
    unknown = np.concatenate([point.C, point.psi])
    for f20 in np.linspace(1.0, 0.89, 23):
        here = system.with_(f20_hat=f20)

        def residual(x, here=here):
            return np.ravel(rates(here, B_of_C(x[:2], rho(here.kappa)), x[2:], x[:2]))

        unknown, _, success, _ = fsolve(residual, unknown, xtol=1e-12, full_output=True)
        assert success == 1
    (judged,) = judge([CLAIMS["stable-point-moves-down"]], evidence)
    np.testing.assert_allclose(judged["numbers"]["C after, by continuation"], unknown[:2], rtol=1e-9)
    assert unknown[0] < 1 / (1 + rho(0.65) ** 2)
    assert [part for part, holds in judged["parts"].items() if not holds] == ["P1, by continuation"]


def test_modulation_without_a_stable_point_is_not_the_chapters_claim_of_every_case(evidence):
    """The case that it names is modulated; the one at amplitudes 1, unstable too, is not."""
    (judged,) = judge([CLAIMS["unstable-means-modulated"]], evidence)
    assert judged["verdict"] == HOLDS
    assert judged["numbers"]["modulated share, weak"] == 1
    assert judged["numbers"]["modulated share, equal"] == 0


def test_no_exponents_make_a_misprint_of_10_26(evidence, monkeypatch):
    """None of those tried is right; with 4 / (4 + 4 rho^2) and motions up to the upper limit it would be a misprint."""
    (judged,) = judge([CLAIMS["printed-condition"]], evidence)
    assert (judged["verdict"], judged["numbers"]["right with these"]) == (REFUTED, 0)
    monkeypatch.setattr(claims_manifold, "EXPONENTS", (np.log(4) / np.log(np.pi), 2.0))  # 4 / (4 + 4 rho^2) = C_min
    monkeypatch.setattr(claims_manifold, "largest_C", lambda kappa: 1.68)
    assert verdict("printed-condition", evidence) == MISPRINT


def test_the_captions_need_another_limit_than_the_printed_one(evidence):
    """By counting stable points with both C_i above a limit, which needs no letters: two, one and none in the cases."""
    (judged,) = judge([CLAIMS["printed-condition"]], evidence)
    points = [np.array([p.C for p in vi.fixed_points(evidence.systems[case])]) for case in ("equal", "unequal", "weak")]
    fold = 1 / (1 + rho(0.65) ** 2)

    def fits(limit):
        return [int((limit < C).all(axis=1).sum()) for C in points] == [2, 1, 0] and limit < fold

    least, most = (
        judged["numbers"][name]
        for name in ("the captions need a limit above", "and a stable piece of the left arm one below")
    )
    assert [fits(limit) for limit in (least - 1e-9, least + 1e-9, most - 1e-9, most + 1e-9)] == [
        False,
        True,
        True,
        False,
    ]
    assert not fits(4 / (4 + np.pi * rho(0.65)))
    found = dict(zip(map(tuple, judged["numbers"]["exponents of pi and rho that lead there"]),
                     judged["numbers"]["their limits"], strict=True))  # fmt: skip
    assert found == {
        (p, q): pytest.approx(limit)
        for p in range(4)
        for q in range(4)
        if fits(limit := 4 / (4 + np.pi**p * rho(0.65) ** q))
    }
    multipliers = [impact_map_multipliers(limit, 0.65).max() for limit in found.values()]
    np.testing.assert_allclose(judged["numbers"]["largest multipliers there"], multipliers, rtol=1e-6)
    assert min(multipliers) > 1.009


def test_without_an_upper_limit_there_would_be_two_branches(evidence, monkeypatch):
    """Of the three pieces one is stable; what ends it is the limit that the chapter does not have."""
    (judged,) = judge([CLAIMS["two-branches"]], evidence)
    assert judged["parts"] == {"one stable branch": True, "one unstable branch": False}
    monkeypatch.setattr(claims_manifold, "largest_C", lambda kappa: 1.68)
    assert verdict("two-branches", evidence) == HOLDS
    monkeypatch.setattr(claims_manifold, "largest_C", lambda kappa: 0.98)
    assert verdict("two-branches", evidence) == IN_PART  # no stable branch at all


def test_an_idle_ball_hides_no_modulation(evidence):
    """From rest in the weak case: box 1 is modulated by the measure of the claim `beating`, and ball 2 never moves."""
    (judged,) = judge([CLAIMS["only-possible-behaviour"]], evidence)
    assert judged["numbers"]["one ball idle from rest"]
    box, other = judged["numbers"]["amplitude variation from rest"]
    assert box > 0.5 / np.sqrt(2) > other
    share, none = judged["numbers"]["resonant share from rest"]
    assert 0.1 < share < 0.9
    assert none == 0


def test_impacts_at_another_place_than_the_wall_are_no_misprint(evidence):
    """One sequence per module is what the correction says, so that each impact finds its own ball at its wall."""
    off = {
        case: dataclasses.replace(one, events=one.events.assign(X1=one.events["X1"] + 0.01))
        for case, one in evidence.simulations.items()
    }
    assert verdict("common-impact-instants", dataclasses.replace(evidence, simulations=off)) == REFUTED


def test_a_list_not_proved_complete_counts_nothing(evidence):
    proofs = evidence.proofs | {"weak": {"fixed_points": {"proved": 1, "complete": False}}}
    doubtful = dataclasses.replace(evidence, proofs=proofs)
    assert verdict("points-weak", doubtful) == REFUTED
    assert verdict("phases-can-be-eliminated", doubtful) == IN_PART


def test_a_missing_point_is_noticed(evidence):
    fewer = dataclasses.replace(evidence, fixed_points=evidence.fixed_points.iloc[1:])
    assert verdict("points-equal", fewer) == REFUTED


def test_a_point_beyond_the_largest_C_leaves_the_box(evidence):
    far = with_table(evidence, "fixed_points", lambda rows: at(rows, 'case == "weak"', "C1", 6.0))
    (before,), (after,) = (judge([CLAIMS["no-penetration"]], given) for given in (evidence, far))
    assert (before["parts"]["all fixed points"], after["parts"]["all fixed points"]) == (True, False)


def test_singular_points_everywhere_are_near_the_fold(evidence, monkeypatch):
    monkeypatch.setattr(
        claims_points, "singular_points", lambda system, point, module: np.array([[point.C[module - 1], 0.0]])
    )
    (judged,) = judge([CLAIMS["singular-bifurcation"]], evidence)
    assert judged["parts"]["a point is singular where two merge"]


def test_another_motion_is_not_similar(evidence):
    """The modulated motion of the weak case neither repeats nor has the amplitudes of point (c)."""
    other = dataclasses.replace(evidence, simulations={"equal": evidence.simulations["weak"]})
    assert verdict("steady-response", other) == REFUTED
    assert verdict("similar-results", other) == REFUTED


def test_a_right_limit_would_not_be_refuted_at_the_limit(evidence, monkeypatch):
    monkeypatch.setattr(claims_manifold, "printed_limit", lambda rho: 1 / (1 + rho**2))
    assert verdict("printed-condition", evidence) == IN_PART


def test_another_function_has_other_harmonics(evidence, monkeypatch):
    monkeypatch.setattr(claims_equations, "sawtooth", lambda tau, C, theta: C * np.cos(tau - theta))
    (judged,) = judge([CLAIMS["leading-order-solution"]], evidence)
    assert judged["verdict"] == IN_PART
    assert not judged["parts"]["harmonics"]


def test_lighter_boxes_would_make_the_misprint_right(evidence):
    heavy = {case: system.with_(epsilon=5.0) for case, system in evidence.systems.items()}
    assert verdict("small-balls", dataclasses.replace(evidence, systems=heavy)) == HOLDS


def test_a_weaker_damper_makes_the_coupling_weak(evidence):
    weaker = {case: system.with_(gamma12_hat=0.02) for case, system in evidence.systems.items()}
    assert verdict("weak-coupling", dataclasses.replace(evidence, systems=weaker)) == HOLDS


# Facts

PAGE_OF_ERRATA = (ROOT / "docs/errata.md").read_text(encoding="utf-8")


def test_what_is_refuted_is_two_facts(verdicts):
    told = [claim.get("fact") for name, claim in CLAIMS.items() if verdicts[name] == REFUTED]
    assert set(told) == set(DOCUMENT["facts"])
    assert "come down to two facts" in (ROOT / "docs/studies/findings.md").read_text(encoding="utf-8")
    assert not any("fact" in claim for name, claim in CLAIMS.items() if verdicts[name] == HOLDS)


@pytest.mark.parametrize(
    ("swapped", "expected"),
    [
        (["equal"], {"equal-b": IN_PART, "equal-c": REFUTED, "similar-results": REFUTED}),  # labelling I
        (["unequal"], {}),  # labelling III
    ],
)
def test_the_verdicts_that_hang_on_which_point_is_b_and_which_is_c(evidence, verdicts, swapped, expected):
    def swap(table):
        rows = table["case"].isin(swapped)
        table.loc[rows, "label"] = table.loc[rows, "label"].map({"a": "a", "b": "c", "c": "b"})

    other = {
        claim["id"]: claim["verdict"]
        for claim in judge(list(CLAIMS.values()), with_table(evidence, "fixed_points", swap))
    }
    assert {claim: found for claim, found in other.items() if found != verdicts[claim]} == expected
    assert all(f"`{claim}`" in PAGE_OF_ERRATA for claim in expected)
