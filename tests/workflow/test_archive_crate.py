"""What an archive says of itself: by the rules of RO-Crate 1.1, every file of it and no other, and a CODECHECK."""

import hashlib
import json
import re
from datetime import datetime
from urllib.parse import quote

import pytest
import yaml
from rocrate.rocrate import ROCrate

from archives import COMMITTED, archive_of, unpacked
from pipeline_trees import ROOT
from vibroimpact.figures.specs import specs
from vibroimpact_pipeline.archive.codecheck import command

METADATA, CONFIG = "ro-crate-metadata.json", yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
CONTEXT = "https://w3id.org/ro/crate/1.1/context"


@pytest.fixture(scope="module")
def tree(archived, tmp_path_factory):
    """The archive unpacked. Read it."""
    return unpacked(archive_of(archived), tmp_path_factory.mktemp("crate"))


@pytest.fixture(scope="module")
def document(tree):
    return json.loads((tree / METADATA).read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def entities(document):
    return {entity["@id"]: entity for entity in document["@graph"]}


@pytest.fixture(scope="module")
def manifest(tree):
    return yaml.safe_load((tree / "codecheck.yml").read_text(encoding="utf-8"))


def types(entity):
    found = entity["@type"]
    return found if isinstance(found, list) else [found]


def references(node):
    """The ids that an entity refers to."""
    if isinstance(node, dict):
        return {node["@id"]} if set(node) == {"@id"} else set().union(*map(references, node.values()))
    return set().union(*map(references, node)) if isinstance(node, list) else set()


def files_below(tree):
    return {str(path.relative_to(tree.path)): path for path in tree.path.rglob("*") if path.is_file()}


def test_the_document_is_flat_and_every_entity_is_there_once(document, entities):
    context, own = document["@context"]
    assert context == CONTEXT
    assert own == {"sha256": "https://schema.org/sha256"}
    assert len(entities) == len(document["@graph"]) > 500
    for entity in document["@graph"]:
        assert types(entity)
        nested = [value for value in entity.values() if isinstance(value, dict) and set(value) != {"@id"}]
        assert nested == []
        assert [name for name, value in entity.items() if isinstance(value, list) and len(value) < 2] == []


def test_every_reference_leads_to_an_entity_or_to_the_web(document, entities):
    named = set().union(*(references(list(entity.values())) for entity in document["@graph"]))
    assert {name for name in named if name not in entities and not re.match("https?://", name)} == set()


def test_the_descriptor_names_the_root_and_the_specification(entities):
    descriptor = entities[METADATA]
    assert types(descriptor) == ["CreativeWork"]
    assert descriptor["about"] == {"@id": "./"}
    assert {"@id": "https://w3id.org/ro/crate/1.1"} in descriptor["conformsTo"]


def test_the_root_says_who_when_and_under_which_licence(entities):
    root = entities["./"]
    assert types(root) == ["Dataset"]
    assert root["name"].startswith(f"vibroimpact {CITATION['version']}, commit ")
    assert "Sources of commit" in root["description"]
    assert datetime.fromisoformat(root["datePublished"]) == datetime.fromisoformat(COMMITTED)
    assert root["license"] == {"@id": f"https://spdx.org/licenses/{CITATION['license']}"}
    assert entities[root["license"]["@id"]]["name"] == CITATION["license"]
    authors = [entities[name] for name in sorted(references(root["author"]))]
    assert [author["name"] for author in authors] == [author["name"] for author in CITATION["authors"]]
    assert {kind for author in authors for kind in types(author)} <= {"Person", "Organization"}
    assert entities[root["isBasedOn"]["@id"]]["name"] == CITATION["references"][0]["title"]
    assert root["creativeWorkStatus"] == "as committed"


def test_every_file_is_described_and_every_described_file_is_there(tree, entities):
    there = {name for name in files_below(tree) if name != METADATA}
    described = {name for name, entity in entities.items() if "File" in types(entity)}
    assert described == {quote(name, safe="/~") for name in there}
    parts = references(entities["./"]["hasPart"])
    assert parts == described | {name for name, entity in entities.items() if "Dataset" in types(entity)} - {"./"}
    assert "profiles/" in parts


def test_every_file_is_as_it_is_described(tree, entities):
    for name, path in files_below(tree).items():
        if name != METADATA:
            entity = entities[quote(name, safe="/~")]
            content = path.read_bytes()
            assert int(entity["contentSize"]) == len(content)
            assert entity["sha256"] == hashlib.sha256(content).hexdigest()
            assert entity["name"]
            assert re.fullmatch(r"[\w-]+/[\w.+-]+", entity["encodingFormat"])


def test_every_result_says_what_it_is(entities):
    results = [entity for name, entity in entities.items() if name.startswith(("results/", ".snakemake/"))]
    assert len(results) > 400
    assert [entity["@id"] for entity in results if not entity.get("description")] == []


def test_sources_results_and_records_are_in_and_logs_are_not(tree):
    names = files_below(tree).keys()
    assert {"environment.lock", "config/config.yaml", "results/claims.json", "codemeta.json"} <= names
    assert {f"results/simulations/equal/{name}" for name in ("samples.csv", "events.csv", "summary.json")} <= names
    assert not [name for name in names if name.startswith(("results/logs/", "results/benchmarks/", ".git/"))]
    results = {name for name in names if name.startswith("results/") and not name.startswith("results/checksums/")}
    assert {f"results/checksums/{name}.sha256" for name in results} <= names


def test_every_figure_says_of_what_it_was_made(entities):
    actions = {name: entity for name, entity in entities.items() if "CreateAction" in types(entity)}
    assert {f"#{figure}" for figure in CONFIG["figures"]} < set(actions)
    assert references(entities["./"]["mentions"]) == set(actions)
    for name, action in actions.items():
        assert action["instrument"] == {"@id": "Snakefile"}
        assert "config/config.yaml" in references(action["object"])
        made = references(action["result"])
        assert any(file.endswith(f"/{name[1:]}.png") for file in made)
        assert references(action) <= entities.keys()
    assert "results/simulations/weak/samples.csv" in references(actions["#fig10_11"]["object"])


def test_the_library_for_crates_reads_it(tree):
    read = ROCrate(tree.path)
    assert read.mainEntity.id == "Snakefile"
    assert read.root_dataset["license"].id.endswith("MIT")


def test_the_manifest_lists_every_figure_once_with_what_makes_it(tree, manifest):
    listed = [entry["file"] for entry in manifest["manifest"]]
    pictures = {str(path.relative_to(tree.path)) for path in (tree / "results").rglob("*.png")}
    assert sorted(listed) == sorted(pictures)
    assert {f"results/figures/{figure}.png" for figure in CONFIG["figures"]} <= pictures
    known = specs()
    for entry in manifest["manifest"]:
        figure = entry["file"].split("/")[-1].removesuffix(".png")
        assert entry["command"] == command(figure)
        if not figure.startswith("fig10_"):
            assert entry["comment"].startswith(known[figure]["title"])
    assert manifest["version"] == "https://codecheck.org.uk/spec/config/1.0/"
    assert manifest["paper"]["title"] == CITATION["references"][0]["title"]


def test_the_manifest_tells_figures_that_show_run_times(manifest):
    timed = {entry["file"] for entry in manifest["manifest"] if "run times" in entry["comment"]}
    assert "results/accuracy/work_precision.png" in timed
    assert "results/figures/fig10_04.png" not in timed


def test_a_command_of_the_manifest_makes_its_figure_and_nothing_else(archived, tmp_path, manifest):
    (entry,) = (entry for entry in manifest["manifest"] if entry["file"].endswith("/fig10_04.png"))
    program, _, _, *arguments = entry["command"].split()
    assert program == "snakemake"
    said = unpacked(archive_of(archived), tmp_path).dry_run(*arguments)
    assert re.findall(r"^(?:local)?rule (\w+):", said, re.MULTILINE) == ["fig10_04"]
