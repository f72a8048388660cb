"""The verdicts of the rungs over a grid: every motion counted, and the numbers that docs/ladder.md quotes."""

import re
from pathlib import Path

import pandas as pd
import pytest
import yaml

import ladder_grid
import vibroimpact as vi
from chapter import PARAMETERS
from pipeline_trees import ROOT
from vibroimpact.regimes.cells import plane_of_forces
from vibroimpact_pipeline.report.results import Results

SYSTEM = {**PARAMETERS, "f10_hat": 1.0, "f20_hat": 1.0}
QUOTED = re.findall(r"(\d+)<!-- (regimes/ladder_grid.+?) -->", (ROOT / "docs/ladder.md").read_text(encoding="utf-8"))


def test_every_fixed_point_has_a_verdict_at_every_epsilon(tmp_path):
    settings = {"f10_range": [0.4, 1.6], "f20_range": [0.4, 1.6], "points": 2, "epsilon": [0.1, 0.01]}
    ladder_grid.main(SYSTEM, settings, tmp_path / "grid.csv")
    counted = pd.read_csv(tmp_path / "grid.csv").groupby(["rung", "epsilon"])["motions"].sum()
    forces = plane_of_forces(settings["f10_range"], settings["f20_range"], settings["points"])
    points = sum(len(vi.fixed_points(vi.System(**PARAMETERS, f10_hat=f10, f20_hat=f20))) for f10, f20 in forces)
    assert points > 4
    assert (counted["leading order"] == points).all()
    assert (counted["two terms"] <= points).all()


@pytest.mark.thorough
def test_the_document_quotes_the_grid(tmp_path):
    settings = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))["stability"]["verdict_grid"]
    path = Path(tmp_path, "regimes/ladder_grid.csv")
    path.parent.mkdir()
    ladder_grid.main(SYSTEM, settings, path)
    results = Results(tmp_path)
    assert len(QUOTED) > 20
    assert [(source, number) for number, source in QUOTED] == [
        (source, f"{results.value(*source.split(' | ')):.0f}") for _, source in QUOTED
    ]
