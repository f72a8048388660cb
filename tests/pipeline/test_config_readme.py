"""config/README.md says what the model of the config says."""

import re

from vibroimpact_pipeline.config.readme import readme

from configs import GOOD
from pipeline_trees import ROOT

TEXT = (ROOT / "config/README.md").read_text(encoding="utf-8")
ROWS = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in TEXT.splitlines() if line.startswith("| `")]


def test_it_is_up_to_date():
    assert readme(GOOD) == TEXT, "run python -m vibroimpact_pipeline.config.readme"


def test_every_key_has_a_type_and_a_meaning():
    assert len(ROWS) > 100
    assert [row for row in ROWS if len(row) != 6 or not row[1] or len(row[4]) < 5] == []


def test_every_number_has_limits_on_both_sides():
    numbers = [row for row in ROWS if "number" in row[1]]
    assert len(numbers) > 50
    assert [row[0] for row in numbers if not (re.search("[≥>]", row[2]) and re.search("[≤<]", row[2]))] == []


def test_every_number_of_the_config_is_among_those_of_today():
    assert "`0.65`" in next(row[5] for row in ROWS if row[0] == "`kappa`")
    assert "`150`" in next(row[5] for row in ROWS if row[0].endswith("digits`"))
