"""The course of a build: what is done, what runs, what has failed. Events go in, lines to show come out."""

import math
import re
from logging import LogRecord

from snakemake_logger_plugin_brief.disks import full
from snakemake_logger_plugin_brief.jobs import LONG, Job, failure
from snakemake_logger_plugin_brief.processes import stopped
from snakemake_logger_plugin_brief.results import made, open_first
from snakemake_logger_plugin_brief.words import count, duration, words

INTERRUPTED = re.compile("SIGINT|exit status 130")


class Build:
    """One run of Snakemake over its jobs; times are seconds since 1970."""

    def __init__(self, record: LogRecord):
        """From the RUN_INFO event."""
        self.began = record.created
        self.total = self.foreseen = record.stats["total"]
        self.jobs_of = record.stats
        self.running: dict[int, Job] = {}
        self.finished: list[Job] = []
        self.failed: dict[int, str] = {}
        self.untold: list[str] = []
        self.stopped = False
        self.log = ".snakemake/log/"

    def start(self, record: LogRecord) -> None:
        """From a JOB_INFO event."""
        self.running[record.jobid] = Job.of(record)

    def finish(self, record: LogRecord) -> list[str]:
        """From a JOB_FINISHED event: a line when it was the last job of its rule, with the time of all of them."""
        job = self.running.pop(record.job_id)
        job.seconds = record.created - job.started
        self.failed.pop(record.job_id, None)
        self.finished.append(job)
        alike = [done for done in self.finished if done.rule == job.rule]
        if len(alike) < self._expected(job.rule) or not (job.outputs or job.logs):
            return []
        name = job.name if len(alike) == 1 else f"{words(job.rule)} ({len(alike)})"
        return [f"{self.progress()}  {duration(sum(done.seconds for done in alike)):>12}  {name}"]

    def grow(self, total: int) -> None:
        """From a PROGRESS event: a checkpoint may have brought further jobs."""
        self.total = total

    def fail(self, record: LogRecord, cause: str) -> None:
        """From a JOB_ERROR event and the message of the error before it."""
        job = self.running.pop(record.jobid, None)
        self.failed[record.jobid] = record.rule_name
        if not (self.stopped or INTERRUPTED.search(cause)):
            self.untold += failure(job.name if job else words(record.rule_name), record.log, cause)

    def failures(self) -> list[str]:
        """What is to tell of jobs that have failed since the last call."""
        told, self.untold = self.untold, []
        return told

    def stop(self) -> None:
        """On an interruption, which the jobs that run do not survive: that is no failure of theirs."""
        self.stopped, self.untold = True, []

    def _expected(self, rule):
        """Jobs of a rule; of one that nobody foresaw all that were not foreseen, once their number is known."""
        return self.jobs_of.get(rule, self.total - self.foreseen or math.inf)

    def progress(self) -> str:
        """How many jobs are done of how many, in columns that stay straight."""
        return f"{len(self.finished):>{len(str(self.total))}} of {self.total}"

    def status(self, now: float) -> str:
        """The one line that changes; nothing while a job that has no log speaks itself."""
        jobs = self.running.values()
        running = ", ".join(job.running(now) for job in jobs)
        return f"{self.progress()}  {running}" if all(job.logs for job in jobs) else ""

    def long_jobs(self, now: float) -> list[str]:
        """A line for each job that has come to run for long since the last call."""
        jobs = [job for job in self.running.values() if now - job.started >= LONG and not job.told]
        for job in jobs:
            job.told = True
        return [f"{self.progress()}  still running: {job.running(now)}" for job in jobs]

    def silent_jobs(self, now: float) -> list[str]:
        """A line for each job that may hang, and one on processes that somebody has stopped."""
        silent = [said for job in self.running.values() if (said := job.may_hang(now))]
        return [*(f"{self.progress()}  {said}" for said in silent), *(stopped() if silent else [])]

    def summary(self, now: float) -> list[str]:
        """The last lines: how it ended, how long it took, where the results are."""
        took = duration(now - self.began)
        if self.stopped:
            return [f"Stopped after {took}, {self.progress().strip()} done. The same command goes on from here."]
        if len(self.finished) < self.total:
            failed = f" Failed: {', '.join(self.failed.values())}." if self.failed else ""
            no_room = [f"No room on the disk of {folder}/. Make some; the same command goes on." for folder in full()]
            ended = f"Not finished after {took}, {self.progress().strip()} done.{failed} The full log: {self.log}"
            return [*no_room, ended]
        outputs = [path for job in self.finished for path in job.outputs]
        done = f"Done in {took}: {count(self.total, 'job')}. {made(outputs)}."
        return [done, *open_first(job.rule for job in self.finished[-1:])]
