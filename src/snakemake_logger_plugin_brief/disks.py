"""Disks without room, which fail a job in many words or none: even its log cannot be written there."""

import os

WRITTEN_TO = ("results", ".snakemake", ".cache")
ROOM = 1_000_000
"""Bytes below which a disk is called full."""


def full() -> list[str]:
    """Folders of a build that are on a disk without room for another file; some disks do not say how many they hold."""
    disks = {folder: os.statvfs(folder) for folder in WRITTEN_TO if os.path.exists(folder)}
    return [
        folder
        for folder, disk in disks.items()
        if disk.f_bavail * disk.f_frsize < ROOM or (disk.f_files and not disk.f_favail)
    ]
