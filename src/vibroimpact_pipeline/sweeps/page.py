"""The page of a sweep: what was asked, the picture, what failed, and the first rows of the table."""

import base64
from pathlib import Path

import pandas as pd
from jinja2 import Environment, StrictUndefined

from vibroimpact.sweeps.asked import FAILED
from vibroimpact_pipeline.report.policy import guarded
from vibroimpact_pipeline.sweeps.places import table_path
from vibroimpact_pipeline.sweeps.words import announced, axis_words

TEMPLATE = Path(__file__).with_name("page.html.j2")
SHOWN = 50
"""Rows of the table, and points that failed."""
KINDS = ("png", "pdf", "svg", "csv")


def page(name: str, request: dict, plan: dict, table: pd.DataFrame, svg: bytes) -> str:
    """The page as HTML that needs nothing but itself.

    Args:
        request: see `vibroimpact.sweeps.request`. plan: what `sweep_plan.py` wrote. svg: the picture.
    """
    asked, moved = request["asked"], [name for axis in request["axes"] for name in axis["along"]]
    failed = table[table[FAILED] != ""]
    axes = " and ".join(axis_words(axis) for axis in request["axes"])
    shown = table.head(SHOWN)
    template = Environment(autoescape=True, trim_blocks=True, undefined=StrictUndefined)
    return guarded(
        template.from_string(TEMPLATE.read_text(encoding="utf-8")).render(
            name=name,
            file=Path(table_path(name, request["axes"])).name,
            kinds=KINDS,
            said=announced(name, plan),
            picture="data:image/svg+xml;base64," + base64.b64encode(svg).decode(),
            alt=f"{', '.join(asked['observe'])} over {axes}; the numbers are in the table",
            asked=[("axes", axes), *((key, _plain(value)) for key, value in asked.items())],
            kept=[(key, value) for key, value in request["system"].items() if key not in moved],
            failed=list(failed[FAILED].items())[:SHOWN],
            points=len(table),
            columns=list(table),
            rows=shown.astype(object).where(shown.notna(), "").values.tolist(),
        )
    )


def _plain(value):
    return ", ".join(map(str, value)) if isinstance(value, list | tuple) else value
