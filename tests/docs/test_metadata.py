"""What describes the project to others: citation, deposit, catalog, changelog, and the files of .github."""

import itertools
import json
import re
import tomllib

import pytest
import yaml
from packaging.version import Version

import matrix
import release
from pipeline_trees import ROOT

WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
FORMS = sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml"))


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


def bibtex(entry) -> dict[str, str]:
    """Type, key and fields of a BibTeX entry, without the braces that keep words together."""
    kind, key, fields = re.fullmatch(r"@(\w+)\{(\w+),\n(.*)\n\}\n", entry, re.DOTALL).groups()
    pairs = re.findall(r"^  (\w+) = \{(.*)\},$", fields, re.MULTILINE)
    assert len(pairs) == len(fields.splitlines())
    return {"type": kind, "key": key} | {name: re.sub("[{}]", "", value) for name, value in pairs}


def described(root):
    """pyproject's project, CITATION.cff, .zenodo.json, codemeta.json and CITATION.bib, each by a parser of its own."""
    texts = [(root / name).read_text(encoding="utf-8") for name in release.PLACES]
    parsers = (lambda text: tomllib.loads(text)["project"], yaml.safe_load, bibtex, json.loads, json.loads)
    return [parse(text) for parse, text in zip(parsers, texts, strict=True)]


def test_version_title_licence_authors_and_keywords_are_the_same_everywhere():
    project, citation, entry, deposit, meta = found = described(ROOT)
    assert {str(one["version"]) for one in found} == {project["version"]}
    assert citation["title"] == deposit["title"] == entry["title"].replace("`", "'")
    assert citation["license"] == deposit["license"] == project["license"]
    assert citation["keywords"] == deposit["keywords"] == meta["keywords"]
    assert set(project["keywords"]) <= set(citation["keywords"])
    assert meta["softwareRequirements"] == project["dependencies"]
    assert meta["runtimePlatform"] == f"Python {project['requires-python']}"
    lists = project["authors"], citation["authors"], deposit["creators"], meta["author"]
    assert [[one["name"] for one in names] for names in lists] == [["The maintainers of vibroimpact"]] * 4
    assert entry["author"] == citation["authors"][0]["name"]
    assert entry["author"].lower() in text("LICENSE").lower()
    assert (entry["type"], entry["key"]) == ("software", project["name"])


HEADINGS = re.findall(r"^## (.*)$", text("CHANGELOG.md"), re.MULTILINE)


def test_the_changelog_has_a_dated_section_for_each_version_newest_first_and_the_known_kinds_of_changes():
    assert HEADINGS[0] == "[Unreleased]"
    released = [re.fullmatch(r"\[(\d+\.\d+\.\d+)\] - (\d{4}-\d\d-\d\d)", heading).groups() for heading in HEADINGS[1:]]
    assert [date for _, date in released] == sorted((date for _, date in released), reverse=True)
    versions = [Version(version) for version, _ in released]
    assert versions == sorted(versions, reverse=True)
    now = Version(described(ROOT)[0]["version"])
    assert now in versions if not now.is_devrelease else all(now > version for version in versions)
    kinds = set(re.findall(r"^### (.*)$", text("CHANGELOG.md"), re.MULTILINE))
    assert kinds <= {"Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"}


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """The files that bear the version, for a release."""
    for name in (*release.PLACES, "CHANGELOG.md"):
        (tmp_path / name).write_text(text(name), encoding="utf-8")
    monkeypatch.setattr(release, "ROOT", tmp_path)
    return tmp_path


def test_a_release_is_the_same_version_everywhere_and_dated_and_the_next_one_is_not(copy, capsys):
    release.main(["77.1.0"])
    assert {one["version"] for one in described(copy)} == {"77.1.0"}
    date = described(copy)[1]["date-released"]
    assert described(copy)[2]["year"] == date[:4]
    log = (copy / "CHANGELOG.md").read_text(encoding="utf-8")
    assert f"## [Unreleased]\n\n## [77.1.0] - {date}\n\nThe" in log
    assert "git tag v77.1.0" in capsys.readouterr().out
    release.main(["--changes", "77.1.0"])
    assert capsys.readouterr().out.strip() == text("CHANGELOG.md").split("## [Unreleased]")[1].split("\n## ")[0].strip()
    release.main(["77.2.0.dev0"])
    assert {one["version"] for one in described(copy)} == {"77.2.0.dev0"}
    assert "date-released" not in described(copy)[1]
    assert (copy / "CHANGELOG.md").read_text(encoding="utf-8") == log


