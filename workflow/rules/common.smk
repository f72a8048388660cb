# What every stage needs: where the files are, the checked config, the code behind jobs, the figures' SPECs.

import importlib.util
import inspect
import json
import os
import re
import shlex
import sys
from pathlib import Path
from types import SimpleNamespace

from snakemake.exceptions import WorkflowError
from snakemake.utils import listfiles, validate

# Snakemake evaluates a module in a namespace of its own, under its name; since 9.27 the workflow itself under none.
IS_MODULE = __name__ not in ("snakemake.workflow", None)


def refuse(message):
    """End with a message in place of a traceback."""
    print(message, file=sys.stderr)
    sys.exit(1)


def own(path):
    """A file of the checkout: by its short path in the checkout itself, so that this can be moved."""
    return path if os.path.samefile(ROOT, ".") else str(ROOT / path)


# The library beside these rules, for jobs, too; where they come from a git source, it is the one that is installed.
SRC = Path(inspect.currentframe().f_code.co_filename).parents[2] / "src"
if SRC.is_dir():
    sys.path.insert(0, str(SRC))
elif importlib.util.find_spec("vibroimpact_pipeline") is None:
    refuse("Not installed: the pipeline of these rules. Install vibroimpact[pipeline] of the same commit with pip.")
# This Python, also where its path has a space.
if os.path.exists(sys.executable):
    sys.executable = shlex.quote(sys.executable)

from vibroimpact_pipeline.git import committed
from vibroimpact_pipeline.specs import at, case_parameters, module_of, spec_of, specs, with_model
from vibroimpact_pipeline.cases import title_of, with_cases
from vibroimpact_pipeline.code import INSTALLED, ROOT, code_of
from vibroimpact_pipeline.environment import missing_libraries
from vibroimpact_pipeline.result_records import PARTIAL, distrust, is_result

for path in [] if SRC.is_dir() else sorted((ROOT / "workflow").glob("*/**/*.*")):
    name = path.relative_to(ROOT / "workflow").as_posix()
    if path.read_text("utf-8").rstrip() != Path(workflow.source_path(f"../{name}")).read_text("utf-8").rstrip():
        refuse(f"workflow/{name} is not that of the installed vibroimpact: install the commit of these rules.")

if not os.access(".", os.W_OK):
    refuse(f"{os.getcwd()}: cannot be written to. Build in another directory, with --directory.")


# The layer of what goes beyond the chapter; a checkout may do without it.
STUDIES = (ROOT / "workflow/rules/studies").is_dir()


# The config: entries of --config and --configfile over those of config/config.yaml and config/studies.yaml, each of the
# working directory or else of the checkout.
def config_file(path):
    return path if Path(path).is_file() and not IS_MODULE else own(path)


CONFIG_FILES = [config_file(f"config/{name}.yaml") for name in ("config", "studies")[: 1 + STUDIES]]


def config_files():
    """The files that the config is from, a later one over those before."""
    given = workflow.config_settings
    if IS_MODULE:
        return CONFIG_FILES
    return given.configfiles if given.replace_workflow_config else [*CONFIG_FILES, *given.configfiles]


def checked_config(given):
    """The config with defaults; without its model, as the schemas made from it allow."""
    if not WITH_MODEL:
        given, rest = with_cases(given), {}
        schemas = ROOT / "workflow/schemas"
        if STUDIES:
            chapter = json.loads((schemas / "config.schema.json").read_text("utf-8"))["properties"]
            rest = {name: entry for name, entry in given.items() if name not in chapter}
            validate(rest, schema=str(schemas / "studies/config.schema.json"))
        given = {name: entry for name, entry in given.items() if name not in rest}
        validate(given, schema=str(schemas / "config.schema.json"))
        return given | rest
    last = (f"config of module {__name__}", given) if IS_MODULE else ("--config", dict(workflow.config_settings.config))
    sources = [*SOURCES, last]
    try:
        return checked(merged(sources), sources)
    except ConfigError as error:
        refuse(error)


WITH_MODEL = all(map(importlib.util.find_spec, ("pydantic", "numpy")))
if WITH_MODEL:
    from vibroimpact_pipeline.config import ConfigError, checked, merged, read

    try:
        SOURCES = [(file, read(file)) for file in config_files()]  # before Snakemake does, whose complaints are longer
    except ConfigError as error:
        refuse(error)


def code(script, *others):
    """The code behind a job: its script, and what this does not import by name, for example modules of figures."""
    return code_of(f"workflow/scripts/{script}.py", "environment.lock", *others)


