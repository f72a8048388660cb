"""Output of git commands in the checkout."""

import subprocess
from pathlib import Path


def git(*arguments: str, root=".") -> str | None:
    """Return the output of a git command in a directory, or None if git does not track that directory.

    That is so without git, without a repository, and in a copy of the pipeline that lies inside another repository,
    whose commit and changes say nothing about it.
    """
    return _run(*arguments, root=root) if _run("ls-files", "--error-unmatch", ".", root=root) else None


def _run(*arguments, root):
    try:
        run = subprocess.run(["git", *arguments], cwd=root, capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return run.stdout.strip()


def committed(root: Path) -> str:
    """Return the commit of a clean git checkout.

    Raises:
        ValueError: it is no git checkout, or differs from its commit.
    """
    commit = git("rev-parse", "HEAD", root=root)
    if commit is None or git("status", "--porcelain", root=root):
        raise ValueError("archive: commit all changes first: the archive holds a commit and what it makes")
    return commit
