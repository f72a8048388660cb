"""What Pydantic finds wrong with a config, in words that say what was given and what is allowed."""

import re

from pydantic import ValidationError

from vibroimpact_pipeline.config.fields import WORDS
from vibroimpact_pipeline.config.figures import OWN
from vibroimpact_pipeline.config.reading import shown
from vibroimpact_pipeline.config.section import Problem, hint

PHRASES = {
    "greater_than": "{} is not above {gt:g}",
    "greater_than_equal": "{} is below {ge:g}",
    "less_than": "{} is not below {lt:g}",
    "less_than_equal": "{} is above {le:g}",
    "multiple_of": "{} is not a multiple of {multiple_of}",
    "finite_number": "{} is not finite",
    "missing": "missing",
    "condition": "{what}",
    "too_long": "has length {actual_length}, above {max_length}",
    "too_short": "has length {actual_length}, below {min_length}",
    "string_pattern_mismatch": "{} is not {words}",
}
KINDS = {"float": "a number", "int": "a whole number", "string": "text", "list": "a list", "tuple": "a list"}


def problems_of(error: ValidationError) -> list[Problem]:
    """Return everything that Pydantic found wrong, each with its place in the config."""
    found = {}
    for details in error.errors(include_url=False):
        place, kind, about = details["loc"], details["type"], details.get("ctx", {})
        if len(place) > 3 and place[0] == "figures" and place[2] in OWN:
            place = place[:2] + place[3:]  # without the name of the variant
        place = place[:-1] if place[-1:] == ("[key]",) else place
        if "discriminator" in about:
            place = (*place, about["discriminator"].strip("'"))
        found.setdefault(place, _described(kind, details["input"], about, details["msg"]))
    return list(found.items())


def _described(kind, value, about, message):
    if kind in PHRASES:
        given = shown(value, plain=kind != "string_pattern_mismatch")  # numbers may be texts
        return PHRASES[kind].format(given, words=WORDS.get(about.get("pattern")), **about)
    if kind == "union_tag_not_found":
        return "missing"
    if kind in ("literal_error", "union_tag_invalid"):
        names = re.findall(r"'([^']+)'", about.get("expected") or about["expected_tags"])
        given = about.get("tag", value)
        return f"{shown(given)} is not {' or '.join(map(repr, names))}{hint(given, names)}"
    if kind.endswith(("_type", "_parsing", "_parsing_size", "_from_float")):
        return f"{shown(value)} is not {KINDS.get(kind.split('_')[0], 'a mapping')}"
    return message
