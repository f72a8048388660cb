"""What is said of the software: in CITATION.cff, in pyproject.toml and, made of both, in codemeta.json."""

import json
import shutil
import tomllib

import pytest
import yaml

from pipeline_trees import ROOT
from vibroimpact_pipeline.archive.citation import CITATION, PROJECT, citation
from vibroimpact_pipeline.archive.codemeta import CODEMETA, page


@pytest.fixture
def checkout(tmp_path):
    for name in (CITATION, PROJECT):
        shutil.copy(ROOT / name, tmp_path / name)
    return tmp_path


def edit(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


def test_codemeta_says_what_its_sources_say():
    said = (ROOT / CODEMETA).read_text(encoding="utf-8")
    assert said == page(citation(ROOT)), "write it anew: python -m vibroimpact_pipeline.archive.codemeta"


def test_codemeta_agrees_with_both_files():
    said = json.loads((ROOT / CODEMETA).read_text(encoding="utf-8"))
    project = tomllib.loads((ROOT / PROJECT).read_text(encoding="utf-8"))["project"]
    cff = yaml.safe_load((ROOT / CITATION).read_text(encoding="utf-8"))
    for name in ("name", "description", "version", "keywords"):
        assert said[name] == project[name]
    assert said["version"] == cff["version"]
    assert said["license"].endswith(f"/{cff['license']}")
    assert [author["name"] for author in said["author"]] == [author["name"] for author in cff["authors"]]
    assert said["softwareRequirements"] == project["dependencies"]
    assert said["referencePublication"]["name"] == cff["references"][0]["title"]


@pytest.mark.parametrize(
    ("file", "old", "new", "name"),
    [
        (CITATION, "version: 0.", "version: 9.", "version"),
        (PROJECT, 'license = "MIT"', 'license = "BSD-3-Clause"', "license"),
        (CITATION, "  - vibro-impact\n", "", "keywords"),
    ],
)
def test_files_that_say_different_things_are_refused(checkout, file, old, new, name):
    edit(checkout / file, old, new)
    with pytest.raises(ValueError, match=f"^{name}: {CITATION} says .*, {PROJECT} .*Make them agree"):
        citation(checkout)


def test_persons_and_organizations_are_told_apart(checkout):
    edit(
        checkout / CITATION,
        '  - name: "The vibroimpact authors"\n',
        '  - name: "A Laboratory"\n  - {family-names: Doe, given-names: Jo, orcid: "https://orcid.org/0000-0001-2345-6789"}\n',
    )
    assert citation(checkout).authors() == [
        {"@type": "Organization", "name": "A Laboratory"},
        {
            "@type": "Person",
            "@id": "https://orcid.org/0000-0001-2345-6789",
            "givenName": "Jo",
            "familyName": "Doe",
            "name": "Jo Doe",
        },
    ]
