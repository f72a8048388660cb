"""Read the SPEC of every figure from the source code, without importing the code.

A SPEC is a dictionary literal with these entries:

- title, caption, alt, equations: texts of the figure.
- own: texts for further figures that users define in the config and that the code of this figure draws.
- method: how the figure is computed.
- notebook: name of the notebook that explains the figure.
- sweeps: for each sweep that the figure draws, the axes and observations that the figure needs.
- columns: meaning, unit and allowed values of each column of the plotted table. The key "C1, C2" describes the two
  columns C1 and C2. If a column has the entry `compared`, the entry selects a tolerance in tolerances.yaml. It selects
  one tolerance for the whole column, or one for each series. If a column has the entry `infinite`, infinite values
  are allowed.
- file: path of the plotted table; default: results/figures/<name of the figure>.csv.
- tables: file, description and columns of each further table.

If the value of equations, columns or own is the name of another figure, the entry of the other figure is used.
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

    In the entry `tables` of a SPEC, the key "csv" stands for the plotted table.
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

    `scene` is the config entry of the figure. If `scene` has the key "like", the result is the SPEC of the figure that
    "like" names, with two changes. The texts are those of the entry "own" of this SPEC. In the paths of tables, the
    name of the other figure is replaced by `figure`.
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
    """Return a caption; if the model of the figure is exact_orbit or second_term, append the name of the model."""
    other = scene.get("model") in ("exact_orbit", "second_term")
    return f"{caption} Drawn with the model *{scene['model'].replace('_', ' ')}*." if other else caption


def at(config: dict, path: str):
    """Return the entry of a config at a key path such as "section.key".

    Raises
    ------
    LookupError
        If there is no such entry.
    """
    for key in path.split("."):
        config = config[key]
    return config


def case_parameters(config: dict, case: str) -> dict:
    """Return the parameters of System for a case. Values of the case replace values of the section `system`."""
    return config["system"] | case_overrides(config, case)


def columns(table: dict, shared: dict) -> dict[str, dict]:
    """Return the description of each column of a table by name.

    If the description of a column lacks an entry, such as the unit, the entry is taken from `shared`.
    """
    return {name: shared.get(name, {}) | entry for name, entry in each(table["columns"]).items()}


def each(listed: dict) -> dict:
    """Return a copy of a mapping in which a key such as "C1, C2" is split into the two keys "C1" and "C2"."""
    return {name: entry or {} for names, entry in listed.items() for name in names.split(", ")}
