"""What verdicts of the figure check say: in lines, in a number, in an exit status."""

import math
from collections import Counter

PASSED, FAILED, NOT_COMPARABLE = "passed", "failed", "not comparable"
OTHER_VERSIONS = "pixels not compared: the reference was drawn by other versions of Matplotlib or FreeType"
REMEDY = (
    "Pixels are comparable with the versions that drew the reference, those of environment.lock. After an upgrade on "
    'purpose: make accept PICTURES=1 REASON="why", which refuses where a number or an artist has moved.'
)


def measured(verdict: dict) -> list[dict]:
    """Everything of a verdict that has a distance from the reference and a limit; PDF and SVG have none to be near."""
    pixels = [entry for entry in verdict["picture"].get("measures", []) if entry["file"] == "png"]
    entries = [*verdict["tables"], verdict["artists"], *pixels]
    return [entry for entry in entries if entry.get("limit") is not None]


def largest(verdict: dict) -> float | None:
    """The largest distance of a figure as a share of its limit; None if one is infinite or could not be taken."""
    shares = [None if entry["distance"] is None else _share(entry) for entry in measured(verdict)]
    return None if not shares or None in shares else max(shares)


def _share(entry):
    return entry["distance"] / entry["limit"] if entry["distance"] else 0.0


def by_distance(verdicts: list[dict]) -> list[dict]:
    """Verdicts with what needs to be looked at first: failures, then by distance over limit, then by name."""
    order = [FAILED, NOT_COMPARABLE, PASSED]

    def place(verdict):
        far = largest(verdict)
        return order.index(verdict["status"]), -math.inf if far is None else -far, verdict["figure"]

    return sorted(verdicts, key=place)


def command(figures) -> str:
    """What accepts figures as they are now."""
    return f'make accept REASON="why" FIGURES="{" ".join(figures)}"'


def lines(verdicts: list[dict]) -> list[str]:
    """One line per figure that did not pass, with its first reason, and a last line that sums up."""
    said = []
    for verdict in verdicts:
        first, *more = verdict["reasons"] or [OTHER_VERSIONS]
        if verdict["status"] != PASSED:
            rest = f" (and {len(more)} more)" if more else ""
            said.append(f"{verdict['figure']}: {verdict['status']}: {first}{rest}")
    counts = Counter(verdict["status"] for verdict in verdicts)
    shares = [share for share in map(largest, verdicts) if share is not None]
    closest = f"; largest distance {max(shares):.2g} of its limit" if shares else ""
    return [*said, f"{len(verdicts)} figures: " + ", ".join(f"{n} {status}" for status, n in counts.items()) + closest]


def has_failed(verdicts: list[dict], strict: bool = False) -> bool:
    """Whether any figure failed, or there was nothing to check.

    strict: whether a figure whose pixels could not be compared has failed too.
    """
    failures = (FAILED, NOT_COMPARABLE) if strict else (FAILED,)
    return not verdicts or any(verdict["status"] in failures for verdict in verdicts)
