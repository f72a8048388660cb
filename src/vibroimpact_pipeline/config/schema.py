"""The JSON Schema of the config, for editors and for Snakemake without Pydantic.

Run it as `python -m vibroimpact_pipeline.config.schema`.
"""

import json

from vibroimpact_pipeline.code import ROOT
from vibroimpact_pipeline.config.model import Config

TARGET = ROOT / "workflow/schemas/config.schema.json"
NUMERALS = {"number": r"^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$", "integer": r"^[-+]?\d+(\.0*)?$"}
"""Texts that are read as numbers."""


def schema() -> str:
    """Return the text of the schema, a line for each section of the config."""
    made = {"$schema": "https://json-schema.org/draft/2020-12/schema"} | _plain(Config.model_json_schema())
    sections = ",\n".join(f"{json.dumps(name)}: {json.dumps(part)}" for name, part in made.pop("$defs").items())
    return f'{{"$defs": {{\n{sections}\n}},\n{json.dumps(made)[1:]}\n'


def _plain(node):
    """Return a node without titles and defaults of null; numbers may be texts, and names have to match."""
    if not isinstance(node, dict):
        return [_plain(item) for item in node] if isinstance(node, list) else node
    made = {key: _plain(item) for key, item in node.items() if key != "title" or not isinstance(item, str)}
    if made.get("default", ...) is None:
        del made["default"]
    if made.get("type") in ("number", "integer"):
        made |= {"type": [made["type"], "string"], "pattern": NUMERALS[made["type"]]}
    if "case" in made.get("required", ()):
        made["required"] = [name for name in made["required"] if name != "case"]  # else default_case
    return made | ({"additionalProperties": False} if "patternProperties" in made else {})


if __name__ == "__main__":
    TARGET.parent.mkdir(exist_ok=True)
    TARGET.write_text(schema(), encoding="utf-8")