def system_of(case):
    """Parameters of System for one case."""
    return case_parameters(config, case)


def all_systems():
    return {case: system_of(case) for case in sorted(config["cases"])}


SPECS = specs()


def spec(figure):
    """The words and columns of a figure, and the module that draws it."""
    return spec_of(figure, SCENES.get(figure, {}), SPECS)


def figure_files(stem, tables):
    """The files of a figure by kind: pictures, record of provenance, and tables."""
    kinds = {kind: f"{stem}.{kind}" for kind in ("png", "pdf", "svg")} | {"provenance": f"{stem}.provenance.json"}
    return kinds | {name: table["file"] for name, table in tables.items()}


def in_report(outputs, category, caption="../../report/caption.rst"):
    """Named outputs, the picture and the plotted table marked for `snakemake --report`; caption: from the rule's file."""
    marked = {
        kind: report(path, caption=caption, category=category, labels={"name": Path(path).stem, "kind": kind})
        for kind, path in outputs.items()
        if kind in ("svg", "csv")
    }
    return outputs | marked


def entries(paths):
    """Entries of the config by path; a * stands for all settings of a section."""
    found = {}
    for path in paths:
        section, _, name = path.rpartition(".")
        names = [key for key in at(config, section) if key not in ("like", "case")] if name == "*" else [name]
        found |= {f"{section}.{key}": at(config, f"{section}.{key}") for key in names}
    return found


def figure_params(figure, paths, case=None, systems=False, decides=()):
    """Settings of a figure, named as the last key of their paths, and its systems.

    `config`: all that decides what it shows, by path, also what its inputs are made with (`decides`).
    """
    settings = entries(paths)
    params = {"figure": figure, "module": spec(figure)["module"], "case": case, "config": settings | entries(decides)}
    params["settings"] = {path.rpartition(".")[2]: entry for path, entry in settings.items()}
    if case:
        params["system"] = params["config"][f"cases.{case}"] = system_of(case)
    if systems:
        params["systems"] = params["config"]["cases"] = all_systems()
    return params


def files(figure, *marks, folder="figures"):
    """Outputs of a figure: <figure>.png, .pdf, .svg, .csv, .provenance.json and further tables; marks: of `in_report`."""
    made = figure_files(f"results/{folder}/{figure}", spec(figure)["tables"])
    return in_report(made, *(marks or ("Figures of the chapter",)))


def chart(figure, settings={}, decides={}, *shown):
    """Params of a chart of accuracy: settings, the entries of the config that decide on it, modules that it draws."""
    known = {"figure": figure, "module": module_of(figure), "settings": settings, "config": decides}
    return known | {"code": code("figure", module_of(figure), *shown)}


def of_case(figure, paths):
    """Results for the case that a figure of the config shows."""
    shown = SCENES.get(figure, {})
    return {name: path.format_map(shown) for name, path in paths.items()} if "case" in shown else {}


def scene(figure, *others, section="figures"):
    """Params of a figure of the config: its own settings, others by their path, and the system of its case.

    Of a simulated motion the model and the settings of the run are decided in its inputs.
    """
    if figure not in SCENES:
        return {"settings": absent(figure)}
    case, own_settings = SCENES[figure].get("case"), entries([f"{section}.{figure}.*"])
    decides = (
        [f"cases.{case}.simulation.*", f"{section}.{figure}.model"] if spec(figure)["notebook"] == "simulation" else []
    )
    paths = [path for path in own_settings if path not in decides]
    params = figure_params(figure, [*paths, *others], case, decides=decides)
    return params | {"code": code("figure", spec(figure)["module"], *map(module_of, spec(figure)["shares"]))}


# The notebooks by name.
NOTEBOOKS = {path.stem: path.relative_to(ROOT).as_posix() for path in (ROOT / "notebooks").rglob("*.ipynb")}


def by_notebook(figures):
    """The notebooks of some figures, each with the figures whose pages it makes."""
    found = {}
    for figure in figures:
        found.setdefault(spec(figure)["notebook"], []).append(figure)
    return found


def page_inputs(figure):
    """Files that the notebook of a page reads, by name: tables and picture of its figure, and results beside them."""
    tables = {name: table["file"] for name, table in spec(figure)["tables"].items()}
    return {"png": f"results/figures/{figure}.png"} | tables | of_case(figure, READ.get(spec(figure)["notebook"], {}))


