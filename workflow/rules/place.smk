# Where the pipeline lies and where it works. Its own files it reads below ROOT; results, records and locks come into the
# working directory, which is another one with `snakemake --directory` and in a workflow that uses this one as a module.

import os
import shlex
import sys
import time
from pathlib import Path

ROOT = Path(workflow.current_basedir.get_path_or_uri(secret_free=True)).parents[1]
LIBRARY = str(ROOT / "src")


def refuse(lines):
    print(*lines, sep="\n", file=sys.stderr)
    sys.exit(1)


def own(path):
    """A file of the pipeline itself: in the working directory by its short path, so that a checkout can be moved."""
    return path if os.path.samefile(ROOT, ".") else str(ROOT / path)


def demand(work, *arguments):
    """Do what the working directory must allow, or refuse to build there."""
    try:
        return work(*arguments)
    except OSError as error:
        refuse([f"{error.filename}: {error.strerror}. {build_directory.MENDED_BY}"])


if not ROOT.is_dir():
    refuse([f"{ROOT}: the pipeline reads notebooks and documents beside its rules; clone it and use it from the disk"])
if not any(Path(folder, "vibroimpact_pipeline").is_dir() for folder in os.getenv("PYTHONPATH", "").split(os.pathsep)):
    # The library beside these rules, whichever one is installed.
    os.environ.update(PYTHONPATH=os.pathsep.join(filter(None, [LIBRARY, os.getenv("PYTHONPATH")])))
    sys.path.insert(0, LIBRARY)
if os.path.exists(sys.executable):
    # Snakemake puts it into the command of each job as it is, which a space in its path would break.
    sys.executable = shlex.quote(sys.executable)
from vibroimpact_pipeline import build_directory, left_jobs, slurm_plugin
from vibroimpact_pipeline.quick_end import end_quickly

if workflow.is_main_process:
    end_quickly()
    demand(build_directory.check_access)
    BUILD_LOCK = demand(build_directory.lock)
    if BUILD_LOCK and workflow.modifier.is_main_snakefile():
        build_directory.sweep(time.time())


def prepare_cluster():
    """What jobs elsewhere rely on: none is left from before, and code is compiled once and not by each of them."""
    if workflow.executor_settings.__class__.__module__.startswith("snakemake_executor_plugin_slurm"):
        try:
            left_jobs.end_left_jobs()
            slurm_plugin.heed_options(workflow.executor_settings)
        except (OSError, RuntimeError) as error:
            refuse([str(error)])
    shell(f"{sys.executable} {shlex.quote(str(ROOT / 'workflow/scripts/compile.py'))}")


onstart:
    demand(build_directory.check_room)
    if not workflow.local_exec:
        prepare_cluster()
