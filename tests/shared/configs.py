"""The config of the checkout, and edits of it."""

import copy
import re

from vibroimpact_pipeline.config.text import parse_value

from pipeline_trees import ROOT
from vibroimpact_pipeline.config import read

TEXT = (ROOT / "config/config.yaml").read_text(encoding="utf-8")
GOOD = read(ROOT / "config/config.yaml")


def edited(edits: str) -> dict:
    """The good config after edits "place = YAML", several with " & " between them; the value ... deletes.

    Raises:
        ValueError: the YAML of a value is refused.
    """
    config = copy.deepcopy(GOOD)
    for edit in edits.split(" & "):
        place, _, value = edit.partition(" =")
        _edit(config, place, value.strip())
    return config


def _edit(config, place, value):
    *above, key = [int(part[1:]) if part[0] == "[" else part for part in re.findall(r"\[\d+|[^.\[\]]+", place)]
    for part in above:
        config = config[part]
    if value == "...":
        del config[key]
    else:
        config[key] = parse_value(value)
