"""What is wrong with a config, as Pydantic finds it, in words that say what was given and what is allowed."""

import difflib
import math
from collections.abc import Callable

from pydantic import ValidationError

from vibroimpact_pipeline.config.fields import WORDS
from vibroimpact_pipeline.config.section import Place, Problem
from vibroimpact_pipeline.config.text import show

MISSING = "missing"
PHRASES = {
    "greater_than": "{} is not above {gt:.15g}",
    "greater_than_equal": "{} is below {ge:.15g}",
    "less_than": "{} is not below {lt:.15g}",
    "less_than_equal": "{} is above {le:.15g}",
    "multiple_of": "{} is not a multiple of {multiple_of:.15g}",
    "finite_number": "{} is not finite",
    "literal_error": "{} is not {expected}",
    "string_pattern_mismatch": "{} is not {words}",
    "too_short": "has {actual_length} entries, fewer than {min_length}",
    "too_long": "has {actual_length} entries, more than {max_length}",
    "missing": MISSING,
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
            misspelt.add((*section, nearest(key, known(section))))
            found[place] = f"unknown key{hint(key, known(section))}"
        else:
            more, what = _described(details)
            found[(*place, *more)] = what
    return [Problem(place, what) for place, what in found.items() if what != MISSING or place not in misspelt]


def nearest(name, known) -> str | None:
    """The known name that is most like a given one, if any is."""
    return next(iter(difflib.get_close_matches(str(name), list(known), n=1)), None)


def hint(name, known) -> str:
    """A question whether something known was meant."""
    meant = nearest(name, known)
    return f", did you mean '{meant}'?" if meant else ""


def _described(details) -> Problem:
    """What is wrong, and the way to it from the place of the error."""
    kind, value, about = details["type"], details["input"], details.get("ctx", {})
    if kind in KINDS:
        return Problem((), f"{show(value)} is {_not(KINDS[kind], value)}")
    if kind == "union_tag_not_found":
        return Problem((about["discriminator"].strip("'"),), MISSING)
    if kind == "union_tag_invalid":
        return Problem((about["discriminator"].strip("'"),), f"{show(about['tag'])} is not {about['expected_tags']}")
    if kind in ("too_short", "too_long") and not about["actual_length"]:
        return Problem((), "is empty")
    if kind not in PHRASES:
        return Problem((), details["msg"])
    return Problem((), PHRASES[kind].format(show(value), words=WORDS.get(about.get("pattern")), **about))


def _not(kind, value):
    """That a value is not of a kind, and how to write it if it is a number that YAML takes for text."""
    if kind == "a number" and isinstance(value, int) and not isinstance(value, bool):
        return "too large"
    try:
        number = float(value) if isinstance(value, str) else math.nan
    except ValueError:
        number = math.nan
    return f"not {kind} (write {number!r})" if math.isfinite(number) and "number" in kind else f"not {kind}"


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
