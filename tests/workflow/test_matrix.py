"""The matrix of Pythons and packages: which are found, what runs in which clone, and what is told of it."""

import json
import sys

import pytest

import matrix
from archives import git

MAKEFILE = """
set-up:
	echo "$(PYTHON) $$(cat environment.lock)" >>"$(CALLS)"
	mkdir -p .venv/bin results/figures
	cp tool .venv/bin/snakemake && cp tool .venv/bin/python
	test ! -e no-set-up
figures studies:
	.venv/bin/snakemake $@
check-figures:
	.venv/bin/snakemake figure_check
test-quick:
	@echo tested
"""
TOOL = """#!/bin/sh
echo "$(basename "$0") $*" >>"$CALLS"
case "$*" in *figure_check*) grep -q pinned environment.lock ;; esac
"""
UV = """#!/bin/sh
echo pinned >environment.lock
echo "uv $*" >>"$CALLS"
"""


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A committed project whose figures are not those of its reference with locked packages, and two Pythons."""
    root = tmp_path / "project"
    (root / ".venv/bin").mkdir(parents=True)
    classifiers = [f"Programming Language :: Python :: {version}" for version in ("3", "3.11", "3.12", "3.13")]
    files = {
        "Makefile": MAKEFILE,
        "tool": TOOL,
        "environment.lock": "locked\n",
        "pyproject.toml": f"[project]\nclassifiers = {json.dumps(classifiers)}\n",
        ".gitignore": "/.venv\n/.cache\n",
        ".venv/bin/uv": UV,
    }
    for name, text in files.items():
        (root / name).write_text(text)
    for path in (root / "tool", root / ".venv/bin/uv"):
        path.chmod(0o755)
    for version in ("3.11.9", "3.12.4"):
        python = tmp_path / f"pyenv/versions/{version}/bin/python3"
        python.parent.mkdir(parents=True)
        python.write_text(f"#!/bin/sh\necho {version.rpartition('.')[0]}\n")
        python.chmod(0o755)
    git(root, "init", "--quiet")
    git(root, "add", ".")
    git(root, "commit", "--quiet", "--message", "all")
    monkeypatch.setattr(matrix, "ROOT", root)
    monkeypatch.setattr(matrix.shutil, "which", lambda name: None)
    monkeypatch.setattr(sys, "executable", str(root / ".venv/bin/python"))
    monkeypatch.setenv("PYENV_ROOT", str(tmp_path / "pyenv"))
    monkeypatch.setenv("CALLS", str(tmp_path / "calls"))
    monkeypatch.setenv("MAKEFLAGS", "n")  # as from a make that runs this
    return root


def rows(output) -> list[list[str]]:
    """Cells of the table in an output, without head."""
    lines = [line for line in output.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def test_every_python_found_runs_with_every_set_of_packages_and_a_failure_is_told(project, tmp_path, capsys):
    assert matrix.main([]) == 1
    said = capsys.readouterr().out
    assert "Python 3.13: not found, skipped" in said
    table = rows(said)
    assert [row[:2] for row in table] == [[python, name] for python in ("3.11", "3.12") for name in matrix.PACKAGES]
    assert [row[4] == "failed" for row in table] == [True, False, False] * 2
    assert not any("failed" in row[2:4] + row[5:] or "not run" in row for row in table)
    places = project / ".cache/matrix"
    assert sorted(path.name for path in places.iterdir() if path.is_dir()) == ["3.11-lock", "3.12-lock"]
    assert "tested" in (places / "3.12-newest.log").read_text()
    calls = (tmp_path / "calls").read_text().splitlines()
    assert [line for line in calls if line.endswith(("locked", "pinned"))] == [
        f"{tmp_path}/pyenv/versions/{version}/bin/python3 {lock}"
        for version in ("3.11.9", "3.12.4")
        for lock in ("locked", "pinned", "pinned")
    ]
    resolved = [line.split("--resolution ")[1].split()[0] for line in calls if line.startswith("uv ")]
    assert resolved == ["lowest-direct", "highest"] * 2
    assert (project / "environment.lock").read_text() == "locked\n"
    assert not list((project / ".venv/bin").glob("snakemake"))


def test_what_is_asked_for_runs_and_nothing_else(project, capsys):
    assert matrix.main(["--python", "3.12", "--packages", "newest"]) == 0
    assert [row[:2] for row in rows(capsys.readouterr().out)] == [["3.12", "newest"]]


def test_without_a_set_up_nothing_more_runs(project, capsys):
    (project / "no-set-up").touch()
    git(project, "add", ".")
    git(project, "commit", "--quiet", "--message", "broken")
    assert matrix.main(["--python", "3.11", "--packages", "lowest"]) == 1
    assert rows(capsys.readouterr().out) == [["3.11", "lowest", "failed", *["not run"] * 3]]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--python", "3.13"], "argument --python: 3.13 not found on PATH or in pyenv"),
        (["--python", "3.10"], "invalid choice: '3.10'"),
        (["--packages", "oldest"], "invalid choice: 'oldest'"),
    ],
)
def test_what_cannot_run_is_refused_in_a_line(project, capsys, arguments, said):
    with pytest.raises(SystemExit):
        matrix.main(arguments)
    assert said in capsys.readouterr().err
    assert not (project / ".cache").exists()
