"""Parse the command line, write the table of a command and its plot, and report errors on one line."""

import argparse
import os
import re
import sys
from importlib import import_module
from pathlib import Path

import vibroimpact
from vibroimpact.cli.commands import COMMANDS, NAMES, Table, add_system_options
from vibroimpact.system import System
from vibroimpact.system.chapter import CASES, PARAMETERS


class _Parser(argparse.ArgumentParser):
    """Argument parser that reports errors on one line and accepts -1e-3 as a number."""

    def __init__(self, **settings):
        super().__init__(**settings)
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message):
        self.exit(2, f"{self.prog}: {message} (see {self.prog} --help)\n")


def main(arguments: list[str] | None = None) -> int:
    """Run one command and return 0.

    Exit with status 2 for invalid arguments, and with status 1 for a failed computation.
    """
    options = parser().parse_args(arguments)
    options.run(options)
    return 0


def parser() -> argparse.ArgumentParser:
    """Return the parser with all commands."""
    top = _Parser(prog="vibroimpact", description=vibroimpact.__doc__.splitlines()[0])
    top.add_argument("--version", action="version", version=f"vibroimpact {vibroimpact.__version__}")
    commands = top.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, command in COMMANDS.items():
        own = commands.add_parser(name, help=command.help, description=command.help, allow_abbrev=False)
        command.add_options(own)
        own.add_argument("--output", type=Path, metavar="FILE", help="write the CSV to this file")
        if command.of_system:
            add_system_options(own)
        own.set_defaults(run=_run, command=name, parser=own)
    words = "compile the simulation code in advance, once per user"
    compiling = commands.add_parser("compile", help=words, description=words)
    compiling.set_defaults(run=lambda options: import_module("vibroimpact.compile").main())
    return top


def _run(options):
    """Compute the table of a command, save or print the result, and save its plot if one is requested."""
    try:
        _check_folders(options)
        command, systems = COMMANDS[options.command], []
        if command.of_system:
            given = {name: value for name in NAMES if (value := getattr(options, name)) is not None}
            systems = [System(**PARAMETERS | CASES[options.case] | given)]
        table = command.compute(*systems, options)
        _put(table, options.output)
        if getattr(options, "plot", None):
            _draw(table, options)
    except (ValueError, ImportError) as error:
        options.parser.error(str(error))
    except (ArithmeticError, OSError) as error:
        options.parser.exit(1, f"{options.parser.prog}: {error}\n")


def _check_folders(options):
    """Raise ValueError if an output file cannot be written; called before anything is computed."""
    for name in ("output", "plot"):
        path = getattr(options, name, None)
        if path is None:
            continue
        if not path.parent.is_dir():
            raise ValueError(f"{name}: folder {path.parent} does not exist")
        if path.is_dir():
            raise ValueError(f"{name}: {path} is a folder, expected the name of a file")
        if not os.access(path if path.exists() else path.parent, os.W_OK):
            raise ValueError(f"{name}: {path} is not writable")


def _put(table: Table, output: Path | None):
    """Write the table to `output`, if given, and print the summary, if there is one.

    Print the table if there is neither an output file nor a summary, or if the file cannot be written.
    """
    failed = None
    try:
        if output is not None:
            with open(output, "w", encoding="utf-8", newline="") as file:
                table.write(file)
    except OSError as error:
        failed = OSError(f"output: {output} cannot be written ({error.strerror}), so the table was printed instead")
    try:
        if table.answer:
            print(table.answer, flush=True)
        if failed or (output is None and not table.answer):
            table.write(sys.stdout)
            sys.stdout.flush()
    except BrokenPipeError:  # the reading end of the pipe was closed, by `head` for example
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if failed:
        raise failed


def _draw(table, options):
    """Save the plot of a result, in the style of the project; the result itself is already printed or saved."""
    os.environ["MPLBACKEND"] = "agg"  # Matplotlib fails to load if MPLBACKEND names a missing backend
    try:
        from vibroimpact.figures.plotting.style import save, styled

        save(styled(table.plot)(), {options.plot.suffix.removeprefix("."): options.plot})
    except Exception as error:  # drawing may raise any error, since it reads fonts and may run other programs
        reason = f"{error}".strip().partition("\n")[0]
        options.parser.exit(1, f"{options.parser.prog}: plot: {options.plot} cannot be saved: {reason}\n")
