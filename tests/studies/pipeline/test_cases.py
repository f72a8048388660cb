"""A case with a parameter of its own on the pages and maps that show forces: only cases of one system stand there."""

import json
from types import SimpleNamespace

import pandas as pd
import pytest

from chapter import FORCES, PARAMETERS
from configs import SOFT, edited
from vibroimpact import System, fixed_points
from vibroimpact.studies.figures import companion_regime_map
from vibroimpact_pipeline.config import checked
from vibroimpact_pipeline.specs import case_parameters
from vibroimpact_pipeline.studies.report.live import live_data

CONFIG = checked(edited(SOFT))
SYSTEMS = {case: System(**case_parameters(CONFIG, case)) for case in CONFIG["cases"]}


def test_the_live_page_has_the_cases_that_differ_in_forces():
    """Not `soft`, of which the tables of a build have points as well."""
    points = [(case, point.label, "", "no orbit") for case, one in SYSTEMS.items() for point in fixed_points(one)]
    tables = {"fixed_points.csv": pd.DataFrame(points, columns=["case", "label", "orbit", "exact"])}
    tables |= {"orbits.csv": pd.DataFrame(columns=["case", "label", "modulus_1"])}
    data = json.loads(live_data(SimpleNamespace(table=tables.get), CONFIG))
    assert data["system"] == PARAMETERS
    assert {name: tuple(case["forces"]) for name, case in data["cases"].items()} == FORCES


@pytest.mark.parametrize(("base", "marked"), [("equal", set(FORCES)), ("soft", {"soft"})])
def test_a_map_marks_the_cases_that_differ_in_forces(base, marked):
    places = [(f10, f20) for f10 in (0.5, 1.0) for f20 in (0.5, 1.0)]
    counts = dict.fromkeys(companion_regime_map.REGIMES, 0.0) | {"symmetric 1:1": 1.0}
    cells = pd.DataFrame({"f10_hat": f10, "f20_hat": f20, "fixed_points": 1, "stable_points": 1} for f10, f20 in places)
    cells = cells.assign(**counts, **{companion_regime_map.FROM_REST: "symmetric 1:1"})
    tables = companion_regime_map.compute(cells, SYSTEMS[base], SYSTEMS, 2)
    assert set(tables["cases"]["case"]) == marked
