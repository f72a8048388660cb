"""Read the SPEC of every figure from the source code, without importing the code.

A SPEC is a dictionary literal with these entries:

- title, caption, alt, equations: texts of the figure.
- own: texts for figures of your own that use the same drawing code.
- method: how the figure is computed.
- notebook: name of the notebook that explains the figure.
- sweeps: axes and observations that the figure needs from each sweep.
- columns: meaning, unit and allowed values of each column. The key "C1, C2" describes two columns. The entry `compared`
  selects a tolerance in tolerances.yaml, for the column or for each series. The entry `infinite` allows infinite
  values.
- file: path of the plotted table, if not the default.
- tables: file, description and columns of each further table.

The value of equations, columns or own may be the name of another figure, whose entry is then used.
"""

import ast
from functools import cache

from vibroimpact_pipeline.cases import case_overrides
from vibroimpact_pipeline.code import SOURCES, modules

SHARED = "own", "equations", "columns"
"""Entries of a SPEC that may be given as the name of another figure that has this entry."""
PACKAGES = "vibroimpact.figures", "vibroimpact.studies.figures"
"""Packages of figures; the second is missing without the studies."""


@cache
def specs() -> dict[str, dict]:
    """Return the SPEC (description) of every figure by name.

    The key "csv" in `tables` stands for the plotted table.
    """
    found = {}
    for path in sorted(path for package in PACKAGES for path in (SOURCES / package.replace(".", "/")).glob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "SPEC":
                found[path.stem] = ast.literal_eval(node.value)
    complete = {}
    for figure, spec in found.items():
        others = {name: spec[name] for name in SHARED if isinstance(spec.get(name), str)}
        shared = {name: found[others[name]][name] if name in others else spec.get(name) for name in SHARED}
        file = spec.get("file", f"results/figures/{figure}.csv")
        plotted = {"file": file, "about": f"{spec['title']}.", "columns": shared.pop("columns")}
        tables = ({"csv": plotted} if plotted["columns"] else {}) | spec.get("tables", {})
        entries = {name: entry for name, entry in spec.items() if name not in ("columns", "file")}
        entries["shares"] = sorted({*others.values()})
        complete[figure] = entries | {name: entry or {} for name, entry in shared.items()} | {"tables": tables}
    return complete


def module_of(figure: str) -> str:
    """Return the full name of the Python module that draws a figure."""
    return next(name for package in PACKAGES if (name := f"{package}.{figure}") in modules())


def spec_of(figure: str, scene: dict, known: dict) -> dict:
    """Return the SPEC (description) of a figure, including its drawing module.

    If the config entry `scene` has the key "like", return the SPEC of that figure with the texts in "own".
    """
    module = scene.get("like", figure)
    if module == figure:
        return known[figure] | {"module": module_of(module)}
    own = known[module]["own"]
    tables = {
        name: table | {"file": table["file"].replace(f"/{module}.", f"/{figure}.")}
        for name, table in known[module]["tables"].items()
    }
    if "csv" in tables:
        tables["csv"]["about"] = f"{own['title'].format_map(scene)}."
    return known[module] | own | {"tables": tables, "module": module_of(module)}


def with_model(caption: str, scene: dict) -> str:
    """Return a caption, followed by the model of the figure if this is exact_orbit or second_term."""
    other = scene.get("model") in ("exact_orbit", "second_term")
    return f"{caption} Drawn with the model *{scene['model'].replace('_', ' ')}*." if other else caption


def at(config: dict, path: str):
    """Return the entry of a config at "section.key".

    Raises
    ------
    LookupError
        If there is no such entry.
    """
    for key in path.split("."):
        config = config[key]
    return config


def case_parameters(config: dict, case: str) -> dict:
    """Return the parameters of System for a case: those of `system`, overridden by the case."""
    return config["system"] | case_overrides(config, case)


def columns(table: dict, shared: dict) -> dict[str, dict]:
    """Return the columns of a table by name, with missing entries taken from `shared`."""
    return {name: shared.get(name, {}) | entry for name, entry in each(table["columns"]).items()}


def each(listed: dict) -> dict:
    """Return a copy of a mapping in which a key "C1, C2" becomes two keys."""
    return {name: entry or {} for names, entry in listed.items() for name in names.split(", ")}
