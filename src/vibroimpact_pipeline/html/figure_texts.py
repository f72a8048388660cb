"""Insert config values into the texts of each figure: title, caption and alternative text."""

import re
from collections.abc import Callable

from vibroimpact.system.chapter import CASES, PARAMETERS
from vibroimpact_pipeline.cases import title_of
from vibroimpact_pipeline.chapter import CASE_OF
from vibroimpact_pipeline.data_dictionary import read
from vibroimpact_pipeline.specs import case_parameters, spec_of, specs, with_model

TEXTS = {"title": str, "caption": lambda text: re.sub(r"([^\w\s])", r"\\\1", text), "alt": str}
"""For each text of a figure, the function that escapes inserted values; captions are reStructuredText."""


def figure_texts(config: dict) -> dict[str, dict]:
    """Return the SPEC (description) of every figure by name, with config values in its texts (see `words`)."""
    known, data = read()
    texts = {name: spec for name, spec in known.items() if not name.startswith("fig10_")}
    for figure, scene in config["figures"].items():
        case = scene.get("case")
        known_case = case in config["cases"]
        named = scene | ({"case": title_of(config, case)} if known_case else {})
        texts[figure] = words(figure, named, case_parameters(config, case) if known_case else config["system"])
    return texts | data["captions"]


def words(figure: str, scene: dict, parameters: dict) -> dict:
    """Return the SPEC (description) of a figure, with values in place of placeholders such as {f10_hat}.

    `scene` is the config entry of the figure, and `parameters` are the parameters of its system. If a figure of the
    chapter has other parameters than in the chapter, its texts are taken from the entry `own` of its SPEC.
    """
    known = specs()
    spec = spec_of(figure, scene, known)
    heading = ""
    if figure.startswith("fig10_"):
        heading = f"Figure {int(figure[3:5])}.{int(figure[6:])}. "
        if figure in CASE_OF and parameters != PARAMETERS | CASES[CASE_OF[figure]]:
            spec, heading = spec | spec["own"], heading.replace(". ", " for other parameters. ")
    spec = spec | {"caption": with_model(spec["caption"], scene)}
    texts = {name: _filled(spec[name], scene | parameters, escape) for name, escape in TEXTS.items()}
    return spec | texts | {"title": heading + texts["title"]}


def _filled(text, known, escape: Callable[[str], str]):
    """Return a text in which each placeholder {name} is replaced by the value of the name in `known`.

    Braces around an unknown name belong to a formula and are kept. `escape` escapes values that are texts.
    """

    def value(name):
        given = known.get(name[1], name[0])
        return escape(given) if isinstance(given, str) and name[1] in known else str(given)

    return re.sub(r"\{(\w+)\}", value, text)
