# What every stage needs: where the files are, the checked config, fingerprints of the code, the figures' SPECs.

import importlib.util
import inspect
import json
import os
import re
import shlex
import sys
from pathlib import Path

from snakemake.utils import listfiles, update_config, validate

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

from vibroimpact_pipeline.specs import case_parameters, made, specs
from vibroimpact_pipeline.cases import title_of, with_cases
from vibroimpact_pipeline.code import INSTALLED, ROOT, fingerprint
from vibroimpact_pipeline.environment import missing_libraries
from vibroimpact_pipeline.results import PARTIAL, distrust

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
    last = (f"config of module {__name__}", given) if IS_MODULE else ("--config", workflow.config_settings.config)
    whole = read(CONFIG_FILE) if IS_MODULE else {}
    update_config(whole, given)
    try:
        return checked(whole, [*SOURCES, last])
    except ConfigError as error:
        refuse(error)


WITH_MODEL = all(map(importlib.util.find_spec, ("pydantic", "numpy")))
if WITH_MODEL:
    from vibroimpact_pipeline.config import ConfigError, checked, read

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


def figure_files(stem, spec):
    """The files of a figure by kind: pictures, where they come from, and its tables."""
    kinds = {kind: f"{stem}.{kind}" for kind in ("png", "pdf", "svg")} | {"provenance": f"{stem}.provenance.json"}
    return kinds | {name: table["file"] for name, table in spec["tables"].items()}


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
    """What decides on the numbers of a sweep, and nothing else: see vibroimpact.sweeps.request."""
    spec = {name: sweep[name] for name in ("observe", "starts", "seed", "cycles", "settle", "band") if name in sweep}
    if "regimes" in sweep["observe"]:
        spec["observation"] = config["regimes"]["observation"]
    return {"system": system_of(sweep["case"]), "axes": sweep["axes"], "spec": spec}


def figure_params(figure, spec):
    """The settings of a figure, its systems, and what decides on it: entries of the config by their paths."""
    asked, case = spec["request"], spec["request"]["case"]
    decides = {path: asked["settings"][name] for name, path in asked["paths"].items()}
    systems = {}
    if case:
        systems["system"] = decides[f"cases.{case}"] = system_of(case)
    if spec.get("systems"):
        systems["systems"] = decides["cases"] = all_systems()
    return {"figure": figure, "case": case, "settings": asked["settings"], "config": decides, **systems}


def titled(case):
    """What words call the case of a figure, if it has one."""
    return {"case": title_of(config, case)} if case else {}


def caption(figure, spec):
    """The caption of a figure, with the numbers that it asks for."""
    case = spec["request"]["case"]
    known = config["figures"].get(figure, {}) | (system_of(case) if case else config["system"]) | titled(case)
    return re.sub(r"\{(\w+)\}", lambda name: str(known.get(name[1], name[0])), spec["caption"])


def files_of_figures(of_notebooks):
    figures = {figure: spec for figure, spec in MADE.items() if ("notebook" in spec) == of_notebooks}
    return [
        path for figure, spec in figures.items() for path in figure_files(f"results/figures/{figure}", spec).values()
    ]


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