@pytest.mark.parametrize(
    ("version", "edit", "said"),
    [
        ("1.0", None, "expected a version such as 0.2.0"),
        ("77.1.0", ("CHANGELOG.md", "## [Unreleased]", "## [Unreleased]\n\n## [77.0.0] - 2026-01-01"), "no entries in"),
        ("77.1.0", ("CHANGELOG.md", "## [Unreleased]", "## [77.1.0] - 2026-01-01"), "77.1.0 already exists"),
        ("77.1.0", ("codemeta.json", '"version"', '"release"'), "found 0 times"),
    ],
)
def test_a_release_that_cannot_be_is_refused_in_a_line_and_changes_nothing(copy, capsys, version, edit, said):
    if edit:
        name, old, new = edit
        (copy / name).write_text(text(name).replace(old, new), encoding="utf-8")
    before = {path.name: path.read_bytes() for path in copy.iterdir()}
    with pytest.raises(SystemExit) as refused:
        release.main([version])
    assert said in str(refused.value) + capsys.readouterr().err
    assert {path.name: path.read_bytes() for path in copy.iterdir()} == before


def test_continuous_integration_runs_the_whole_matrix():
    asked = yaml.safe_load(text(".github/workflows/ci.yml"))["jobs"]["matrix"]["strategy"]["matrix"]
    combinations = set(itertools.product(asked["python"], asked["packages"]))
    assert combinations == set(itertools.product(matrix.named_pythons(ROOT), matrix.PACKAGES))


def test_actions_are_pinned_by_commits_and_the_same_in_every_workflow():
    used = re.findall(r"uses: (\S+)@(\S+)( # v[\d.]+)?\n", "".join(path.read_text() for path in WORKFLOWS))
    assert len(used) > 8
    assert all(re.fullmatch("[0-9a-f]{40}", commit) and version for _, commit, version in used)
    assert len({name for name, _, _ in used}) == len(set(used))


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_runs_what_the_makefile_has(path):
    targets = set(re.findall(r"^([a-z-]+):", text("Makefile"), re.MULTILINE))
    for line in re.findall(r"(?:- run: |vibroimpact )make ([a-z -]+)", path.read_text(encoding="utf-8")):
        assert set(line.split()) <= targets


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_only_the_job_that_publishes_may_write(path):
    workflow = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert workflow["permissions"] == {"contents": "read"}
    writing = [name for name, job in workflow["jobs"].items() if "write" in job.get("permissions", {}).values()]
    assert writing == (["publish"] if path.stem in ("pages", "release") else [])


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_an_issue_form_has_what_such_forms_need(path):
    form = yaml.safe_load(path.read_text(encoding="utf-8"))
    if path.stem != "config":
        assert {"name", "description", "body"} <= set(form)
        assert all(part["attributes"]["label"] for part in form["body"])
        assert len({part["id"] for part in form["body"]}) == len(form["body"])


def test_the_catalog_tells_of_files_that_are_there():
    catalog = yaml.safe_load(text(".snakemake-workflow-catalog.yml"))["usage"]
    assert catalog["mandatory-flags"]["flags"] == ""
    assert (ROOT / "workflow/Snakefile").exists()
    assert catalog["software-stack-deployment"]["apptainer"] == ("container:" in text("workflow/Snakefile"))
    assert catalog["software-stack-deployment"]["conda"]
    assert catalog["software-stack-deployment"]["conda"] == any((ROOT / "workflow").rglob("envs/*.yaml"))
    assert catalog["report"] == ("report(" in "".join(p.read_text() for p in (ROOT / "workflow/rules").glob("*.smk")))
    assert all(
        (ROOT / name).exists() for name in re.findall(r"[\w/]+\.(?:lock|md)", catalog["mandatory-flags"]["desc"])
    )
