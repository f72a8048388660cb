"""The figure check as one HTML page that reads offline: reference, new, difference and numbers of every figure."""

import base64
from pathlib import Path

from jinja2 import Environment

from vibroimpact_pipeline.figure_check import pictures
from vibroimpact_pipeline.figure_check.compare import UNREADABLE, largest, lines
from vibroimpact_pipeline.figure_check.tables import UNITS
from vibroimpact_pipeline.report.policy import guarded

TEMPLATE = Path(__file__).with_name("page.html.j2")
SHRINK = 2
"""The page shows squares of 2 by 2 pixels as one: 300 dots per inch of the printed figure."""


def page(verdicts: list[dict], reference, new, limits: dict) -> str:
    """The page for the verdicts of `figure_check.check_all` on the same folders."""
    template = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True).from_string(
        TEMPLATE.read_text(encoding="utf-8")
    )
    return guarded(
        template.render(
            verdicts=verdicts,
            said=lines(verdicts),
            pictures={verdict["figure"]: _pictures(verdict["figure"], reference, new) for verdict in verdicts},
            largest={verdict["figure"]: largest(verdict) for verdict in verdicts},
            limits=limits,
            units=UNITS,
        )
    )


def _pictures(figure, reference, new):
    """The pictures there are, as data: addresses, by what they show."""
    found = {}
    for name, folder in (("reference", reference), ("new", new)):
        try:
            found[name] = pictures.grey(Path(folder) / f"{figure}.png")
        except UNREADABLE:
            continue  # the verdict says so
    shown = {name: pictures.squares(picture, SHRINK) for name, picture in found.items()}
    if len(found) == 2 and found["reference"].shape == found["new"].shape:
        shown["difference"] = pictures.overlay(found["reference"], found["new"], SHRINK)
    return {name: _address(picture) for name, picture in shown.items()}


def _address(picture):
    return "data:image/png;base64," + base64.b64encode(pictures.png(picture)).decode()
