"""Differences between two descriptions of what a figure shows; see `vibroimpact.figures.kit.artists`."""

from dataclasses import dataclass
from itertools import zip_longest

MISSING = "nothing"
LONGEST = 100
"""Letters of an entry that are shown."""
PLACES = "points", "from", "to", "box"


@dataclass(frozen=True)
class Difference:
    """One entry that differs: where it is, what it was and is, and how far numbers are apart (else infinity)."""

    where: str
    reference: object
    new: object
    share: float

    def __str__(self):
        return f"{self.where}: {_show(self.new)} instead of {_show(self.reference)}"


def differences(reference, new, where: str = "figure") -> list[Difference]:
    """All entries that differ at all, in reading order.

    Numbers differ by their distance, for axis limits as a share of the axis; everything else by infinity.
    """
    if isinstance(reference, dict) and isinstance(new, dict):
        names = list(dict.fromkeys([*reference, *new]))
        return [
            found
            for name in names
            for found in _entry(reference.get(name, MISSING), new.get(name, MISSING), f"{where}, {name}", name)
        ]
    if isinstance(reference, list) and isinstance(new, list):
        return _lists(reference, new, where)
    if _is_number(reference) and _is_number(new):
        return [Difference(where, reference, new, abs(new - reference))] if new != reference else []
    return [Difference(where, reference, new, float("inf"))] if new != reference else []


SHOWN = "lines", "patches", "collections", "texts", "others"
"""What a part of a description holds that can be seen."""


def nothing_shown(artists) -> list[str]:
    """Why a description says nothing, whatever its reference says: one line, or none.

    Raises:
        ValueError: it is no description.
    """
    if not isinstance(artists, dict) or not {"drawn with", "background", "axes"} <= artists.keys():
        raise ValueError(f"no description of a figure: {str(artists)[:60]}")
    seen = [part.get(kind) for part in (artists, *artists["axes"]) for kind in SHOWN]
    return [] if any(seen) else ["artists: none in any axes"]


def without_places(artists: dict, names) -> dict:
    """A description without the places of the artists so named, wherever these follow from a table alone."""

    def stripped(entry):
        if isinstance(entry, list):
            return [stripped(part) for part in entry]
        if not isinstance(entry, dict):
            return entry
        left_out = PLACES if entry.get("name") in names else ()
        return {name: stripped(part) for name, part in entry.items() if name not in left_out}

    return stripped(artists)


def _entry(reference, new, where, name):
    if name in ("xlim", "ylim") and reference != MISSING != new:
        shift = max(abs(a - b) for a, b in zip(reference, new, strict=True))
        share = shift / abs(reference[1] - reference[0])
        return [Difference(where, reference, new, share)] if shift else []
    return differences(reference, new, where)


def _lists(reference, new, where):
    if len(reference) != len(new):
        return [Difference(where, _summary(reference), _summary(new), float("inf"))]
    pairs = enumerate(zip_longest(reference, new), start=1)
    return [found for index, (a, b) in pairs for found in differences(a, b, f"{where} {index}{_called(a)}")]


def _called(entry):
    """The name of an artist, so that a reader finds it in the figure."""
    name = isinstance(entry, dict) and (entry.get("name") or entry.get("text"))
    return f" ({name})" if name else ""


def _summary(entries):
    if any(isinstance(entry, dict) for entry in entries):
        names = [entry.get("name") or entry.get("text") or "unnamed" for entry in entries]
        return f"{len(entries)} ({', '.join(names)})"
    return entries or MISSING


def _show(value):
    if value is None or value == MISSING:
        return MISSING
    if isinstance(value, list) and all(isinstance(entry, dict) for entry in value):
        return _cut(str(_summary(value)))
    return _cut(str(value))


def _cut(text):
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)
