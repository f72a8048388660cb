"""Run git so that its output does not depend on settings and environment variables of the user."""

import os
import subprocess
import sys

SETTINGS = {
    "core.abbrev": "auto",
    "core.attributesFile": os.devnull,
    "core.autocrlf": "false",
    "core.fsmonitor": "false",
    "core.quotePath": "false",
    "log.showSignature": "false",
    "tar.umask": "0002",
}
"""Values for settings that affect output or archives. All other settings, such as safe.directory, are the user's."""
ABSENT = "not a git repository"
"""Part of the message that git prints outside a repository."""
MAX_PATHS = 4
"""Maximum number of changed paths in a message."""


class GitRefused(ValueError):
    """Raised if a git command fails, for example because another user owns the directory of the repository."""


def output(*arguments, root=".") -> bytes:
    """Run a git command in the directory `root` and return the output of the command.

    The output is in English. Environment variables that could select another repository are ignored.

    Raises
    ------
    OSError
        If git is not installed.
    GitRefused
        If the command fails.
    """
    kept = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    neutral = [word for setting in SETTINGS.items() for word in ("-c", "=".join(setting))]
    environment = kept | {"LC_ALL": "C", "GIT_ATTR_NOSYSTEM": "1"}
    run = subprocess.run(["git", *neutral, *arguments], cwd=root, env=environment, capture_output=True)
    if run.returncode:
        raise GitRefused(f"git failed: {' '.join(run.stderr.decode('utf-8', 'replace').split())}")
    return run.stdout


def git(*arguments, root=".") -> str | None:
    """Return the output of a git command, or None if git tracks no file of the directory.

    The result is also None if git is not installed.

    Raises
    ------
    GitRefused
        If git fails inside a repository.
    """
    try:
        tracked = output("ls-files", "-z", ".", root=root)
    except OSError:
        return None
    except GitRefused as refused:
        if ABSENT in str(refused):
            return None
        raise
    return output(*arguments, root=root).decode("utf-8", "surrogateescape").rstrip("\n") if tracked else None


def changes(root=".") -> list[str] | None:
    """Return modified and untracked paths of a checkout, or None if git does not track the checkout."""
    listed = git("status", "--porcelain", "--untracked-files=normal", "--ignore-submodules=none", ".", root=root)
    return None if listed is None else [line[3:] for line in listed.splitlines()]


def origin(root) -> tuple[str | None, str]:
    """Return the commit of a checkout and its state: "clean", "modified", "without git" or "refused by git"."""
    try:
        commit, changed = git("rev-parse", "HEAD", root=root), changes(root)
    except GitRefused as refused:
        print(refused, file=sys.stderr)
        return None, "refused by git"
    return commit, "without git" if changed is None else "modified" if changed else "clean"


def committed(root) -> str:
    """Return the commit of a clean git checkout.

    Raises
    ------
    ValueError
        If `root` is not a clean git checkout.
    """
    commit, changed = git("rev-parse", "HEAD", root=root), changes(root)
    if changed is None:
        raise ValueError("the pipeline is not a git checkout, or git is not installed; an archive needs a commit")
    if changed:
        more = f" and {len(changed) - MAX_PATHS} more" if len(changed) > MAX_PATHS else ""
        shown = ", ".join(changed[:MAX_PATHS])
        raise ValueError(f"uncommitted changes in {shown}{more}; commit, ignore or remove them first")
    return commit
