"""The JSON schema of the config: what it says of a place."""

from functools import cache

from vibroimpact_pipeline.config.model import Config


@cache
def root() -> dict:
    """The schema of the whole config."""
    return Config.model_json_schema()


def resolved(node: dict) -> dict:
    """A node of the schema with what it refers to; what it says itself comes first."""
    name = node.get("$ref", "").removeprefix("#/$defs/")
    return {**root()["$defs"][name], **node} if name else node


def variants(node: dict) -> list[dict]:
    """The node itself, or those of which one applies."""
    return [resolved(one) for one in resolved(node).get("oneOf", [node])]


def keys_at(place) -> set[str]:
    """The keys that a section may have, whichever of its variants it is."""
    nodes = variants(root())
    for part in place:
        nodes = [variant for node in nodes for child in _below(node, part) for variant in variants(child)]
    return {key for node in nodes for key in node.get("properties", ())}


def _below(node, part):
    if part in node.get("properties", {}):
        return [node["properties"][part]]
    return entries(node)


def entries(node: dict) -> list[dict]:
    """What the entries of a list or of a mapping with free names look like."""
    child = node.get("items") or node.get("additionalProperties")
    return [child] if isinstance(child, dict) else [*node.get("patternProperties", {}).values()]
