"""What a command says of the config, looked at before Snakemake reads it: without bounds, and with tracebacks."""

import re
import runpy
import sys
from argparse import ArgumentParser
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from snakemake_interface_logger_plugins.settings import LogHandlerSettingsBase

READER = Path(__file__).parents[1] / "vibroimpact_pipeline/config/reading.py"
"""Run and not imported: rules that lie elsewhere bring a library of their own."""
ENTRY = re.compile(r"[a-zA-Z_][\w-]*\w=.*", re.DOTALL)
"""An override that Snakemake takes."""


@dataclass
class LogHandlerSettings(LogHandlerSettingsBase):
    """No settings; Snakemake makes them once it knows that this plugin is wanted, and before it reads any config."""

    def __post_init__(self):
        if lines := list(refusals(sys.argv[1:])):
            print(*lines, sep="\n", file=sys.stderr)
            sys.exit(1)


def refusals(arguments: list[str]) -> Iterator[str]:
    """A line for each file and each override on a command line that Snakemake could not read.

    None for a job of a build (--mode), which is given what was read.
    """
    parser = ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("--config", "-C", nargs="*", action="extend", default=[])
    parser.add_argument("--configfile", "--configfiles", nargs="+", action="extend", default=[])
    parser.add_argument("--mode", default="default")
    given, _ = parser.parse_known_args(arguments)
    if given.mode != "default":
        return
    reader = runpy.run_path(str(READER)) if given.configfile else {}
    for file in given.configfile:
        try:
            reader["read"](file)
        except ValueError as error:
            yield str(error)
    for entry in given.config:
        name, _, value = entry.partition("=")
        if not ENTRY.fullmatch(entry):
            target = "" if "=" in entry else "; targets come after --"
            yield f"--config: {entry[:60]!r} is no override: write {meant(name, value)}{target}"


def meant(name: str, value: str) -> str:
    """How an override is to be written that Snakemake does not take, system.kappa=0.7 say."""
    section, *keys = re.findall(r"\w\w+", name)[:5] or ["system", "kappa"]
    inner = value[:60] or "VALUE"
    for key in reversed(keys):
        inner = f"{{{key}: {inner}}}"
    return f"'{section}={inner}'"
