"""What describes the project to others: citation, deposit, catalog, and the files of .github."""

import json
import re
import tomllib

import pytest
import yaml

from pipeline_trees import ROOT

WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
FORMS = sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml"))


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


def test_version_title_licence_and_keywords_are_the_same_everywhere():
    project = tomllib.loads(text("pyproject.toml"))["project"]
    citation, deposit = yaml.safe_load(text("CITATION.cff")), json.loads(text(".zenodo.json"))
    described = json.loads(text("codemeta.json"))
    assert {str(one["version"]) for one in (project, citation, deposit, described)} == {project["version"]}
    assert citation["title"] == deposit["title"]
    assert citation["license"] == deposit["license"] == project["license"]
    assert citation["keywords"] == deposit["keywords"] == described["keywords"]
    assert set(project["keywords"]) <= set(citation["keywords"])
    assert [author["name"] for author in citation["authors"]] == [one["name"] for one in deposit["creators"]]


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
    assert writing == (["publish"] if path.stem == "pages" else [])


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
