"""Error messages on a config: which key, what was given, what is allowed."""

import re

from pydantic import ValidationError

from vibroimpact_pipeline.config import kinds
from vibroimpact_pipeline.config.figures import OWN
from vibroimpact_pipeline.config.section import Problem, hint

PHRASES = {
    "greater_than": "{} is not above {gt:g}",
    "greater_than_equal": "{} is below {ge:g}",
    "less_than": "{} is not below {lt:g}",
    "less_than_equal": "{} is above {le:g}",
    "multiple_of": "{} is not a multiple of {multiple_of}",
    "finite_number": "{} is not finite",
    "missing": "missing",
    "union_tag_not_found": "missing",
    "condition": "{what}",
    "too_long": "has more than {max_length} entries",
    "too_short": "has fewer than {min_length} entries",
    "string_pattern_mismatch": "{} is not {words}",
}
KINDS = {"float": "a number", "int": "a whole number", "string": "text", "list": "a list", "tuple": "a list"}


def problems_of(error: ValidationError) -> list[Problem]:
    """Return all problems that Pydantic found, each with its place in the config."""
    found = {}
    for details in error.errors(include_url=False):
        place, about = details["loc"], details.get("ctx", {})
        if place[:1] == ("figures",) and {*place[2:3]} & {*OWN}:
            place = place[:2] + place[3:]  # without the name of the variant
        place = place[:-1] if place[-1:] == ("[key]",) else place
        place += ("notebook",) if "discriminator" in about else ()
        found.setdefault(place, _described(details["type"], details["input"], about, details["msg"]))
    return list(found.items())


def _described(kind, value, about, message):
    if kind in PHRASES:
        given = shown(value, plain=kind != "string_pattern_mismatch")  # numbers may be texts
        return PHRASES[kind].format(given, words=kinds.WORDS.get(about.get("pattern")), **about)
    if kind in ("literal_error", "union_tag_invalid"):
        names = re.findall(r"'([^']+)'", about.get("expected") or about["expected_tags"])
        given = about.get("tag", value)
        return f"{shown(given)} is not {' or '.join(map(repr, names))}{hint(given, names)}"
    if kind.endswith(("_type", "_parsing", "_parsing_size", "_from_float")):
        return f"{shown(value)} is not {KINDS.get(kind.split('_')[0], 'a mapping')}"
    return message


def written(place) -> str:
    """Return a place in the config as text: system.kappa, regimes.branches.paths[0]."""
    names = (f"[{part}]" if isinstance(part, int) else f".{shown(part, plain=True)}" for part in place)
    return "".join(names).removeprefix(".")


def shown(value, plain: bool = False) -> str:
    """Return a value as text for an error message: one line, shortened in the middle if long."""
    text = "nothing" if value is None else str(value) if plain and str(value).isprintable() else repr(value)
    return text if len(text) <= 120 else f"{text[:60]}...{text[-60:]}"
