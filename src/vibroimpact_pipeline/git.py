"""Every call of git, with the same answer whatever the settings and variables of the user are."""

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
"""Settings that change the output of git or the bytes of a checkout. Others of the user count, as safe.directory."""
ABSENT = "not a git repository"
"""What git prints outside a repository."""
SHOWN = 4
"""Changed paths in a message."""


class GitRefused(ValueError):
    """There is a repository, and git does not read it: its directory belongs to somebody else, for instance."""


def call(*arguments, root=".", **variables) -> subprocess.CompletedProcess:
    """Run a git command in a directory, in English, without variables that name another repository.

    Args:
        variables: further variables of its environment.

    Raises:
        OSError: there is no git.
    """
    kept = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    neutral = [word for setting in SETTINGS.items() for word in ("-c", "=".join(setting))]
    environment = kept | {"LC_ALL": "C", "GIT_ATTR_NOSYSTEM": "1"} | variables
    return subprocess.run(["git", *neutral, *arguments], cwd=root, env=environment, capture_output=True)


def output(*arguments, root=".") -> bytes:
    """Return the output of a git command in a repository.

    Raises:
        GitRefused: the command failed; the message is git's, in one line.
    """
    run = call(*arguments, root=root)
    if run.returncode:
        raise GitRefused(f"git refuses: {' '.join(run.stderr.decode('utf-8', 'replace').split())}")
    return run.stdout


def git(*arguments, root=".") -> str | None:
    """Return the output of a git command in a directory, or None if git does not track that directory.

    That is so without git, without a repository, and in a copy of the pipeline that lies inside another repository,
    whose commit and changes say nothing about it.

    Raises:
        GitRefused: git does not read the repository.
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
    """Return the paths of a checkout that differ from its commit, untracked ones too, or None (see `git`)."""
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

    Raises:
        ValueError: there is no git checkout, git does not read it, or it differs from its commit.
    """
    commit, changed = git("rev-parse", "HEAD", root=root), changes(root)
    if changed is None:
        raise ValueError("there is no git, or no git repository of the pipeline: the archive holds a commit")
    if changed:
        more = f" and {len(changed) - SHOWN} more" if len(changed) > SHOWN else ""
        raise ValueError(f"not committed: {', '.join(changed[:SHOWN])}{more}. Commit, ignore or remove them first")
    return commit
