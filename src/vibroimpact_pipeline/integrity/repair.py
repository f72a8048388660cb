"""Outputs that cannot be trusted: they go before a build looks for what is there, and are made anew."""

import shutil
from collections.abc import Callable
from pathlib import Path

from vibroimpact_pipeline.integrity import checksums, memory

DAMAGED = "not what was written"
FORGOTTEN = "how it was made is not known any more"


def remove_damaged(say: Callable[[str], None], makes: Callable[[str], bool], dry_run: bool) -> None:
    """Say which outputs cannot be trusted, and remove them; a dry run leaves them where they are.

    Args:
        say: prints a line.
        makes: whether this pipeline has a rule for a path; what it could not make anew stays, whoever wrote it.
        dry_run: whether nothing is to be changed.

    Raises:
        OSError: one of them cannot be removed.
    """
    forgotten = {output: path for output, path in memory.forgotten() if checksums.has_record(output)}
    why = dict.fromkeys(checksums.damaged(checksums.recorded()), DAMAGED) | dict.fromkeys(forgotten, FORGOTTEN)
    for output, reason in sorted((output, reason) for output, reason in why.items() if makes(output)):
        say(f"{output}: {reason}. {'A build removes it' if dry_run else 'Removed'}; made anew when needed.")
        if not dry_run:
            _remove(Path(output))
            checksums.forget([output])
            if output in forgotten:
                forgotten[output].unlink()


def _remove(output):
    if output.is_dir() and not output.is_symlink():
        shutil.rmtree(output)
    else:
        output.unlink(missing_ok=True)
