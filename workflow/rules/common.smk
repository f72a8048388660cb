# What every stage needs: settled surroundings, one build at a time, a valid config, fingerprints of code.

import fcntl
import sys
from pathlib import Path

from snakemake.utils import update_config

from vibroimpact_pipeline import config as config_checks
from vibroimpact_pipeline.chapter import departures
from vibroimpact_pipeline.config.labels import MODULES as LABELLED_BY
from vibroimpact_pipeline.config.labels import remembered
from vibroimpact_pipeline.data_dictionary import compared
from vibroimpact_pipeline.environment import prepare
from vibroimpact_pipeline.report.figure_texts import figure_texts
from vibroimpact_pipeline.sources import Sources

ROOT = Path(workflow.basedir)
CONFIG_FILE = "config/config.yaml"
CAPTION = str(ROOT / "report/caption.rst")
SOURCES = Sources()
prepare(ROOT, SOURCES)


def refuse(lines):
    print(*lines, sep="\n", file=sys.stderr)
    sys.exit(1)


def one_build_at_a_time():
    """Wait for another build of this directory. The system frees the lock with the process, however it ends."""
    Path(".cache").mkdir(exist_ok=True)
    lock = open(".cache/build.lock", "w")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        print("Waiting for another build in this directory to finish.", file=sys.stderr)
        fcntl.flock(lock, fcntl.LOCK_EX)
    return lock


def check_config():
    """Apply what the command line overrides, and go on only with a config that is right."""
    update_config(config, OVERRIDES)
    labels = remembered(ROOT / ".cache/labels.json", SOURCES.fingerprint(modules=LABELLED_BY))
    if found := config_checks.problems(config, labels):
        refuse(config_checks.complaints(found, CONFIG_FILE, OVERRIDES))
    config["figure_texts"] = figure_texts(ROOT, config)


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


if workflow.is_main_process:
    BUILD_LOCK = one_build_at_a_time()

try:
    OVERRIDES = config_checks.typed(config)
except ValueError as error:
    refuse([f"--config: {error}"])
try:
    config_checks.read(CONFIG_FILE)
except ValueError as error:
    refuse([f"{CONFIG_FILE}: {error}"])


wildcard_constraints:
    case="[a-z][a-z0-9_]+",
