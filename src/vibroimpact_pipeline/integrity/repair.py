"""Outputs that are not what was written: they go before a build looks for what is there, and are made anew."""

import shutil
from collections.abc import Callable
from pathlib import Path

from vibroimpact_pipeline.integrity import checksums, memory


def remove_damaged(say: Callable[[str], None], dry_run: bool) -> None:
    """Say which outputs cannot be trusted, and remove them; a dry run leaves them where they are."""
    forgotten = {output: path for output, path in memory.forgotten() if checksums.has_record(output)}
    damaged = {*checksums.damaged(checksums.recorded()), *forgotten}
    for output in sorted(damaged):
        say(f"{output}: not what was written. {'A build removes it' if dry_run else 'Removed'}; made anew when needed.")
        if not dry_run:
            _remove(Path(output))
            forgotten.get(output, checksums.record_of(output)).unlink(missing_ok=True)


def _remove(output):
    if output.is_dir() and not output.is_symlink():
        shutil.rmtree(output)
    else:
        output.unlink(missing_ok=True)
