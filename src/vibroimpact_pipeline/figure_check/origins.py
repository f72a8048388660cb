"""On what machines the figures of a reference set were computed: on another such machine they come out the same."""

import json
from pathlib import Path

from vibroimpact.figures.kit.files import replacing

FILE = "rounded_by.json"
"""Of a reference set: what rounded, by figure; see `provenance.rounding`."""


def same_rounding(figure: str, reference, new) -> bool:
    """Whether the same processor and versions computed a figure and its reference; False where one does not say."""
    before = read(reference).get(figure)
    return bool(before) and before == of_build(figure, new)


def read(reference) -> dict[str, dict]:
    """What rounded, by figure; empty where nothing, or nothing legible, is said."""
    return _json(Path(reference) / FILE)


def of_build(figure: str, folder) -> dict:
    """What rounded in a figure of a build, from its sidecar; empty where that does not say."""
    return _json(Path(folder) / f"{figure}.provenance.json").get("rounded by", {})


def take(figure: str, new, reference) -> None:
    """Note in the reference set what rounded in a figure of a build; forget a figure of which nothing is known."""
    known = {name: entry for name, entry in read(reference).items() if name != figure}
    if found := of_build(figure, new):
        known[figure] = found
    with replacing(Path(reference) / FILE) as partial:
        partial.write_text(json.dumps(dict(sorted(known.items())), indent=1) + "\n", encoding="utf-8")


def _json(path):
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}
