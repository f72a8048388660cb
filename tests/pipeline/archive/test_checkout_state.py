"""Which state of the sources git tells, and that it tells nothing about what it does not track."""

import subprocess

import pytest

from vibroimpact_pipeline.archive.checkout_state import state
from vibroimpact_pipeline.git import git

DATE = "2020-02-03T04:05:06+00:00"


def run(root, *arguments):
    identity = ["-c", "user.name=A", "-c", "user.email=a@example.org"]
    subprocess.run(["git", *identity, *arguments], cwd=root, check=True, capture_output=True)


@pytest.fixture
def checkout(tmp_path, monkeypatch):
    """A checkout with two committed files, one of an awkward name, and one that git ignores."""
    monkeypatch.setenv("GIT_COMMITTER_DATE", DATE)
    root = tmp_path / "checkout"
    root.mkdir()
    for name, text in {"a.txt": "a\n", "b ü.txt": "b\n", ".gitignore": "ignored\n", "ignored": ""}.items():
        (root / name).write_text(text, encoding="utf-8")
    run(root, "init")
    run(root, "add", "--all")
    run(root, "commit", "--message", "all")
    return root


def test_a_clean_checkout(checkout):
    found = state(checkout)
    assert found.commit == git("rev-parse", "HEAD", root=checkout)
    assert found.date == DATE
    assert found.files == [".gitignore", "a.txt", "b ü.txt"]
    assert found.modified == found.unknown == []


def test_what_is_not_as_committed_is_told(checkout):
    (checkout / "a.txt").unlink()
    (checkout / "b ü.txt").write_text("changed\n")
    (checkout / "staged").write_text("staged\n")
    run(checkout, "add", "staged")
    (checkout / "new").write_text("new\n")
    found = state(checkout)
    assert found.files == [".gitignore", "b ü.txt", "staged"]
    assert found.modified == ["a.txt", "b ü.txt", "staged"]
    assert found.unknown == ["new"]


def test_no_checkout_and_no_commit_are_refused_by_name(tmp_path):
    with pytest.raises(ValueError, match=f"^{tmp_path} is no git checkout with a commit"):
        state(tmp_path)
    run(tmp_path, "init")
    (tmp_path / "a").touch()
    with pytest.raises(ValueError, match="is no git checkout with a commit"):
        state(tmp_path)


def test_a_copy_inside_another_repository_has_not_its_commit(checkout):
    inside = checkout / "ignored-by-none"
    inside.mkdir()
    (inside / "file").touch()
    assert git("rev-parse", "HEAD", root=inside) is None
    assert git("status", "--porcelain", root=inside) is None
    with pytest.raises(ValueError, match="is no git checkout"):
        state(inside)
    run(checkout, "add", "--all")
    assert git("rev-parse", "HEAD", root=inside) is not None
