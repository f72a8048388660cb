# Where the pipeline lies and where it works. Its own files it reads below ROOT; results, records and locks come into the
# working directory, which is another one with `snakemake --directory` and in a workflow that uses this one as a module.

import fcntl
import os
import shlex
import sys
from pathlib import Path

ROOT = Path(workflow.current_basedir.get_path_or_uri(secret_free=True)).parents[1]
LIBRARY = str(ROOT / "src")


def refuse(lines):
    print(*lines, sep="\n", file=sys.stderr)
    sys.exit(1)


def own(path):
    """A file of the pipeline itself: in the working directory by its short path, so that a checkout can be moved."""
    return path if os.path.samefile(ROOT, ".") else str(ROOT / path)


def one_build_at_a_time():
    """Wait for another build of this directory. The system frees the lock with the process, however it ends."""
    Path(".cache").mkdir(exist_ok=True)
    lock = open(".cache/build.lock", "w")
    # Of the process, not of the file: a workflow may use this one as a module several times.
    try:
        fcntl.lockf(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        print("Waiting for another build in this directory to finish.", file=sys.stderr)
        fcntl.lockf(lock, fcntl.LOCK_EX)
    return lock


if not ROOT.is_dir():
    refuse([f"{ROOT}: the pipeline reads notebooks and documents beside its rules; clone it and use it from the disk"])
if not any(Path(folder, "vibroimpact_pipeline").is_dir() for folder in os.getenv("PYTHONPATH", "").split(os.pathsep)):
    # The library beside these rules, whichever one is installed.
    os.environ.update(PYTHONPATH=os.pathsep.join(filter(None, [LIBRARY, os.getenv("PYTHONPATH")])))
    sys.path.insert(0, LIBRARY)
if os.path.exists(sys.executable):
    # Snakemake puts it into the command of each job as it is, which a space in its path would break.
    sys.executable = shlex.quote(sys.executable)
if workflow.is_main_process:
    BUILD_LOCK = one_build_at_a_time()
