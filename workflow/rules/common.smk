# What every stage needs: where the files are, the checked config, fingerprints of the code, the figures' SPECs.

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
from vibroimpact_pipeline.specs import at, case_parameters, spec_of, specs
from vibroimpact_pipeline.cases import title_of, with_cases
from vibroimpact_pipeline.code import INSTALLED, ROOT, fingerprint
from vibroimpact_pipeline.environment import missing_libraries
from vibroimpact_pipeline.result_records import PARTIAL, distrust, is_result

for path in [] if SRC.is_dir() else sorted((ROOT / "workflow").glob("*/*.*")):
    name = f"{path.parent.name}/{path.name}"
    if path.read_text("utf-8").rstrip() != Path(workflow.source_path(f"../{name}")).read_text("utf-8").rstrip():
        refuse(f"workflow/{name} is not that of the installed vibroimpact: install the commit of these rules.")

if not os.access(".", os.W_OK):
    refuse(f"{os.getcwd()}: cannot be written to. Build in another directory, with --directory.")


# The config: entries of --config and --configfile over config/config.yaml, of the working directory or else the checkout.
CONFIG_FILE = (
    "config/config.yaml" if Path("config/config.yaml").is_file() and not IS_MODULE else own("config/config.yaml")
)


def config_files():
    """The files that the config is from, a later one over those before."""
    given = workflow.config_settings
    return [CONFIG_FILE] if IS_MODULE else [CONFIG_FILE, *given.configfiles][given.replace_workflow_config :]


def checked_config(given):
    """The config with defaults; without its model, as the schema made from it allows."""
    if not WITH_MODEL:
        given = with_cases(given)
        validate(given, schema=str(ROOT / "workflow/schemas/config.schema.json"))
        return given
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


def fingerprints(*parts):
    """Fingerprints of parts of the checkout behind a job, which checks them again when it ends."""
    return {part: fingerprint(part) for part in parts}


LIBRARY = fingerprints("library", "scripts", "lock")
FIGURES = LIBRARY | fingerprints("figures")
PIPELINE = FIGURES | fingerprints("pipeline")


def system_of(case):
    """Parameters of System for one case."""
    return case_parameters(config, case)


def all_systems():
    return {case: system_of(case) for case in sorted(config["cases"])}


SPECS = specs()


def spec(figure):
    """The words and columns of a figure, and the module that draws it."""
    return spec_of(figure, config["figures"].get(figure, {}), SPECS)


def figure_files(stem, tables):
    """The files of a figure by kind: pictures, where they come from, and its tables."""
    kinds = {kind: f"{stem}.{kind}" for kind in ("png", "pdf", "svg")} | {"provenance": f"{stem}.provenance.json"}
    return kinds | {name: table["file"] for name, table in tables.items()}


def in_report(outputs, category):
    """Named outputs, the picture and the plotted table marked for `snakemake --report`."""
    caption = "../../report/caption.rst"
    marked = {
        kind: report(path, caption=caption, category=category, labels={"name": Path(path).stem, "kind": kind})
        for kind, path in outputs.items()
        if kind in ("svg", "csv")
    }
    return outputs | marked


def sweep_request(sweep):
    """Everything that the numbers of a sweep depend on, and nothing else: see vibroimpact.sweeps.request."""
    spec = {name: sweep[name] for name in ("observe", "starts", "seed", "cycles", "settle", "band") if name in sweep}
    if "regimes" in sweep["observe"]:
        spec["observation"] = config["regimes"]["observation"]
    return {"system": system_of(sweep["case"]), "axes": sweep["axes"], "spec": spec}


def entries(paths):
    """Entries of the config by path; a * stands for all settings of a section."""
    found = {}
    for path in paths:
        section, _, name = path.rpartition(".")
        names = (
            [key for key in at(config, section) if key not in ("notebook", "model", "case")] if name == "*" else [name]
        )
        found |= {f"{section}.{key}": at(config, f"{section}.{key}") for key in names}
    return found


