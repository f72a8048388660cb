"""Read the SPEC of every figure from the source without importing it. Standard library only.

A SPEC is a literal with these entries. The rule of the figure in workflow/rules/ lists the inputs and settings.

- title, caption, alt, equations: texts of the figure. own: the same texts for figures of your own that use its drawing
  code. method: how it is computed. notebook: name of the notebook that explains it, if it has a page.
- sweeps: sweeps that the figure draws: their axes, and the observations that it needs.
- columns: columns of the plotted table: meaning, unit, allowed values, `compared` (a kind of
  figure_check/tolerances.yaml, or kinds by series) and `infinite` if infinite values are allowed. file: path of the
  table, if not the default. on_demand: command that makes the table, if the default build does not.
- tables: further tables that `compute` returns, by name: file, description and columns.

The entries equations, columns and own may be the name of a figure with the same entry. The key "C1, C2" describes both
columns.
"""

import ast
from functools import cache
from pathlib import Path

from vibroimpact_pipeline.cases import case_overrides
from vibroimpact_pipeline.code import SOURCES, modules

SHARED = "own", "equations", "columns"
"""Entries of a SPEC that may be the name of a figure with the same entry."""
PACKAGES = "vibroimpact.figures", "vibroimpact.studies.figures"
"""Packages of figures; the second may be missing."""


@cache
def specs(root=None) -> dict[str, dict]:
    """Return the SPEC of every figure, of the checkout `root` if given; the plotted table is named "csv"."""
    found = {}
    top = Path(root, "src") if root else SOURCES
    for path in sorted(path for package in PACKAGES for path in (top / package.replace(".", "/")).glob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "SPEC":
                found[path.stem] = ast.literal_eval(node.value)
    complete = {}
    for figure, spec in found.items():
        shared = {
            name: found[spec[name]][name] if isinstance(spec.get(name), str) else spec.get(name) for name in SHARED
        }
        file = spec.get("file", f"results/figures/{figure}.csv")
        plotted = {"file": file, "about": f"{spec['title']}.", "columns": shared.pop("columns")}
        if "on_demand" in spec:
            plotted["on_demand"] = {file: spec["on_demand"]}
        tables = ({"csv": plotted} if plotted["columns"] else {}) | spec.get("tables", {})
        entries = {name: entry for name, entry in spec.items() if name not in ("columns", "file")}
        entries["shares"] = sorted({spec[name] for name in SHARED if isinstance(spec.get(name), str)})
        complete[figure] = entries | {name: entry or {} for name, entry in shared.items()} | {"tables": tables}
    return complete


def module_of(figure: str) -> str:
    """Return the full name of the module of a figure."""
    return next(name for package in PACKAGES if (name := f"{package}.{figure}") in modules())


def spec_of(figure: str, scene: dict, known: dict) -> dict:
    """Return the SPEC of a figure with its full "module"; a figure of your own gets its own texts and files."""
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
    """Return the caption of a figure, followed by the name of its model unless this is the default of the chapter."""
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
    """Return the parameters of System for a case: those of `system`, overridden by those of the case."""
    return config["system"] | case_overrides(config, case)


def columns(table: dict, shared: dict) -> dict[str, dict]:
    """Return the columns of a table by single name, with shared meanings and units filled in."""
    return {name: shared.get(name, {}) | entry for name, entry in each(table["columns"]).items()}


def each(listed: dict) -> dict:
    """Return entries by single name; the key "C1, C2" is split into two."""
    return {name: entry or {} for names, entry in listed.items() for name in names.split(", ")}
