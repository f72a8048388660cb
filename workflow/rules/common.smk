# What every stage needs: settled surroundings, a valid config, fingerprints of code.

from snakemake.utils import update_config
from vibroimpact_pipeline.chapter import departures
from vibroimpact_pipeline.config import ConfigError, case_parameters, checked, read
from vibroimpact_pipeline.data_dictionary import compared
from vibroimpact_pipeline.environment import prepare
from vibroimpact_pipeline.report.figure_texts import figure_texts
from vibroimpact_pipeline.sources import sources

IS_MODULE = not workflow.modifier.is_main_snakefile()
CONFIG = "config/config.yaml"
CONFIG_FILE = CONFIG if Path(CONFIG).is_file() and not IS_MODULE else own(CONFIG)
CAPTION = str(ROOT / "report/caption.rst")
SOURCES = sources()
demand(prepare, ROOT, SOURCES)


def config_files():
    """The files that the config is from, a later one over those before, each of which can be read."""
    given = workflow.config_settings
    files = [CONFIG_FILE] if IS_MODULE else [CONFIG_FILE, *given.configfiles][given.replace_workflow_config :]
    for file in files:
        valid(read, file)
    return files


def valid(work, *arguments):
    """What reads or checks the config, or its problems in lines, and no build."""
    try:
        return work(*arguments)
    except ConfigError as error:
        refuse(str(error).splitlines())


def checked_config(given):
    """The config as Snakemake has merged it, if all is right with it; a module is given what differs from the file."""
    origin = f"config of module {__name__}" if IS_MODULE else "--config"
    whole = read(CONFIG_FILE) if IS_MODULE else {}
    update_config(whole, given)
    made = valid(checked, whole, origin, CONFIG_FILES)
    return made | {"figure_texts": figure_texts(ROOT, made)}


def code(*files, modules=()):
    """Fingerprint of a rule's script or notebook (paths from the root) and of the library modules it uses."""
    return SOURCES.fingerprint(*(ROOT / file for file in files), modules=modules)


def system_of(case):
    return case_parameters(config, case)


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


CONFIG_FILES = config_files()


wildcard_constraints:
    case="[a-z][a-z0-9_]+",
