"""From the events of Snakemake to what a user sees."""

import logging
import os
import threading
import time

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from snakemake_logger_plugin_brief.build import Build
from snakemake_logger_plugin_brief.jobs import by_the_scheduler
from snakemake_logger_plugin_brief.results import from_start, open_first
from snakemake_logger_plugin_brief.screen import Screen
from snakemake_logger_plugin_brief.words import count

SAID = ("Assuming ", "Building DAG", "Config file ", "Singularity containers: ignored", "Using shell")
"""What Snakemake says before it builds, by its beginnings; in a build its events say all that matters."""
SAID_AGAIN = ("Exiting because a job execution failed", "WorkflowError:\nAt least one job did not complete")
STOPS = ("Terminating processes on user request", "Will exit after finishing currently running jobs")
FULL_LOG = "Complete log(s): "
NOTHING = "Nothing to be done"


class LogHandler(LogHandlerBase):
    """Says what is done, what takes long, what has failed, and where the results are.

    Steps aside where Snakemake's own output is asked for: V=1 in the environment, a dry run, --verbose and its like.
    """

    writes_to_file = False
    has_filter = False
    has_formatter = False
    needs_rulegraph = False

    def __post_init__(self):
        asked = self.common_settings
        own = (asked.dryrun, asked.verbose, asked.printshellcmds, asked.debug_dag, asked.quiet)
        self._aside = any(own) or os.environ.get("V", "0") not in ("", "0")
        self._screen = Screen(colour=not asked.nocolor)
        self._build = None
        self._asked = []
        self._now = 0.0
        self._cause = ""
        self._over = threading.Event()
        self._reactions = {
            LogEvent.WORKFLOW_STARTED: self._workflow_started,
            LogEvent.RUN_INFO: self._run_info,
            LogEvent.JOB_INFO: self._job_info,
            LogEvent.JOB_FINISHED: self._job_finished,
            LogEvent.PROGRESS: self._progress,
            LogEvent.JOB_ERROR: self._job_error,
            LogEvent.ERROR: self._error,
            None: self._message,
        }
        if not self._aside:
            threading.Thread(target=self._clock, daemon=True).start()

    @property
    def writes_to_stream(self) -> bool:
        """Whether this handler stands in for Snakemake's own output."""
        return not self._aside

    def emit(self, record: logging.LogRecord) -> None:
        """Say what there is to say about a record."""
        react = self._reactions.get(getattr(record, "event", None))
        if react is None or self._aside:
            return
        try:
            self._now = record.created
            react(record)
            self._show_status()
        except Exception:
            self.handleError(record)

    def tick(self, now: float) -> None:
        """Say what time alone brings: failures, unless they come from an interruption, and jobs that take long."""
        self._now = now
        if self._build:
            self._screen.say(*self._build.failures())
            if not self._screen.live:
                self._screen.say(*self._build.long_jobs(now))
            self._screen.say(*self._build.silent_jobs(now))
            self._show_status()

    def close(self) -> None:
        """Say how the build has ended, once."""
        with self.lock:
            if self._build and not self._over.is_set():
                self._screen.say(*self._build.failures(), *self._cause.splitlines(), *self._build.summary(self._now))
            self._over.set()
        super().close()

    def _workflow_started(self, record):
        self._asked = record.cmd.split()

    def _run_info(self, record):
        self._build = Build(record)
        self._screen.say(f"{count(self._build.total, 'job')} to do. V=1 shows everything that Snakemake says.")

    def _job_info(self, record):
        self._build.start(record)

    def _job_finished(self, record):
        self._screen.say(*self._build.finish(record))

    def _progress(self, record):
        self._build.grow(record.total)

    def _job_error(self, record):
        self._build.fail(record, self._cause or by_the_scheduler(record))
        self._cause = ""

    def _error(self, record):
        text = record.getMessage()
        if self._build and record.exception == "RuleException":
            self._cause = text  # of the failure that is announced next
        elif not text.startswith(SAID_AGAIN):
            self._screen.say(text)

    def _message(self, record):
        text = record.getMessage()
        if text.startswith(NOTHING):
            self._screen.say(" ".join(["Nothing to do: all is up to date.", *open_first(self._asked)]))
        elif self._build and text.startswith(STOPS):
            self._build.stop()
        elif self._build and text.startswith(FULL_LOG):
            self._build.log = from_start(text.removeprefix(FULL_LOG))
        elif record.levelno > logging.INFO or not (self._build or text.startswith(SAID)):
            self._screen.say(*[text] * (not text.startswith(SAID_AGAIN)))

    def _show_status(self):
        if self._build:
            self._screen.status(self._build.status(self._now))

    def _clock(self):
        while not self._over.wait(1):
            with self.lock:
                self.tick(time.time())