def read_by(notebook, figures):
    """Inputs of the job that makes the pages of some figures: their notebook, and what it reads for each."""
    read = sorted({path for figure in figures for path in page_inputs(figure).values()})
    return {"notebook": own(NOTEBOOKS[notebook]), "read": read}


def pages(figures):
    """Outputs of that job by figure, and for its script the entry of each in the config and its notebook's parameters."""
    outputs = {figure: f"results/notebooks/{figure}.html" for figure in figures}
    given = {}
    for figure in figures:
        params = getattr(rules, figure).params
        given[figure] = {name: params.get(name) for name in ("case", "system", "config")}
        given[figure] |= {"scene": titled(figure), "inputs": page_inputs(figure)}
    return outputs, given


def titled(figure):
    """The entry of a figure in the config, its case under its title."""
    shown = SCENES[figure]
    return shown | ({"case": title_of(config, shown["case"])} if "case" in shown else {})


def modelled(figure, entry):
    """A figure with its settings or, of a simulation, those of the run."""
    known = {"notebook": spec(figure)["notebook"], "model": entry["model"], "module": spec(figure)["module"]}
    settings = {name: value for name, value in entry.items() if name not in ("like", "model", "case")}
    if known["notebook"] == "simulation":
        settings = config["cases"][entry["case"]]["simulation"]
    return known | {"system": system_of(entry["case"]), "settings": settings}


def absent(figure):
    """A function for Snakemake that raises the reason why a figure cannot be made."""

    def refused(wildcards):
        raise WorkflowError(f"figures.{figure}: the config has no such figure, or not its case.")

    return refused


def caption(figure):
    """The caption of a figure, with the numbers that it asks for."""
    params = getattr(rules, figure).params
    known = (titled(figure) if figure in SCENES else {}) | (params.get("system") or config["system"])
    text = with_model(spec(figure)["caption"], known)
    return re.sub(r"\{(\w+)\}", lambda name: str(known.get(name[1], name[0])), text)


def left_over():
    """Figures of builds before, which this config does not make."""
    found = {wildcards.figure for _, wildcards in listfiles("results/figures/{figure,[^.]+}.provenance.json")}
    return sorted(found.difference(ALL_FIGURES))


def study_titles(wildcards):
    """Titles of the figures of the studies that are there."""
    others = [name for name in ALL_FIGURES if name not in config["figures"]]
    return {name: spec(name)["title"] for name in others if os.path.isfile(f"results/figures/{name}.svg")}


def made_with_now(name, wildcards):
    """Params and inputs of a rule; those of the inputs that are results."""
    if not hasattr(rules, name):
        raise LookupError(name)
    made_by, given = getattr(rules, name), SimpleNamespace(**wildcards)
    params = {key: value(given) if callable(value) else value for key, value in made_by.params.items()}
    return params, [path for path in expand(made_by.input, **wildcards) if is_result(path)]


def results_of_a_commit(wildcards):
    """Results of both builds; refused, before anything is built, where they would not be those of the commit."""
    from vibroimpact_pipeline.archive import differences, made_otherwise
    from vibroimpact_pipeline.config import checked, merged, read

    try:
        committed(ROOT)
    except ValueError as error:
        refuse(f"archive: {error}")
    of_commit = checked(merged([(file, read(ROOT / file)) for file in COMMITTED_CONFIG]))
    for place, there, here in differences(of_commit, {key: config[key] for key in config if key != "captions"}):
        refuse(
            f"archive: {place} is {here}, in {' and '.join(COMMITTED_CONFIG)} {there}. Build without another config."
        )
    targets = [*rules.all.input, *(rules.studies.input if STUDIES else ())]
    if others := list(made_otherwise(targets, made_with_now)):
        more = f" ({len(others) - 1} more)" if others[1:] else ""
        refuse(f"archive: {others[0]}{more}. Build first: make figures{' studies' if STUDIES else ''}")
    return targets


# Rules before these are those of another workflow, which has these as a module.
OTHERS = {rule.name for rule in workflow.rules}


def existing_outputs():
    """The outputs of all rules, as far as they are there."""
    patterns = [output for rule in workflow.rules if rule.name not in OTHERS for output in rule.output]
    found = [path for pattern in patterns if "{" in pattern for path, _ in listfiles(pattern) if PARTIAL not in path]
    return [pattern for pattern in patterns if "{" not in pattern] + found


onstart:
    if missing := missing_libraries():
        refuse(f"Not installed: {', '.join(missing)}. Run `make set-up`, or install environment.lock with pip.")
