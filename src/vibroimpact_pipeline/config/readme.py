"""The model of the config -> config/README.md: every key with its type, range, unit, meaning and value of today.

Run it as `python -m vibroimpact_pipeline.config.readme`.
"""

from collections.abc import Iterator

from vibroimpact_pipeline.checkout import ROOT
from vibroimpact_pipeline.config.cost import CYCLES, HELD
from vibroimpact_pipeline.config.fields import WORDS
from vibroimpact_pipeline.config.schema import entries, resolved, root, variants
from vibroimpact_pipeline.config.text import limit, read

SOURCE, TARGET = "config/config.yaml", "config/README.md"
HEAD = f"""# Keys of config/config.yaml

Written by `python -m vibroimpact_pipeline.config.readme` from the model in `src/vibroimpact_pipeline/config/`, which
every build checks the config against. All keys are needed but those marked *optional*. `<name>` is free to
choose, `[]` stands for every entry of a list. Without a unit, quantities are dimensionless or numbers of something.

Conditions across keys are checked as well. No job may ask for more than {CYCLES:.0e} forcing cycles, if every start
took as long as the observation lets it, nor hold the events of more than {HELD:.0e} at once.
"""
COLUMNS = ("key", "type", "allowed", "unit", "meaning", "now")
TYPES = {"number": "number", "integer": "whole number", "string": "text", "array": "list", "object": "mapping"}
SIGNS = {"minimum": "≥", "exclusiveMinimum": ">", "maximum": "≤", "exclusiveMaximum": "<"}


def readme(config: dict) -> str:
    """The text of config/README.md for a config."""
    parts = [HEAD]
    for name, node in root()["properties"].items():
        parts += [f"## `{name}`\n", _description(name), _table(_rows(node, "", [config[name]])), ""]
    return "\n".join(parts).rstrip("\n") + "\n"


def _description(section):
    text = resolved(root()["properties"][section]).get("description", "")
    return "\n".join(line.strip() for line in text.splitlines()) + "\n"


def _table(rows):
    lines = [COLUMNS, ["---"] * len(COLUMNS), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _rows(node: dict, key: str, values: list, needed: bool = True) -> Iterator[tuple[str, ...]]:
    """The rows of a node and of all below it; `values` are those that the config has there."""
    for variant in variants(node):
        mine = [value for value in values if _is_of(variant, value)]
        below = [*_fields(variant, mine), *_free(variant, mine)]
        meaning = variant.get("description", "") + ("" if needed else " *(optional)*")
        if key and "description" in variant:
            now = "" if below else _now(mine)
            yield f"`{key}`", _type(variant), _allowed(variant), variant.get("unit", ""), meaning, now
        for name, child, found, always in below:
            yield from _rows(child, f"{key}{name}".removeprefix("."), found, always)


def _is_of(variant, value):
    """Whether a value is of this variant: names that tell variants apart are right."""
    fixed = {name: child["const"] for name, child in variant.get("properties", {}).items() if "const" in child}
    return not isinstance(value, dict) or fixed.items() <= value.items()


def _fields(section, values):
    """The keys of a section: name, node, values, whether it is always there."""
    for name, child in section.get("properties", {}).items():
        yield f".{name}", child, [value[name] for value in values if name in value], name in section.get("required", ())


def _free(node, values):
    """Sections in a list, or under free names, as `_fields`."""
    known = node.get("properties", {})
    for child in entries(node):
        if any("properties" in variant for variant in variants(child)):
            found = [item for value in values for item in _items(value, known)]
            yield "[]" if "items" in node else ".<name>", child, found, not known


def _items(value, known):
    return [item for key, item in value.items() if key not in known] if isinstance(value, dict) else value


def _type(node):
    parts = node.get("prefixItems") or ([node["items"]] if "items" in node else [])
    inner = f" of {TYPES[parts[0]['type']]}s".replace("texts", "names") if parts else ""
    return TYPES[node["type"]] + inner


def _allowed(node):
    """The range of a value, or of every entry of a list, and how many entries there are."""
    if "prefixItems" in node:
        return "; ".join(map(_allowed, node["prefixItems"]))
    if "items" in node:
        low, high = node["minItems"], node["maxItems"]
        return f"{low if low == high else f'{low} to {high}'}, each {_allowed(node['items'])}"
    if "const" in node or "enum" in node:
        return ", ".join(f"`{name}`" for name in node.get("enum", [node.get("const")]))
    if "pattern" in node:
        return WORDS[node["pattern"]]
    limits = [f"{sign} {limit(float(node[name]))}" for name, sign in SIGNS.items() if name in node]
    return ", ".join([*limits, "even"] if node.get("multipleOf") == 2 else limits)


def _now(values):
    """The values of the config, each once."""
    return ", ".join(f"`{text}`" for text in dict.fromkeys(map(str, values)))


if __name__ == "__main__":
    (ROOT / TARGET).write_text(readme(read(ROOT / SOURCE)), encoding="utf-8")
