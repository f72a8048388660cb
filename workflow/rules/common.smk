# What every stage needs: settled surroundings, a valid config, fingerprints of code.

from snakemake_logger_plugin_brief.results import from_start
from vibroimpact_pipeline import config as config_checks
from vibroimpact_pipeline.chapter import departures
from vibroimpact_pipeline.config.labels import MODULES as LABELLED_BY
from vibroimpact_pipeline.config.labels import remembered
from vibroimpact_pipeline.environment import prepare
from vibroimpact_pipeline.report.figure_texts import figure_texts
from vibroimpact_pipeline.sources import sources

IS_MODULE = not workflow.modifier.is_main_snakefile()
CONFIG = "config/config.yaml"
CONFIG_FILE = CONFIG if Path(CONFIG).is_file() and not IS_MODULE else own(CONFIG)
CAPTION = str(ROOT / "report/caption.rst")
SOURCES = sources()
demand(prepare, ROOT, SOURCES)


def config_origins():
    """What sets entries of the config, by the name under which to complain about it; a later one overrides."""
    given = workflow.config_settings
    files = [CONFIG_FILE, *given.configfiles][given.replace_workflow_config :]
    if IS_MODULE:
        return in_file(CONFIG_FILE) | as_typed(f"config of module {__name__}", config)
    return {name: entries for file in files for name, entries in in_file(file).items()} | as_typed(
        "--config", dict(given.config)
    )


def in_file(file):
    name = from_start(file)
    try:
        return {name: config_checks.read(file)}
    except ValueError as error:
        refuse([f"{name}: {error}"])


def as_typed(origin, entries):
    try:
        return {origin: config_checks.typed(entries)}
    except ValueError as error:
        refuse([f"{origin}: {error}"])


def checked_config(origins):
    """The config that its origins make together, if all is right with it."""
    made = config_checks.combined(origins.values())
    labels = remembered(".cache/labels.json", SOURCES.fingerprint(modules=LABELLED_BY))
    if found := config_checks.problems(made, labels):
        refuse(config_checks.complaints(found, origins))
    return made | {"figure_texts": figure_texts(ROOT, made)}


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
