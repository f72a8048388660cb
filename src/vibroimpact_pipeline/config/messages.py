"""Make error messages for a config; each states the key, the given value and the allowed values."""

import difflib
import re
from collections.abc import Iterable

from pydantic import ValidationError

from vibroimpact_pipeline.config.section import Place, Section


def problems_of(error: ValidationError) -> dict[Place, dict]:
    """Return Pydantic's errors by key path.

    If a mapping has an unknown key, errors about missing keys of this mapping are omitted. The unknown key may be a
    misspelt name of a missing key.
    """
    errors = error.errors(include_url=False)
    misspelt = {details["loc"][:-1] for details in errors if details["type"] == "extra_forbidden"}
    found = {}
    for details in errors:
        place = details["loc"]
        if details["type"] == "missing" and place[:-1] in misspelt:
            continue
        if place[:1] == ("figures",) and len(place) > 2 and str(place[2]).startswith("fig10_"):
            place = place[:2] + place[3:]  # remove the value of `like`, which Pydantic inserts into the path
        place = place[:-1] if place[-1:] == ("[key]",) else place
        place += ("like",) if "discriminator" in details.get("ctx", {}) else ()
        found.setdefault(place, details)
    return found


def described(details: dict) -> str:
    """Return the text of a Pydantic error, such as "1.2 should be less than 1"."""
    kind, what, given = details["type"], details["msg"].removeprefix("Value error, "), details["input"]
    if kind == "extra_forbidden":
        key, keys = str(details["loc"][-1]), _keys(Section)
        colon = "; YAML needs a space after the colon" if ":" in key else ""
        return f"unknown key{hint(key, () if key in keys else keys)}{colon}"
    if kind in ("missing", "union_tag_not_found"):
        return "missing"
    if kind == "condition":
        return what
    if kind == "union_tag_invalid":
        given, what = details["ctx"]["tag"], f"should be {details['ctx']['expected_tags'].replace(', ', ' or ')}"
    known = re.findall(r"'([^']+)'", what) if kind in ("literal_error", "union_tag_invalid", "value_error") else []
    return f"{short_repr(given)} {re.sub('^[A-Z][a-z]+ (?=should )', '', what)}{hint(given, known)}"


def _keys(part) -> set[str]:
    """Return the keys of the section class `part` and of all classes that are derived from `part`."""
    return {*part.model_fields}.union(*map(_keys, part.__subclasses__()))


def hint(name, known: Iterable[str]) -> str:
    """Return ", did you mean ...?" with the most similar known name; return an empty text if no name is similar."""
    meant = difflib.get_close_matches(str(name), list(known), n=1)
    return f", did you mean {meant[0]!r}?" if meant else ""


def key_path(place: Place) -> str:
    """Return a key path as text, such as system.kappa or regimes.branches.paths[0]."""
    names = (f"[{part}]" if isinstance(part, int) else f".{short_repr(part, plain=True)}" for part in place)
    return "".join(names).removeprefix(".")


def short_repr(value, plain: bool = False) -> str:
    """Return a value on one line for an error message, with long texts shortened.

    If `plain` is True, a printable value has no quotes.
    """
    text = "null" if value is None else str(value) if plain and str(value).isprintable() else repr(value)
    return text if len(text) <= 120 else f"{text[:60]}...{text[-60:]}"
