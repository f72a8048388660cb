"""Test the metadata of the project: citation, archive deposit, changelog and files in .github."""

import json
import re
import tomllib

import pytest
import yaml
from packaging.version import Version

from pipeline_trees import ROOT

WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
PLACES = "pyproject.toml", "CITATION.cff", "CITATION.bib", ".zenodo.json", "codemeta.json"


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


def bibtex(entry) -> dict[str, str]:
    """Return type, key and fields of a BibTeX entry, without braces around words."""
    kind, key = re.match(r"@(\w+)\{(\w+),", entry).groups()
    fields = dict(re.findall(r"^  (\w+) = \{(.*)\},$", entry, re.MULTILINE))
    return {"type": kind, "key": key} | {name: re.sub("[{}]", "", value) for name, value in fields.items()}


def metadata():
    """Return the parsed contents of pyproject.toml, CITATION.cff, CITATION.bib, .zenodo.json and codemeta.json."""
    parsers = (lambda text: tomllib.loads(text)["project"], yaml.safe_load, bibtex, json.loads, json.loads)
    return [parse(text(name)) for parse, name in zip(parsers, PLACES, strict=True)]


def test_version_title_licence_authors_and_keywords_agree_in_all_files():
    project, citation, entry, deposit, meta = found = metadata()
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


def test_the_changelog_has_a_dated_section_for_each_version_newest_first():
    unreleased, *headings = re.findall(r"^## (.*)$", text("CHANGELOG.md"), re.MULTILINE)
    assert unreleased == "[Unreleased]"
    released = [re.fullmatch(r"\[(\d+\.\d+\.\d+)\] - (\d{4}-\d\d-\d\d)", heading).groups() for heading in headings]
    versions = [(date, Version(version)) for version, date in released]
    assert versions == sorted(versions, reverse=True)
    now = Version(metadata()[0]["version"])
    assert now.is_devrelease or now in [version for _, version in versions]


def test_each_pattern_of_the_release_tool_occurs_once_in_its_file():
    changes = tomllib.loads(text("pyproject.toml"))["tool"]["bumpversion"]["files"]
    assert {change["filename"] for change in changes} == {*PLACES, "CHANGELOG.md"}
    for change in changes:
        assert len(re.findall(change["search"], text(change["filename"]), re.MULTILINE)) == 1


def test_continuous_integration_covers_all_declared_python_and_package_versions():
    matrix = yaml.safe_load(text(".github/workflows/ci.yml"))["jobs"]["matrix"]["strategy"]["matrix"]
    classifiers = tomllib.loads(text("pyproject.toml"))["project"]["classifiers"]
    assert [f"Programming Language :: Python :: {version}" for version in matrix["python"]] == classifiers[3:6]
    assert matrix["packages"] == re.findall(r'id="(\w+)"', text("noxfile.py"))


def test_actions_are_pinned_by_commit_agree_between_workflows_and_leave_no_credentials():
    content = "".join(path.read_text(encoding="utf-8") for path in WORKFLOWS)
    used = re.findall(r"uses: (actions/[\w-]+)@([0-9a-f]{40}) # (v\d+\.\d+\.\d+)\n", content)
    assert len(used) == content.count("uses: ") > 8
    assert len({name for name, _, _ in used}) == len(set(used))
    jobs = [job for path in WORKFLOWS for job in yaml.safe_load(path.read_text(encoding="utf-8"))["jobs"].values()]
    checkouts = [step for job in jobs for step in job["steps"] if "actions/checkout" in step.get("uses", "")]
    assert [step for step in checkouts if step["with"]["persist-credentials"] is not False] == []


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_uses_existing_make_targets_and_only_publishing_jobs_may_write(path):
    targets = set(re.findall(r"^([a-z-]+):", text("Makefile"), re.MULTILINE))
    content = path.read_text(encoding="utf-8")
    for line in re.findall(r"(?:- run: |vibroimpact )make ([a-z -]+)", content):
        assert set(line.split()) <= targets
    workflow = yaml.safe_load(content)
    assert workflow["permissions"] == {"contents": "read"}
    may_write = [name for name, job in workflow["jobs"].items() if "write" in job.get("permissions", {}).values()]
    assert may_write == (["publish"] if path.stem in ("pages", "release") else [])
