"""Test calls of git: answers do not depend on user settings; missing git, refusals and modified files are reported."""

import os
import re
import shutil

import pytest

from archives import commit
from archives import git as run_git
from pipeline_trees import ROOT
from vibroimpact_pipeline import archive
from vibroimpact_pipeline.git import GitRefused, changes, committed, git, origin

SETTINGS = """
[core]
    autocrlf = true
    abbrev = 40
    attributesFile = {home}/attributes
    fsmonitor = {home}/monitor
    quotePath = true
[log]
    showSignature = true
[status]
    showUntrackedFiles = no
[tar]
    umask = 0777
[gpg]
    program = {home}/gpg
"""
GPG = """#!/bin/sh
case "$*" in
    *--verify*) echo "gpg: Good signature" >&2 ;;
    *) cat >/dev/null
       echo "[GNUPG:] SIG_CREATED " >&2
       printf -- '-----BEGIN PGP SIGNATURE-----\\n\\nx\\n-----END PGP SIGNATURE-----\\n' ;;
esac
"""
CITATION = "version: 0.1\ntitle: t\nlicense: MIT\nauthors: [{name: A}]\n"
UMLAUT = "zwei Kästen.txt"


@pytest.fixture
def repository(tmp_path):
    """Return a checkout with a signed commit."""
    root, gpg = tmp_path / "checkout", tmp_path / "gpg"
    gpg.write_text(GPG)
    gpg.chmod(0o755)
    for name in ("Makefile", ".gitignore", "workflow/set_up.sh"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, root / name)
    (root / "CITATION.cff").write_text(CITATION)
    (root / "Snakefile").touch()
    (root / UMLAUT).write_text("a\nb\n")
    commit(root)
    run_git(root, "-c", f"gpg.program={gpg}", "commit", "--amend", "--no-edit", "--gpg-sign")
    return root


@pytest.fixture
def settings_of_a_user(tmp_path, monkeypatch):
    """Return a function that sets options and variables which would change the output or the repository of git."""
    home, other = tmp_path / "home", tmp_path / "other"
    for folder in (home, other):
        folder.mkdir()
    (home / ".gitconfig").write_text(SETTINGS.format(home=home))
    (home / "attributes").write_text("*.sh export-ignore\nMakefile text eol=crlf\n")
    (home / "monitor").write_text(f"#!/bin/sh\ntouch {home}/started\n")
    shutil.copy(tmp_path / "gpg", home)
    (home / "monitor").chmod(0o755)
    (other / "file").touch()
    commit(other)
    variables = {
        "HOME": home, "GIT_DIR": other / ".git", "GIT_WORK_TREE": other, "GIT_INDEX_FILE": other / ".git/index",
        "GIT_CONFIG_COUNT": 1, "GIT_CONFIG_KEY_0": "core.autocrlf", "GIT_CONFIG_VALUE_0": "true",
        "TAR_OPTIONS": "--exclude=Makefile",
    }  # fmt: skip
    return lambda: [monkeypatch.setenv(name, str(value)) for name, value in variables.items()]


def answers(root):
    """Return the results of all functions that call git."""
    outputs = [git(*words.split(), root=root) for words in ("describe --always", "log -1 --format=%ct", "ls-files")]
    return committed(root), origin(root), changes(root), outputs


def test_settings_of_the_user_change_neither_answers_nor_archives(repository, settings_of_a_user, tmp_path):
    path, before = tmp_path / "archive.tar.gz", answers(repository)
    archive.write(repository, [], {}, path)
    content = path.read_bytes()
    settings_of_a_user()
    assert answers(repository) == before
    archive.write(repository, [], {}, path)
    assert path.read_bytes() == content
    assert before[1] == (before[0], "clean")
    assert not (tmp_path / "home/started").exists()


def test_uncommitted_changes_are_listed(repository, settings_of_a_user):
    settings_of_a_user()
    (repository / "Makefile").write_text("all:\n")
    (repository / "new.py").touch()
    (repository / UMLAUT).unlink()
    assert sorted(name.strip('"') for name in changes(repository)) == ["Makefile", "new.py", UMLAUT]
    assert origin(repository)[1] == "modified"
    with pytest.raises(ValueError, match=r"^uncommitted changes in .*Makefile.*; commit, ignore or remove them first$"):
        committed(repository)


def test_symbolic_links_to_results_are_not_changes(repository, tmp_path):
    for name in ("results", ".venv", ".cache", ".snakemake", "dist"):
        (repository / name).symlink_to(tmp_path)
    assert changes(repository) == []


@pytest.mark.parametrize("place", ["..", "copy", "."], ids=["outside", "inside another", "without the program"])
def test_a_folder_without_git_is_reported(repository, monkeypatch, place):
    (repository / "copy").mkdir()
    if place == ".":
        monkeypatch.setenv("PATH", "/nowhere")
    assert origin(repository / place) == (None, "without git")
    assert changes(repository / place) is None
    with pytest.raises(ValueError, match="not a git checkout"):
        committed(repository / place)


def test_a_refusal_by_git_is_reported_in_one_line_with_the_command_that_allows_access(
    repository, tmp_path, monkeypatch, capsys
):
    """For git, the checkout belongs to another user."""
    program, home = tmp_path / "bin/git", tmp_path / "home"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nGIT_TEST_ASSUME_DIFFERENT_OWNER=1 exec {shutil.which("git")} "$@"\n')
    program.chmod(0o755)
    for name, value in {"PATH": f"{program.parent}:{os.environ['PATH']}", "HOME": str(home), "LANGUAGE": "de"}.items():
        monkeypatch.setenv(name, value)
    allow = f"git config --global --add safe.directory {repository}"
    with pytest.raises(GitRefused, match=f"^git failed: fatal: .*{re.escape(str(repository))}.*{re.escape(allow)}$"):
        committed(repository)
    assert origin(repository) == (None, "refused by git")
    assert allow in capsys.readouterr().err
    home.mkdir()
    (home / ".gitconfig").write_text(f"[safe]\n    directory = {repository}\n")
    assert origin(repository)[1] == "clean"


def test_settings_of_line_ends_do_not_change_the_bytes_of_a_clone(tmp_path):
    """A shell cannot run scripts with carriage returns, and converted pictures would be damaged."""
    root, clone = tmp_path / "checkout", tmp_path / "clone"
    names = [".gitattributes", ".ci/run", "Makefile", "workflow/set_up.sh", "config/config.yaml"]
    names += ["figures/fig10_04.png", "src/vibroimpact_pipeline/html/mathematics/stix_two_math.woff"]
    for name in names:
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, root / name)
    (root / "text.pdf").write_bytes(b"%PDF-1.4\n%%EOF\n")
    commit(root)
    run_git(tmp_path, "-c", "core.autocrlf=true", "-c", "core.eol=crlf", "clone", root, clone)
    assert [name for name in [*names, "text.pdf"] if (clone / name).read_bytes() != (root / name).read_bytes()] == []


def test_only_one_module_calls_git():
    code = [path for top in ("src", "workflow") for end in ("*.py", "*.smk") for path in (ROOT / top).rglob(end)]
    calling = [path for path in code if re.search(r"""["']git["']""", path.read_text(encoding="utf-8"))]
    assert calling == [ROOT / "src/vibroimpact_pipeline/git.py"]
