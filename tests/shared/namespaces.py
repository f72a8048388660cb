"""Run commands in Linux namespaces, as another user, with other mounts, or without network.

If the system does not allow namespaces, the tests that need them are skipped.
"""

import subprocess

import pytest


def unshared(*options: str) -> list[str]:
    """Return the words to put before a command: `unshare` with options."""
    command = ["unshare", *options]
    if subprocess.run([*command, "true"], stderr=subprocess.DEVNULL, check=False).returncode:
        pytest.skip(f"{' '.join(command)} is not allowed here")
    return command
