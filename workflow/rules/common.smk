# Definitions for all rules: paths, the validated config, fingerprints of code, and the SPECs of figures.

import inspect
import os
import re
import shlex
import sys
from pathlib import Path
from types import SimpleNamespace

from snakemake.utils import listfiles


def refuse(message):
    """Exit with a message instead of a traceback."""
    print(message, file=sys.stderr)
    sys.exit(1)


def checkout_path(path):
    """Return the path of a file in the checkout; relative if builds run in the checkout, so that this can be moved."""
    return path if os.path.samefile(ROOT, ".") else str(ROOT / path)


# Use the library of this checkout.
sys.path.insert(0, str(Path(inspect.currentframe().f_code.co_filename).parents[2] / "src"))
# Quote the path of Python, since it may contain spaces.
if os.path.exists(sys.executable):
    sys.executable = shlex.quote(sys.executable)

from vibroimpact_pipeline.environment import missing_libraries

if missing := missing_libraries():
    refuse(f"Packages not installed: {', '.join(missing)}. Run `make set-up`, or install environment.lock with pip.")

from vibroimpact_pipeline.specs import at, case_parameters, module_of, spec_of, specs, with_model
from vibroimpact_pipeline.cases import title_of
from vibroimpact_pipeline.code import ROOT, code_of
from vibroimpact_pipeline.config import ConfigError, checked, merged, read
from vibroimpact_pipeline.git import committed
from vibroimpact_pipeline.result_records import PARTIAL, distrust

if not os.access(".", os.W_OK):
    refuse(f"{os.getcwd()}: not writable. Select another working directory with --directory.")


# True if the studies, which go beyond the chapter, are installed.
STUDIES = (ROOT / "workflow/rules/studies").is_dir()


CONFIG_FILES = [f"config/{name}.yaml" for name in ("config", "studies")[: 1 + STUDIES]]
# Read each config file from the working directory. If the file is missing there, read the file of the checkout.
FOUND = [path if Path(path).is_file() else checkout_path(path) for path in CONFIG_FILES]


def validated_config():
    """Return the validated config with defaults; exit with one line for each invalid entry.

    Entries of --configfile and --config override the entries of the files.
    """
    given = workflow.config_settings
    try:
        files = [*([] if given.replace_workflow_config else FOUND), *given.configfiles]
        sources = [*((file, read(file)) for file in files), ("--config", dict(given.config))]
        return checked(merged(sources), sources)
    except ConfigError as error:
        refuse(error)


validated = validated_config()
# Declare the config files, which are already validated, so that Snakemake's report lists them.
for file in FOUND:

    configfile: file


config = validated


def code(script, *others):
    """Return `params.code` for a script and further roots of `code_of`, such as modules that it loads by name."""
    return code_of(f"workflow/scripts/{script}.py", "environment.lock", *others)


def system_of(case):
    """Return the parameters of System for a case."""
    return case_parameters(config, case)


def all_systems():
    return {case: system_of(case) for case in sorted(config["cases"])}


SPECS = specs()


def spec(figure):
    """Return the SPEC of a figure, including its drawing module."""
    return spec_of(figure, SCENES.get(figure, {}), SPECS)


def figure_files(stem, tables):
    """Return the path of each file of a figure by kind: pictures, provenance record and tables."""
    kinds = {kind: f"{stem}.{kind}" for kind in ("png", "pdf", "svg")} | {"provenance": f"{stem}.provenance.json"}
    return kinds | {name: table["file"] for name, table in tables.items()}


def in_report(outputs, category):
    """Return the outputs of a figure, with picture and plotted table marked for `snakemake --report`."""
    caption = str(ROOT / "report/caption.rst")
    marked = {
        kind: report(path, caption=caption, category=category, labels={"name": Path(path).stem, "kind": kind})
        for kind, path in outputs.items()
        if kind in ("svg", "csv")
    }
    return outputs | marked


def entries(paths):
    """Return the config entries at the given paths, by path; * stands for all settings of a section."""
    found = {}
    for path in paths:
        section, _, name = path.rpartition(".")
        names = [key for key in at(config, section) if key not in ("like", "case")] if name == "*" else [name]
        found |= {f"{section}.{key}": at(config, f"{section}.{key}") for key in names}
    return found


def figure_params(figure, paths, case=None, systems=False, decides=()):
    """Return the params of a figure: names, `settings` by the last key of their path, parameters of its systems, code.

    The param `config` contains all config entries on which the figure depends. Among them are the entries at the paths
    `decides`, which only affect the inputs of the figure.
    """
    settings = entries(paths)
    drawn_by, shared = spec(figure)["module"], map(module_of, spec(figure)["shares"])
    params = {"figure": figure, "module": drawn_by, "case": case, "config": settings | entries(decides)}
    params["settings"] = {path.rpartition(".")[2]: entry for path, entry in settings.items()}
    if case:
        params["system"] = params["config"][f"cases.{case}"] = system_of(case)
    if systems:
        params["systems"] = params["config"]["cases"] = all_systems()
    return params | {"code": code("figure", drawn_by, *shared)}


