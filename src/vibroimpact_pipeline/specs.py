"""The SPEC of every figure, read from the source without importing it. Standard library only.

A SPEC is a literal with these entries; what the figure is computed from says its rule, in workflow/rules/.

- title, caption, alt, equations: what is written of the figure; own: the same words for a figure of the config that is
  drawn likewise. method: how it is computed. notebook: the one that explains it, if it has a page.
- sweeps: of sweeps that it draws what they move along each axis, and observe.
- columns: of the table that is plotted: meaning, unit, values, how the figure check compares them (kinds of
  figure_check/tolerances.yaml, by series where they differ), infinite if they may be. file: that table, if elsewhere;
  on_demand: the command that makes it, if a plain build does not.
- tables: what else `compute` returns, by name its file, what it is about, and its columns.

Equations, columns or own words may be the name of a figure that has the same. A column may stand for several, "C1, C2".
"""

import ast
from functools import cache
from pathlib import Path

from vibroimpact_pipeline.cases import own_parameters
from vibroimpact_pipeline.code import SOURCES, modules

SHARED = "own", "equations", "columns"
"""Entries of a SPEC that may name a figure which has the same."""
PACKAGES = "vibroimpact.figures", "vibroimpact.studies.figures"
"""Packages of figures; a checkout may lack the second."""


@cache
def specs(root=None) -> dict[str, dict]:
    """Return SPEC by figure for all modules of figures, of a checkout if given; the plotted table is "csv"."""
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
        own = {name: entry for name, entry in spec.items() if name not in ("columns", "file")}
        own["shares"] = sorted({spec[name] for name in SHARED if isinstance(spec.get(name), str)})
        complete[figure] = own | {name: entry or {} for name, entry in shared.items()} | {"tables": tables}
    return complete


def module_of(figure: str) -> str:
    """Return the full name of the module of a figure."""
    return next(name for package in PACKAGES if (name := f"{package}.{figure}") in modules())


def spec_of(figure: str, scene: dict, known: dict) -> dict:
    """Return the SPEC of a figure and its "module" in full; where that is another figure's, the own words and files."""
    module = scene.get("like", figure)
    if module == figure:
        return known[figure] | {"module": module_of(module)}
    own = known[module]["own"]
    tables = {
        name: table | {"file": table["file"].replace(f"/{module}.", f"/{figure}.")}
        for name, table in known[module]["tables"].items()
    }
    tables["csv"]["about"] = f"{own['title'].format_map(scene)}."
    return known[module] | own | {"tables": tables, "module": module_of(module)}


def with_model(caption: str, scene: dict) -> str:
    """Return the caption of a figure, and behind it the name of the model of its scene if that is not the chapter's."""
    other = scene.get("model") in ("exact_orbit", "second_term")
    return f"{caption} Drawn with the model *{scene['model'].replace('_', ' ')}*." if other else caption


def at(config: dict, path: str):
    """Return the entry of a config at "section.key".

    Raises:
        LookupError: there is none.
    """
    for key in path.split("."):
        config = config[key]
    return config


def case_parameters(config: dict, case: str) -> dict:
    """Return the parameters of System for one case: those of `system`, and over them the case's own."""
    return config["system"] | own_parameters(config, case)


def columns(table: dict, shared: dict) -> dict[str, dict]:
    """Return the columns of a table one by one, with the meaning and unit shared by all tables filled in."""
    return {name: shared.get(name, {}) | entry for name, entry in each(table["columns"]).items()}


def each(listed: dict) -> dict:
    """Return entries by single name; the key "C1, C2" stands for both."""
    return {name: entry or {} for names, entry in listed.items() for name in names.split(", ")}
