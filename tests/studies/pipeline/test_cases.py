"""Test maps of the force plane with cases that override parameters: a map shows only cases of its own system."""

import pandas as pd
import pytest

from chapter import FORCES
from configs import SOFT, edited
from vibroimpact import System
from vibroimpact.studies.figures import companion_regime_map
from vibroimpact_pipeline.config import checked
from vibroimpact_pipeline.specs import case_parameters

CONFIG = checked(edited(SOFT))
SYSTEMS = {case: System(**case_parameters(CONFIG, case)) for case in CONFIG["cases"]}


@pytest.mark.parametrize(("base", "marked"), [("equal", set(FORCES)), ("soft", {"soft"})])
def test_a_map_marks_only_cases_that_differ_from_its_system_in_forces_alone(base, marked):
    places = [(f10, f20) for f10 in (0.5, 1.0) for f20 in (0.5, 1.0)]
    counts = dict.fromkeys(companion_regime_map.REGIMES, 0.0) | {"symmetric 1:1": 1.0}
    cells = pd.DataFrame({"f10_hat": f10, "f20_hat": f20, "fixed_points": 1, "stable_points": 1} for f10, f20 in places)
    cells = cells.assign(**counts, **{companion_regime_map.FROM_REST: "symmetric 1:1"})
    tables = companion_regime_map.compute(cells, SYSTEMS[base], SYSTEMS, 2)
    assert set(tables["cases"]["case"]) == marked