def files(figure, category="Figures of the chapter", folder="figures"):
    """Return the outputs of a figure: pictures, provenance record and tables."""
    return in_report(figure_files(f"results/{folder}/{figure}", spec(figure)["tables"]), category)


def chart(figure, settings={}, decides={}, *shown):
    """Return the params of an accuracy chart: its settings, the config entries that affect it (`decides`), and code."""
    known = {"figure": figure, "module": module_of(figure), "settings": settings, "config": decides}
    return known | {"code": code("figure", module_of(figure), *shown)}


def of_case(figure, paths):
    """Return the paths of results, with case and model of a figure filled in; no paths if the figure has no case."""
    shown = SCENES.get(figure, {})
    return {name: path.format_map(shown) for name, path in paths.items()} if "case" in shown else {}


def scene(figure, *others):
    """Return the params of a figure: its settings, further settings at the paths `others`, and the system of its case.

    For a simulated motion, model and settings of the run are left out, since they only affect the inputs.
    """
    if figure not in SCENES:
        return {
            "settings": lambda wildcards: refuse(f"figures.{figure}: missing in the config, or its case is missing")
        }
    case, own_settings = SCENES[figure].get("case"), entries([f"figures.{figure}.*"])
    simulated = spec(figure)["notebook"] == "simulation"
    decides = [f"cases.{case}.simulation.*", f"figures.{figure}.model"] if simulated else []
    paths = [path for path in own_settings if path not in decides]
    return figure_params(figure, [*paths, *others], case, decides=decides)


def page_inputs(figure):
    """Return the files that a notebook reads for the page of a figure, by name: tables, picture and other results."""
    tables = {name: table["file"] for name, table in spec(figure)["tables"].items()}
    return {"png": f"results/figures/{figure}.png"} | tables | of_case(figure, READ.get(spec(figure)["notebook"], {}))


def page_params(figure):
    """Return the params of the page of a figure: its params, its config entry as in `titled`, and files to read."""
    params = getattr(rules, figure).params
    known = {name: params.get(name) for name in ("case", "system", "config")}
    return known | {"scene": titled(figure), "inputs": page_inputs(figure)}


def titled(figure):
    """Return the config entry of a figure with its case replaced by the title of the case."""
    shown = SCENES[figure]
    return shown | ({"case": title_of(config, shown["case"])} if "case" in shown else {})


def modelled(figure, entry):
    """Return notebook, model, module, system and settings of a figure; for a simulation, settings of its case."""
    known = {"notebook": spec(figure)["notebook"], "model": entry["model"], "module": spec(figure)["module"]}
    settings = {name: value for name, value in entry.items() if name not in ("like", "model", "case")}
    if known["notebook"] == "simulation":
        settings = config["cases"][entry["case"]]["simulation"]
    return known | {"system": system_of(entry["case"]), "settings": settings}


def caption(figure):
    """Return the caption of a figure with all placeholders filled in."""
    params = getattr(rules, figure).params
    known = (titled(figure) if figure in SCENES else {}) | (params.get("system") or config["system"])
    text = with_model(spec(figure)["caption"], known)
    return re.sub(r"\{(\w+)\}", lambda name: str(known.get(name[1], name[0])), text)


def study_titles(wildcards):
    """Return the title of each existing figure of the studies by name."""
    others = [name for name in ALL_FIGURES if name not in config["figures"]]
    return {name: spec(name)["title"] for name in others if os.path.isfile(f"results/figures/{name}.svg")}


def results_of_a_commit(wildcards):
    """Return the results of figures and studies; exit before any job runs unless checkout and config are committed."""
    from vibroimpact_pipeline.archive import differences

    try:
        committed(ROOT)
    except ValueError as error:
        refuse(f"archive: {error}")
    of_commit = checked(merged([(file, read(ROOT / file)) for file in CONFIG_FILES]))
    for place, there, here in differences(of_commit, {key: config[key] for key in config if key != "captions"}):
        refuse(f"archive: {place} is {here}, but {there} in {' and '.join(CONFIG_FILES)}. Build without --config.")
    return [*rules.all.input, *(rules.studies.input if STUDIES else ())]


def existing_outputs():
    """Return the outputs of all rules; for outputs with wildcards, only the existing files."""
    patterns = [output for rule in workflow.rules for output in rule.output]
    found = [path for pattern in patterns if "{" in pattern for path, _ in listfiles(pattern) if PARTIAL not in path]
    return [pattern for pattern in patterns if "{" not in pattern] + found
