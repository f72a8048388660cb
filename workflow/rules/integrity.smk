# Nothing wrong is called right: jobs learn which code this build began with, and before Snakemake looks at results,
# those go that are not what was written. See workflow/scripts/job.py for what each job does.

from snakemake.logging import logger
from snakemake_interface_logger_plugins.common import LogEvent

from vibroimpact_pipeline.integrity import code as code_of_this_build
from vibroimpact_pipeline.integrity.repair import remove_damaged


def makes(output):
    """Whether one of these rules makes it, not one of a workflow that uses this one as a module."""
    ours = str(ROOT / "workflow")
    return any(rule.is_producer(output) for rule in workflow.rules if str(rule.snakefile).startswith(ours))


def seeing_to_results(record):
    """Called with each event: the first of a build, which summaries, reports and graphs do not have."""
    if getattr(record, "event", None) == LogEvent.WORKFLOW_STARTED:
        try:
            remove_damaged(lambda line: print(line, file=sys.stderr), makes, workflow.output_settings.dryrun)
        except OSError as error:
            refuse([f"{error.filename}: cannot be removed ({error.strerror}). Remove it and build again."])
    return True


if workflow.is_main_process:
    code_of_this_build.write_down(SOURCES.files, SOURCES.stamps)
    logger.addFilter(seeing_to_results)