def figure_params(figure, paths, case=None, systems=False):
    """Settings of a figure, named as the last key of their paths, and its systems; `config`: all of it, by path."""
    decides = entries(paths)
    params = {"figure": figure, "case": case, "config": decides}
    params["settings"] = {path.rpartition(".")[2]: entry for path, entry in decides.items()}
    if case:
        params["system"] = decides[f"cases.{case}"] = system_of(case)
    if systems:
        params["systems"] = decides["cases"] = all_systems()
    return params


def of_case(figure, paths):
    """Results for the case that a figure of the config shows."""
    case = config["figures"].get(figure, {}).get("case")
    return {name: path.format(case=case) for name, path in paths.items()} if case else {}


def page_and_files(figure):
    """Outputs of a notebook: <figure>.png, .pdf, .svg, .csv and .provenance.json, and its page."""
    files = in_report(figure_files(f"results/figures/{figure}", spec(figure)["tables"]), "Figures of the chapter")
    return files | {"html": f"results/notebooks/{figure}.html"}


def scene(figure, *paths):
    """Params of a figure of the config: its own settings, those at further paths, and the system of its case."""
    if figure not in config["figures"]:
        return {"scene": absent(figure)}
    own_settings = config["figures"][figure]
    case, notebook = own_settings.get("case"), own_settings["notebook"]
    params = figure_params(figure, [f"figures.{figure}.*", *(path.format(case=case) for path in paths)], case)
    title = {"case": title_of(config, case)} if case else {}
    return params | {
        "scene": own_settings | title,
        "code": PIPELINE | fingerprints(f"notebooks/{notebook}.ipynb"),
    }


def absent(figure):
    """A function for Snakemake that raises the reason why a figure cannot be made."""

    def refused(wildcards):
        raise WorkflowError(f"figures.{figure}: the config has no such figure, or not its case.")

    return refused


def companion(figure, case=None, systems=False, settings=(), inputs={}, needs=()):
    """Inputs and params of a companion figure; None if the config lacks an entry that it needs."""
    try:
        case = at(config, case) if case else None
        inputs = {name: path.format(case=case) for name, path in inputs.items()}
        swept = [f"sweeps.{Path(path).stem}" for path in inputs.values() if path.startswith("results/sweeps/")]
        entries([*swept, *(path.format(case=case) for path in needs)])
        params = figure_params(figure, [path.format(case=case) for path in settings], case, systems)
    except LookupError:
        return None
    return SimpleNamespace(inputs=inputs, params=params)


def caption(figure):
    """The caption of a figure, with the numbers that it asks for."""
    params = getattr(rules, figure).params
    known = config["figures"].get(figure, {}) | (params.get("system") or config["system"]) | params.get("scene", {})
    return re.sub(r"\{(\w+)\}", lambda name: str(known.get(name[1], name[0])), spec(figure)["caption"])


def left_over():
    """Figures of builds before, which this config does not make."""
    found = {wildcards.figure for _, wildcards in listfiles("results/figures/{figure,[^.]+}.provenance.json")}
    return sorted(found.difference(ALL_FIGURES))


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


def made_with_now(name, wildcards):
    """Params and inputs of a rule; those of the inputs that are results."""
    if not hasattr(rules, name):
        raise LookupError(name)
    made_by, given = getattr(rules, name), SimpleNamespace(**wildcards)
    params = {key: value(given) if callable(value) else value for key, value in made_by.params.items()}
    return params, [path for path in expand(made_by.input, **wildcards) if is_result(path)]


def results_of_a_commit(wildcards):
    """Return the results of the default build; refuse, before anything is built, what is not of the commit."""
    from vibroimpact_pipeline.archive import differences, made_otherwise
    from vibroimpact_pipeline.config import checked, read

    try:
        committed(ROOT)
    except ValueError as error:
        refuse(f"archive: {error}")
    of_commit = checked(read(ROOT / "config/config.yaml"))
    for place, there, here in differences(of_commit, {key: config[key] for key in config if key != "captions"}):
        refuse(f"archive: {place} is {here}, in config/config.yaml {there}. Build without another config.")
    if others := list(made_otherwise(rules.all.input, made_with_now)):
        more = f" ({len(others) - 1} more)" if others[1:] else ""
        refuse(f"archive: {others[0]}{more}. Build first: snakemake --cores {workflow.resource_settings.cores or 1}")
    return rules.all.input
