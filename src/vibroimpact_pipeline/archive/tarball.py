"""Files -> one .tar.gz, with the same bytes whenever, wherever and by whomever it is written."""

import gzip
import io
import os
import tarfile
from pathlib import Path

LEVEL = 9


def write(path, folder: str, members: dict[str, Path | bytes], time: int) -> None:
    """Write an archive.

    Args:
        path: of the archive.
        folder: that all members lie in.
        members: by their names in the folder, a file or link on the disk, or a content.
        time: seconds since 1970, the date of every member.
    """
    with (
        open(path, "wb") as file,
        gzip.GzipFile(filename="", mode="wb", compresslevel=LEVEL, fileobj=file, mtime=0) as packed,
        tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive,
    ):
        for name, source in sorted(members.items()):
            member = tarfile.TarInfo(f"{folder}/{name}")
            member.mtime = time
            _add(archive, member, source)


def _add(archive, member, source):
    if isinstance(source, bytes):
        content = source
    elif source.is_symlink():
        member.type, member.linkname = tarfile.SYMTYPE, os.readlink(source)
        return archive.addfile(member)
    else:
        content = source.read_bytes()
        member.mode = 0o755 if os.access(source, os.X_OK) else 0o644
    member.size = len(content)
    return archive.addfile(member, io.BytesIO(content))
