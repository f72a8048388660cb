"""Which state of the sources goes into an archive: the commit, its date, and what is not as committed."""

import os
from dataclasses import dataclass
from pathlib import Path

from vibroimpact_pipeline.git import git


@dataclass(frozen=True)
class State:
    """The state of a checkout.

    commit: in full; date: of the commit, ISO 8601; files: those that git tracks and the disk has, paths from the root;
    modified: tracked files that are not as committed; unknown: files that git neither tracks nor ignores.
    """

    commit: str
    date: str
    files: list[str]
    modified: list[str]
    unknown: list[str]


def state(root) -> State:
    """The state of the checkout at root.

    Raises:
        ValueError: it is no git checkout, or has no commit.
    """
    committed = git("log", "-1", "--format=%H %cI", root=root)
    if not committed:
        raise ValueError(f"{root} is no git checkout with a commit, which tells sources from other files: use a clone")
    commit, date = committed.split()
    tracked = [name for name in _names(root, "ls-files") if os.path.lexists(Path(root) / name)]
    modified = _names(root, "diff", "--name-only", "HEAD")
    return State(commit, date, tracked, modified, _names(root, "ls-files", "--others", "--exclude-standard"))


def _names(root, *command):
    listed = git(*command, "-z", root=root) or ""
    return sorted(filter(None, listed.split("\0")))
