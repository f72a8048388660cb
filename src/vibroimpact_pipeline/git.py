"""What git says of the checkout."""

import subprocess


def git(*arguments: str, root=".") -> str | None:
    """The output of a git command in a directory, or None where there is no repository or no git."""
    try:
        run = subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return run.stdout.strip()
