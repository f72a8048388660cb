"""Run a job: write a log, check code and inputs before and after, and move outputs into place at the end."""

import ctypes
import os
import shutil
import signal
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import SimpleNamespace

from vibroimpact_pipeline import code
from vibroimpact_pipeline.result_records import (
    ModifiedResult,
    checked_digests,
    partial_path,
    put_in_place,
    write_record,
)

PR_SET_PDEATHSIG = 1
LOGS = Path("results/logs")


class Refused(RuntimeError):
    """Raised if the outputs of a job are not valid because code or inputs have changed."""


@contextmanager
def running(job) -> Iterator[SimpleNamespace]:
    """Run the body of a `with` statement as a Snakemake job; yield the temporary paths of the outputs.

    The yielded object has one attribute for each output, such as `out.json` for the output `json`. If code or inputs
    have changed, or if the body raises an exception, no output is moved into place.
    """
    if sys.platform == "linux":  # make the kernel terminate this process when its parent ends
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    in_snakemake = type(job).__module__.startswith("snakemake.")
    with ExitStack() as stack:
        if in_snakemake:
            stack.enter_context(logging_to(log_of(job)))
        try:
            behind = job.params.get("code", {"of": ()})
            before = code.change_times(*behind["of"])
            if behind["of"] and code.changed(behind):
                raise Refused("the code has changed since the build began; rerun the build")
            inputs = checked_digests(job.input)
            made_with = {"rule": job.rule, "wildcards": dict(job.wildcards.items())}
            partial = {name: partial_path(path) for name, path in job.output.items()}
            for path in partial.values():
                stack.callback(shutil.rmtree, path.parent)
            yield SimpleNamespace(**{name: str(path) for name, path in partial.items()})
            if code.change_times(*behind["of"]) != before:
                raise Refused("the code has changed while this job ran; rerun the build")
            if checked_digests(job.input) != inputs:
                raise Refused("an input has changed while this job ran; rerun the build")
            for name, path in job.output.items():
                put_in_place(partial[name], Path(path))
                write_record(path, made_with | {"inputs": inputs})
        except (Refused, ModifiedResult) as error:
            sys.exit(str(error))
        except ValueError as error:
            if line := with_key(error, job.params.get("config") or {}):
                sys.exit(line)
            raise
    if in_snakemake:  # skip the shutdown of the interpreter, which takes 0.3 s
        sys.stdout.flush()
        os._exit(0)


def log_of(job) -> Path:
    """Return the path of the log of a job, such as results/logs/RULE.log, where RULE is the name of the rule.

    If the rule has wildcards, each value adds a part to the path, as in results/logs/RULE/CASE.log.
    """
    folder = LOGS.joinpath(job.rule, *job.wildcards)
    return folder.with_name(f"{folder.name}.log")


def with_key(error, decided: dict) -> str | None:
    """Return the text of an error; extend the argument name at its beginning to a config key such as system.kappa.

    `decided` is a mapping from config keys to the config entries of the job. If no entry contains the argument, the
    result is None.
    """
    name, _, _ = str(error).partition(":")
    argument, _, _ = name.partition(".")
    holding = [key for key, value in decided.items() if isinstance(value, dict) and argument in value]
    holding += [key.removesuffix(f".{argument}") for key in decided if key.endswith(f".{argument}")]
    return f"{holding[0]}.{error}" if holding else None


@contextmanager
def logging_to(path) -> Iterator[None]:
    """Redirect the output of this process and its children to a log file.

    Errors are also printed on the terminal.
    """
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    terminal = os.dup(sys.stderr.fileno())
    with open(path, "w", encoding="utf-8") as log:
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
            os.dup2(log.fileno(), stream.fileno())
        try:
            yield
        except BaseException as error:
            message = str(error) if isinstance(error, SystemExit) else f"{type(error).__name__}: {error}"
            os.write(terminal, f"{message}\nFull log: {path}\n".encode())
            raise
