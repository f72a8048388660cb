"""What is said of each figure and table: title, caption, alternative text, equations, tables."""

import re
from collections.abc import Callable

from vibroimpact.figures.specs import spec_of
from vibroimpact_pipeline.chapter import as_in_the_chapter
from vibroimpact_pipeline.data_dictionary import read

SAID = {"title": str, "caption": lambda text: re.sub(r"([^\w\s])", r"\\\1", text), "alt": str}
"""What is said of a figure, and how a text is written there as it is: titles are plain, captions reStructuredText."""


def figure_texts(root, config: dict) -> dict[str, dict]:
    """SPEC by name, with the numbers its words ask for: {f10_hat}, say, of the case that the figure shows.

    A figure of the chapter that shows other parameters than there has the words for figures of one's own.
    """
    known, data = read(root)
    animation = known.pop("animation")
    scenes = config["figures"] | config["report"]["animations"] | {"force_sweep": config["report"]["force_sweep"]}
    texts = {name: spec for name, spec in known.items() if not name.startswith("fig10_")}
    for figure, scene in scenes.items():
        spec, heading = spec_of(figure, scene, known) if figure in known or "notebook" in scene else animation, ""
        if figure.startswith("fig10_"):
            heading = f"Figure {int(figure[3:5])}.{int(figure[6:])}. "
            if not as_in_the_chapter(config, figure, scene):
                spec, heading = spec | spec["own"], heading.replace(". ", " for other parameters. ")
        numbers = scene | _parameters(config, scene)
        texts[figure] = spec | {name: _filled(spec[name], numbers, as_is) for name, as_is in SAID.items()}
        texts[figure]["title"] = heading + texts[figure]["title"]
    return texts | data["captions"]


def _parameters(config, scene):
    case = config["cases"].get(scene.get("case"), {})
    return config["system"] | {name: value for name, value in case.items() if name != "simulation"}


def _filled(text, known, as_is: Callable[[str], str]):
    """The text with {name} replaced where the name is known; other braces belong to formulas."""

    def value(name):
        given = known.get(name[1], name[0])
        return as_is(given) if isinstance(given, str) and name[1] in known else str(given)

    return re.sub(r"\{(\w+)\}", value, text)
