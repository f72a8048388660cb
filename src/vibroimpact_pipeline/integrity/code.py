"""The code of a build: which files each fingerprint was taken from, and their stamps then.

The rules take fingerprints before anything runs, jobs read the code later. What is not the same by then is not what
the fingerprint speaks of, even if it is put back before the job ends.
"""

import json
from pathlib import Path

from vibroimpact.figures.kit.files import replacing
from vibroimpact_pipeline.integrity.stamps import Changed, Stamp

LIST = Path(".cache/code.json")


def write_down(files: dict[str, list[str]], stamps: dict[str, Stamp]) -> None:
    """Hand on to the jobs of this build: the files by fingerprint, and the stamps by file."""
    with replacing(LIST) as partial:
        partial.write_text(json.dumps({"files": files, "stamps": stamps}), encoding="utf-8")


def stamps_of(fingerprint: str) -> dict[str, Stamp]:
    """The files of a fingerprint with their stamps.

    Raises:
        Changed: the build that goes on knows no such fingerprint.
    """
    try:
        known = json.loads(LIST.read_text(encoding="utf-8"))
        return {path: known["stamps"][path] for path in known["files"][fingerprint]}
    except (OSError, KeyError, ValueError):
        raise Changed(f"{LIST} does not list the code of this job: it was changed meanwhile. Build again.") from None
