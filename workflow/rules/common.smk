# What every stage needs: settled surroundings, a valid config, fingerprints of code.

import yaml
from snakemake.utils import update_config

from vibroimpact_pipeline import config as config_checks
from vibroimpact_pipeline.environment import prepare
from vibroimpact_pipeline.report.figure_texts import figure_texts
from vibroimpact_pipeline.sources import Sources

IS_MODULE = not workflow.modifier.is_main_snakefile()
CONFIG = "config/config.yaml"
CONFIG_FILE = CONFIG if Path(CONFIG).is_file() and not IS_MODULE else own(CONFIG)
CAPTION = str(ROOT / "report/caption.rst")
SOURCES = Sources()
prepare(ROOT, SOURCES)


def config_origins():
    """What sets entries of the config, by the name under which to complain about it; a later one overrides."""
    given = workflow.config_settings
    files = [CONFIG_FILE, *map(os.path.normpath, given.configfiles)][given.replace_workflow_config :]
    if IS_MODULE:
        return {CONFIG_FILE: entries_of(CONFIG_FILE), f"config of module {__name__}": config_checks.typed(config)}
    return {file: entries_of(file) for file in files} | {"--config": config_checks.typed(dict(given.config))}


def entries_of(file):
    try:
        return config_checks.parse(Path(file).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        refuse([f"{file}: {error}"])


def checked_config(origins):
    """The config that its origins make together, if all is right with it."""
    made = {}
    for entries in origins.values():
        update_config(made, entries)
    schema = yaml.safe_load((ROOT / "workflow/schemas/config.schema.yaml").read_text())
    if found := config_checks.problems(made, schema):
        refuse(config_checks.complaints(found, origins))
    return made | {"figure_texts": figure_texts(ROOT, made["cases"])}


def code(*files, modules=()):
    """Fingerprint of a rule's script or notebook (paths from the root) and of the library modules it uses."""
    return SOURCES.fingerprint(*(ROOT / file for file in files), modules=modules)


def system_of(case):
    return config_checks.case_parameters(config, case)


def all_systems():
    """Parameters of every case, in an order that overrides on the command line do not change."""
    return {case: system_of(case) for case in sorted(config["cases"])}


def in_report(outputs, category, kinds=("svg", "csv")):
    """The outputs of a figure by kind, its picture and its numbers marked for `snakemake --report`."""
    marked = {
        kind: report(path, caption=CAPTION, category=category, labels={"name": Path(path).stem, "kind": kind})
        for kind, path in outputs.items()
        if kind in kinds
    }
    return outputs | marked


CONFIG_ORIGINS = config_origins()


wildcard_constraints:
    case="[a-z][a-z0-9_]+",
