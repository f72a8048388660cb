"""What is wrong with a config, as Pydantic finds it, in words that say what was given and what is allowed."""

import difflib
import math
import re
from collections.abc import Callable

from pydantic import ValidationError

from vibroimpact_pipeline.config.fields import WORDS
from vibroimpact_pipeline.config.section import Place, Problem
from vibroimpact_pipeline.config.text import limit, show

MISSING = "missing"
PHRASES = {
    "greater_than": "{} is not above {gt}",
    "greater_than_equal": "{} is below {ge}",
    "less_than": "{} is not below {lt}",
    "less_than_equal": "{} is above {le}",
    "multiple_of": "{} is not a multiple of {multiple_of}",
    "finite_number": "{} is not finite",
    "string_pattern_mismatch": "{} is not {words}",
    "missing": MISSING,
    "invalid_key": "{} is not text",
    "condition": "{what}",
}
KINDS = {
    "float_type": "a number",
    "int_type": "a whole number",
    "string_type": "text",
    "list_type": "a list",
    "tuple_type": "a list",
    "dict_type": "a mapping",
    "model_type": "a mapping",
    "model_attributes_type": "a mapping",
}


def problems_of(error: ValidationError, given, known: Callable = lambda place: ()) -> list[Problem]:
    """Everything that Pydantic found wrong with the given values, each with its place in them.

    known: the keys that the section at a place may have. A misspelt key is one problem, not a missing one besides.
    """
    found = {}
    misspelt = set()
    for details in error.errors(include_url=False):
        place = _place(details["loc"], given)
        if details["type"] == "extra_forbidden":
            *section, key = place
            meant = nearest(key, known(section))
            misspelt.add((*section, meant))
            found[place] = f"unknown key{_question(meant)}{_colon(key)}"
        else:
            more, what = _described(details)
            found[(*place, *more)] = what
    return [Problem(place, what) for place, what in found.items() if what != MISSING or place not in misspelt]


def nearest(name, known) -> str | None:
    """The known name that is most like a given one, if any is."""
    return next(iter(difflib.get_close_matches(str(name), list(known), n=1)), None)


def hint(name, known) -> str:
    """A question whether something known was meant."""
    return _question(nearest(name, known))


def _question(meant):
    return f", did you mean '{meant}'?" if meant else ""


def _colon(key):
    return "; a space belongs after a colon" if ":" in str(key) else ""


def _described(details) -> Problem:
    """What is wrong, and the way to it from the place of the error."""
    kind, value, about = details["type"], details["input"], details.get("ctx", {})
    if kind in KINDS:
        return Problem((), f"{show(value)} is {_not(KINDS[kind], value)}")
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        return Problem((about["discriminator"].strip("'"),), _variant(**about))
    if kind == "literal_error":
        return Problem((), f"{show(value)} is not {_either(about['expected'], value)}")
    if kind in ("too_short", "too_long"):
        return Problem((), _length(len(value), **about))
    if kind not in PHRASES:
        return Problem((), details["msg"])
    words = {"words": WORDS.get(about.get("pattern"))} | {name: limit(value) for name, value in about.items()}
    return Problem((), PHRASES[kind].format(show(value), **words))


def _variant(tag=None, expected_tags="", **_):
    return MISSING if tag is None else f"{show(tag)} is not {_either(expected_tags, tag)}"


def _either(expected, given):
    """The names in a list that Pydantic writes."""
    names = re.findall(r"'([^']+)'", expected)
    *others, last = map(repr, names)
    return f"{', '.join(others)} or {last}{hint(given, names)}" if others else last


def _length(length, min_length=None, max_length=None, **_):
    if not length:
        return "is empty"
    has = f"has {length} {'entry' if length == 1 else 'entries'}"
    return f"{has}, more than {max_length}" if max_length is not None else f"{has}, fewer than {min_length}"


def _not(kind, value):
    """That a value is not of a kind, and how to write it if it is a number that YAML takes for text."""
    if kind == "a number" and isinstance(value, int) and not isinstance(value, bool):
        return "too large"
    return f"not {kind}{_as_number(kind, value)}"


def _as_number(kind, value):
    """How to write a number that YAML takes for text."""
    try:
        number = float(value) if isinstance(value, str) else math.nan
    except ValueError:
        number = math.nan
    if kind == "a number" and math.isfinite(number):
        return f" (write {show(number)})"
    whole = number.is_integer() and abs(number) < 1e15
    return f" (write {int(number)})" if kind == "a whole number" and whole else ""


def _place(loc, given) -> Place:
    """The place of an error without what Pydantic adds to it: names of variants, and a mark at keys."""
    place = []
    for last, part in zip([*[False] * (len(loc) - 1), True], loc, strict=False):
        if part in (given if isinstance(given, dict) else range(len(given)) if isinstance(given, list) else ()):
            given = given[part]
        elif not last or part == "[key]":
            continue
        place.append(part)
    return tuple(place)
