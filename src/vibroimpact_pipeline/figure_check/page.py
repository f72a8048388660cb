"""The figure check as one HTML page that reads offline: reference, new, difference and numbers of every figure."""

import base64
from pathlib import Path

import numpy as np
from jinja2 import Environment

from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.drawings import WHAT
from vibroimpact_pipeline.figure_check.tables import UNITS
from vibroimpact_pipeline.figure_check.verdicts import OTHER_VERSIONS, PASSED, by_distance, command, largest, lines
from vibroimpact_pipeline.report.policy import guarded

TEMPLATE = Path(__file__).with_name("page.html.j2")
EFFORT = 4
"""Time spent on making pictures small, 0 to 9."""
SHRINK = 2
"""The page shows squares of 2 by 2 pixels as one: 300 dots per inch of the printed figure."""


def page(verdicts: list[dict], addresses: dict[str, dict], limits: dict) -> str:
    """The page for verdicts of the figure check, what is farthest off first.

    addresses: of the pictures of each figure, see `shown`.
    """
    template = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True).from_string(
        TEMPLATE.read_text(encoding="utf-8")
    )
    return guarded(
        template.render(
            verdicts=by_distance(verdicts),
            commands={verdict["figure"]: command([verdict["figure"]]) for verdict in verdicts},
            command=command([verdict["figure"] for verdict in verdicts if verdict["status"] != PASSED]),
            other_versions=OTHER_VERSIONS,
            files=WHAT,
            said=lines(verdicts),
            pictures=addresses,
            largest={verdict["figure"]: largest(verdict) for verdict in verdicts},
            limits=limits,
            units=UNITS,
        )
    )


def shown(figure: str, reference, new) -> dict[str, str]:
    """The pictures there are of a figure, as data: addresses, by what they show; no difference where no pixel differs.

    reference, new: folders, as of `compare.check`.
    """
    found = {}
    for name, folder in (("reference", reference), ("new", new)):
        try:
            found[name] = pictures.colours(Path(folder) / f"{figure}.png")
        except Exception:
            continue  # the verdict says so, whatever the library has raised
    if len(found) == 2 and np.array_equal(*found.values()):
        return dict.fromkeys(found, _address(pictures.smaller(found["new"], SHRINK)))
    addresses = {name: _address(pictures.smaller(picture, SHRINK)) for name, picture in found.items()}
    if len(found) == 2 and found["reference"].shape[:2] == found["new"].shape[:2]:
        addresses["difference"] = _address(pictures.overlay(found["reference"], found["new"], SHRINK))
    return addresses


def _address(picture):
    return "data:image/png;base64," + base64.b64encode(pictures.png(picture, effort=EFFORT)).decode()
