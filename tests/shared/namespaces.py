"""Commands in surroundings of their own: another user, other disks, no network. Linux may not allow that: then a test
that needs it is skipped."""

import subprocess

import pytest


def unshared(*options: str) -> list[str]:
    """What to put before a command: `unshare` with options."""
    command = ["unshare", *options]
    if subprocess.run([*command, "true"], stderr=subprocess.DEVNULL, check=False).returncode:
        pytest.skip(f"{' '.join(command)} is not allowed here")
    return command


def mounted(script: str) -> list[str]:
    """The same with mounts that a line of shell makes before, relative to where the command starts."""
    return [*unshared("--mount"), "sh", "-c", f'{script} && cd "$PWD" && exec "$@"', "sh"]


def read_only(folder: str) -> list[str]:
    """The same with a folder that nobody can write to."""
    return mounted(f"mount --bind {folder} {folder} && mount -o remount,bind,ro {folder}")
