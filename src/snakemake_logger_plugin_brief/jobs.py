"""A job: what is known of it while it runs, and what is told when it failed."""

import csv
import os
import re
from dataclasses import dataclass
from logging import LogRecord
from pathlib import Path

from snakemake_logger_plugin_brief.results import from_start
from snakemake_logger_plugin_brief.words import duration, words

LONG = 15
"""Seconds from which on a job takes long."""
USUAL_SILENCE = 300


def silence(text: str | None) -> float:
    """Seconds that SILENT_SECONDS tells, or the usual ones where it tells none."""
    return float(text) if text and re.fullmatch(r"\d+(\.\d+)?", text) else USUAL_SILENCE


SILENT = silence(os.environ.get("SILENT_SECONDS"))
"""Seconds without a line in its log from which on a job, if it also runs for longer than usual, may hang."""
LONGER = 2
"""How many times as long as in the last build a job runs that may hang, and until it is said again."""
TAIL = 15
"""Lines of a log that are shown."""
ENDED = re.compile(r"exit status \d+|(?<=Signals\.)\w+")
ASIDE = re.compile(r"\s*(sbatch call:|Detailed failure reason|For further error details).*", re.DOTALL)
"""What the plugin of a cluster adds: the whole command, and where else to look."""
NOT_TEXT = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]|[\x00-\x08\x0b-\x1f\x7f]")
"""Colours and other control characters."""


@dataclass
class Job:
    """One job. `seconds`: the time that it took, `usual`: that in the last build."""

    rule: str
    name: str
    started: float
    outputs: list[str]
    logs: list[str]
    usual: float | None
    seconds: float = 0.0
    told: bool = False
    silent_until: float = SILENT

    @classmethod
    def of(cls, record: LogRecord) -> "Job":
        """The job that a JOB_INFO event announces."""
        name = " ".join([words(record.rule_name), *record.wildcards.values()])
        return cls(record.rule_name, name, record.created, record.output, record.log, benchmarked(record.benchmark))

    def running(self, now: float) -> str:
        """Its name and for how long it has run; where that takes long, the time that it took in the last build."""
        usual = f", usually {duration(self.usual)}" if self.usual and self.usual >= LONG else ""
        return f"{self.name} ({duration(now - self.started)}{usual})"

    def may_hang(self, now: float) -> str | None:
        """What to say of it when it has been silent for long, and again when that has doubled."""
        silent = now - max(self.started, last_line(self.logs))
        if silent < self.silent_until or now - self.started < LONGER * (self.usual or 0):
            return None
        self.silent_until = LONGER * silent
        return f"silent for {duration(silent)}: {self.running(now)}"


def last_line(logs: list[str]) -> float:
    """When the logs were written to last, in seconds since 1970; 0 without any."""
    return max((os.path.getmtime(log) for log in logs if os.path.exists(log)), default=0.0)


def benchmarked(benchmark: str | None) -> float | None:
    """The time in seconds in a benchmark file that Snakemake wrote, if there is one."""
    try:
        with open(benchmark or "", encoding="utf-8") as file:
            return float(next(csv.DictReader(file, delimiter="\t"))["s"])
    except (OSError, StopIteration, KeyError, ValueError):
        return None


def tail(log: str) -> list[str]:
    """The last lines of a log, without control characters."""
    try:
        text = Path(log).read_text(encoding="utf-8", errors="replace")
    except OSError:
        text = ""
    return [NOT_TEXT.sub("", line) for line in text.rstrip().splitlines()[-TAIL:]] or ["(nothing)"]


def by_the_scheduler(record: LogRecord) -> str:
    """What the scheduler of a cluster says of a failed job, if one does, in a JOB_ERROR event."""
    return ASIDE.sub("", getattr(record, "rule_msg", None) or "")


def failure(name: str, logs: list[str], cause: str) -> list[str]:
    """What is told of a job that failed: how it ended and the end of its log; the cause, where it is no exit status."""
    ended = ENDED.search(cause)
    lines = [
        line for log in logs for line in (f"Its log {from_start(log)} ends:", *(f"  {line}" for line in tail(log)))
    ]
    lines += [] if ended else cause.splitlines()
    return [f"Failed: {name}{f' ({ended[0]})' if ended else ''}", *(f"  {line}" for line in lines)]
