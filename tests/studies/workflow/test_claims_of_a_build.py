"""Results of a build: completeness proofs, expected verdicts on claims, and numbers of the findings."""

import json
import re

import pandas as pd
import pytest
import yaml

from pipeline_trees import ROOT
from vibroimpact import tables
from vibroimpact_pipeline.studies.report.results import Results

EXPECTED = yaml.safe_load((ROOT / "tests/studies/claims/expected_verdicts.yaml").read_text(encoding="utf-8"))
FINDINGS = (ROOT / "docs/studies/findings.md").read_text(encoding="utf-8")
DOCUMENTS = "".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs").rglob("*.md")))
PLACES = yaml.safe_load((ROOT / "docs/studies/numbers.yaml").read_text(encoding="utf-8"))
SOURCED = [
    (number, PLACES[key])
    for number, key in re.findall(r"\[(−?[\d.]+)\]\((?:studies/)?numbers\.yaml#([\w.-]+)\)", DOCUMENTS)
]
"""Numbers of documents, each with its place in the results."""
CHAOTIC = tuple(f"regimes/{name}.csv" for name in ("modulation", "modulation_onsets", "spectra", "basin_shares"))
LARGEST_OF_FEW = (
    *(f'absorber.csv | quantity == "peak" and who == "{who}"' for who in ("balls", "balls, best kappa")),
    *(f'absorber.csv | quantity == "{quantity}"' for quantity in ("lowest peak", "greatest", "impact share")),
)
"""Results of a few runs, most of which are chaotic."""
LONG = tuple(
    f'regimes/{file}.csv | case == "{case}" and start == "spread" and quantity == "{quantity}" | mean'
    for file, case, quantity in (
        ("modulation", "weak", "largest Lyapunov exponent"),
        ("modulation", "unequal", "largest Lyapunov exponent"),
        ("spectra", "weak", "exponent 2"),
        ("spectra", "weak", "sum of exponents"),
    )
)
"""Results of chaotic runs that are long enough for every build to give the digits of the findings."""


def test_fixed_points_and_symmetric_orbits_are_proved_complete(studied):
    proofs = json.loads((studied / "results/proofs.json").read_text())
    assert set(proofs) == {"equal", "unequal", "weak"}
    for case, found in proofs.items():
        assert found["fixed_points"]["complete"]
        assert found["asymmetric_fixed_points"]["complete"]
        assert found["symmetric_orbits"]["complete"]
        assert found["fixed_points"]["undecided"] == found["symmetric_orbits"]["undecided"] == []
        orbits = tables.read(studied / f"results/orbits/{case}.csv")
        assert (orbits["box_radius"] > 0).all()
        assert not (orbits[["motion_proved", "floquet_proved"]] == "not proved").any(axis=None)


def test_verdicts_are_those_expected(studied):
    claims = json.loads((studied / "results/claims.json").read_text())
    assert {claim["id"]: claim["verdict"] for claim in claims} == EXPECTED


@pytest.mark.parametrize(("quoted", "source"), SOURCED)
def test_a_number_of_the_findings_is_that_of_the_results(studied, quoted, source):
    """The number as quoted is the one of the results, rounded to as many decimals.

    Statistics of chaotic motions differ from one machine to another: they agree within five times their uncertainty, or
    15 % where they come from a single run. A spread of a few starts is known to its order of magnitude. Ratios
    of run times are only larger than 1.
    """
    decimals = len(quoted.partition(".")[2])
    percent = "percent | " * source.startswith("percent | ")
    place = source.removeprefix(percent).split(" | ")
    results = Results(studied / "results")
    found = results.value(source)
    spread = 0.0
    if place[0].startswith(CHAOTIC) and " | ".join(place) not in LONG:
        spread = 5 * results.value(percent + " | ".join([*place[:-1], "uncertainty"]))
        spread = 0.15 * abs(found) if pd.isna(spread) else spread
    elif " | ".join(place).startswith(LARGEST_OF_FEW):
        spread = (1.0 if place[-1] == "spread" else 0.15) * abs(found)
    elif place[-1] == "times":  # a ratio of two run times, each as noisy as the machine is busy
        assert found > 1
        return
    assert abs(found - float(quoted.replace("−", "-"))) <= 0.5 * 10.0**-decimals + spread


def test_the_dimension_without_double_sticks_is_within_the_bounds_of_the_findings(studied):
    bounds = re.search(r"Kaplan–Yorke\s+dimension\s+between (\d+\.\d+) and (\d+\.\d+)", DOCUMENTS).groups()
    place = "regimes/spectra.csv", 'case == "weak" and start == "spread" and quantity == "Kaplan-Yorke dimension"'
    mean, error = (
        Results(studied / "results").value(" | ".join([*place, column])) for column in ("mean", "uncertainty")
    )
    assert float(bounds[0]) < mean - 5 * error < mean + 5 * error < float(bounds[1])


def test_the_matrix_of_criteria_is_that_of_the_results(studied):
    points = pd.read_csv(studied / "results/fixed_points.csv").set_index(["case", "label"])
    both = points[["fast", "slow"]].eq("stable").all(axis=1).map({True: "stable", False: "unstable"})
    points = points.assign(both=both)[["printed_10_26", "fast", "both", "exact"]]
    rows = re.findall(r"^\| (\w+) ([a-c]) \| (\w+) \| (\w+) \| (\w+) \| (\w+) \|$", FINDINGS, flags=re.MULTILINE)
    assert {(case, label): verdicts for case, label, *verdicts in rows} == dict(
        zip(points.index, points.to_numpy().tolist(), strict=True)
    )
