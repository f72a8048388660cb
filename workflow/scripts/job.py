"""What the adapters share: a log file for each job, and that nothing wrong goes into a result or comes out as one."""

import os
import sys
from contextlib import ExitStack, contextmanager
from pathlib import Path

from vibroimpact_pipeline.checkout import root_of
from vibroimpact_pipeline.integrity import cases, checksums, compiled
from vibroimpact_pipeline.integrity.code import stamps_of
from vibroimpact_pipeline.integrity.stamps import Changed, Stamp, stamps, unchanged
from vibroimpact_pipeline.quick_end import end_quickly


@contextmanager
def running(job):
    """The frame of a Snakemake job: it fails, with a line in its log, unless

    - its code is the same, from when the build began until the job ends;
    - its inputs are what the jobs before wrote, of the case that it is about, and stay so.

    At the end its outputs go on record.
    """
    end_quickly()
    with ExitStack() as stack:
        if job.log:
            stack.enter_context(logging_to(job.log[0]))
        checksums.forget(job.output)
        try:
            code = compiled.from_unchanged(code_of(job.params), root_of(job), Path.cwd())
            with unchanged(stamps(files_of(job.input))), code:
                check(job.input, case_of(job))
                yield
        except (Changed, checksums.Damaged, cases.OtherCase) as error:
            sys.exit(str(error))
        checksums.record(job.output)


@contextmanager
def logging_to(path):
    """Send everything that this process and its children print to a log file."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="utf-8") as log:
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
            os.dup2(log.fileno(), stream.fileno())
        yield


def code_of(params) -> dict[str, Stamp]:
    """The files of the job's own code with their stamps; of a figure the last step in its record tells."""
    recorded = params.get("provenance")
    fingerprint = recorded["steps"][-1]["fingerprint"] if recorded else params.get("code")
    return stamps_of(fingerprint) if fingerprint else {}


def files_of(inputs) -> list[Path]:
    """The inputs, and the files below those that are directories."""
    paths = [Path(path) for path in inputs]
    below = [file for path in paths if path.is_dir() for file in path.rglob("*") if file.is_file()]
    return [path for path in paths if path.is_file()] + below


def check(inputs, case: str | None) -> None:
    """See that inputs are as they were written, and of one case where the job is about one."""
    checksums.expect(inputs)
    if case:
        cases.expect(case, inputs)


def case_of(job) -> str | None:
    """The case that a job is about, if it is about one."""
    return job.wildcards.get("case") or job.params.get("settings", {}).get("case")
