"""Write the JSON Schema of each config file, with which text editors check the file.

Run as `python -m vibroimpact_pipeline.config.schema`.
"""

import json
from importlib import import_module
from importlib.util import find_spec

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.config.model import Config

TARGETS = {ROOT / "workflow/schemas/config.schema.json": Config}
if find_spec("vibroimpact_pipeline.studies"):
    studies = import_module("vibroimpact_pipeline.studies.config.model").Studies
    TARGETS[ROOT / "workflow/schemas/studies/config.schema.json"] = studies
NUMERALS = {"number": r"^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$", "integer": r"^[-+]?\d+(\.0*)?$"}
"""For each type of number, the pattern of texts that Pydantic converts to a number of this type."""


def schema(model) -> str:
    """Return the JSON Schema of a Pydantic model as text, with one line for each section of the config."""
    whole = {"$schema": "https://json-schema.org/draft/2020-12/schema"} | _plain(model.model_json_schema())
    sections = ",\n".join(f"{json.dumps(name)}: {json.dumps(part)}" for name, part in whole.pop("$defs").items())
    return f'{{"$defs": {{\n{sections}\n}},\n{json.dumps(whole)[1:]}\n'


def _plain(node):
    """Return a copy of a node of a JSON Schema; titles, and defaults with the value null, are left out.

    The copy accepts a number that is written as text. In a section with the key `case`, this key may be missing.
    """
    if not isinstance(node, dict):
        return [_plain(item) for item in node] if isinstance(node, list) else node
    plain = {key: _plain(item) for key, item in node.items() if key != "title" or not isinstance(item, str)}
    if plain.get("default", ...) is None:
        del plain["default"]
    if plain.get("type") in ("number", "integer"):
        plain |= {"type": [plain["type"], "string"], "pattern": NUMERALS[plain["type"]]}
    if "case" in plain.get("required", ()):
        plain["required"] = [name for name in plain["required"] if name != "case"]  # the default is default_case
    return plain | ({"additionalProperties": False} if "patternProperties" in plain else {})


if __name__ == "__main__":
    for target, model in TARGETS.items():
        target.parent.mkdir(exist_ok=True)
        target.write_text(schema(model), encoding="utf-8")
