"""What is said of each figure and table, as report/figures.yaml has it: title, caption, alternative text, equations."""

import re
from collections.abc import Callable
from pathlib import Path

import yaml

from vibroimpact_pipeline.chapter import as_in_the_chapter

SAID = {"title": str, "caption": lambda text: re.sub(r"([^\w\s])", r"\\\1", text), "alt": str}
"""What is said of a figure, and how a text is written there as it is: titles are plain, captions reStructuredText."""
OWN = "own_"
"""Begins the names of cards for figures that have none of their own."""


def figure_texts(root, config: dict) -> dict[str, dict]:
    """The entries by name, with the numbers they ask for: {f10_hat}, say, of the case that the figure shows.

    A figure of the config without an entry of its own has that of its notebook, an animation the one for animations; so
    has a figure of the chapter in a config where it shows other parameters than there.
    """
    texts = yaml.safe_load((Path(root) / "report/figures.yaml").read_text(encoding="utf-8"))
    scenes = config["figures"] | config["report"]["animations"] | {"force_sweep": config["report"]["force_sweep"]}
    for figure, scene in scenes.items():
        entry, heading = texts.get(figure), ""
        if figure.startswith("fig10_"):
            heading = f"Figure {int(figure[3:5])}.{int(figure[6:])}. "
            if not as_in_the_chapter(config, figure, scene):
                entry, heading = None, heading.replace(". ", " for other parameters. ")
        entry = entry or texts[OWN + scene.get("notebook", "animation")]
        known = scene | _parameters(config, scene) | {"figure": figure}
        tables = {_filled(name, known): table for name, table in entry.get("tables", {}).items()}
        texts[figure] = (
            entry | {name: _filled(entry[name], known, as_is) for name, as_is in SAID.items()} | {"tables": tables}
        )
        texts[figure]["title"] = heading + texts[figure]["title"]
    return {name: entry for name, entry in texts.items() if not name.startswith(OWN)}


def _parameters(config, scene):
    case = config["cases"].get(scene.get("case"), {})
    return config["system"] | {name: value for name, value in case.items() if name != "simulation"}


def _filled(text, known, as_is: Callable[[str], str] = str):
    """The text with {name} replaced where the name is known; other braces belong to formulas."""

    def value(name):
        given = known.get(name[1], name[0])
        return as_is(given) if isinstance(given, str) and name[1] in known else str(given)

    return re.sub(r"\{(\w+)\}", value, text)
